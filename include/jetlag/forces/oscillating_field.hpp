// SPDX-License-Identifier: MIT
#pragma once
// An acceleration that is the same everywhere and swings in time, such as gusts or a shaken table.

#include "jetlag/forces/force.hpp"

namespace jetlag {

/// F = m a sin(omega t + phi);   E = -m a . x sin(omega t + phi).
/// acceleration a [m/s^2], in D dimensions its first D components; angular_frequency omega [1/s]; phase phi [rad].
/// Conserves: nothing.
struct OscillatingField {
  static constexpr const char* name = "oscillating_field";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"acceleration_x", "acceleration_y", "acceleration_z",
                                         "angular_frequency", "phase"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& x, const T& y, const T& z,
                            const T& omega, const T& phase) {
    return strength(p, omega, phase) * direction<T, D>(x, y, z);
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p, const T& x, const T& y, const T& z, const T& omega,
                  const T& phase) {
    return -(strength(p, omega, phase) * T(direction<T, D>(x, y, z).dot(p.position[0])));
  }

 private:
  template <class T, int D>
  static T strength(const Participants<T, D, 1>& p, const T& omega, const T& phase) {
    using std::sin;
    return p.mass[0] * sin(T(omega * p.time + phase));
  }
  template <class T, int D>
  static Vector<T, D> direction(const T& x, const T& y, const T& z) {
    const std::array<T, 3> a{x, y, z};
    return Vector<T, D>(Vector<T, D>::Map(a.data()));
  }
};

extern template RecordedLaw record_law<OscillatingField>(int);  // recorded in src/forces

}  // namespace jetlag
