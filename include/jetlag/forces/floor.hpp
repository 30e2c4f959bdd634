// SPDX-License-Identifier: MIT
#pragma once
// A floor or wall: a half-space that pushes back whoever is inside it.

#include "jetlag/forces/force.hpp"

namespace jetlag {

namespace detail {

/// The penalty law of a half-space, power p = 1 or 2:
///     F = k s^p n,   E = k s^(p+1) / (p+1),   s = max(0, h - n . x) the depth.
/// Written with `select` and not with `max`: a particle exactly on the surface has a series, that of free flight.
template <int power>
struct HalfSpace {
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness", "height", "normal_x", "normal_y", "normal_z"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness, const T& height, const T& x,
                            const T& y, const T& z) {
    const Vector<T, D> n = normal<T, D>(x, y, z);
    return T(stiffness * (power == 1 ? depth(p, height, n) : squared(depth(p, height, n)))) * n;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p, const T& stiffness, const T& height, const T& x, const T& y,
                  const T& z) {
    const T s = depth(p, height, normal<T, D>(x, y, z));
    return T(1.0 / (power + 1)) * stiffness * (power == 1 ? squared(s) : T(s * squared(s)));
  }

  /// n . x - h.
  template <int D>
  static Vector<double, 1> kink(const Positions<D, 1>& position, double, double height, double x, double y,
                                double z) {
    return Vector<double, 1>(normal<double, D>(x, y, z).dot(position[0]) - height);
  }

 private:
  template <class T>
  static T squared(const T& s) {
    return s * s;
  }
  template <class T, int D>
  static Vector<T, D> normal(const T& x, const T& y, const T& z) {
    const std::array<T, 3> n{x, y, z};
    return Vector<T, D>(Vector<T, D>::Map(n.data()));
  }
  template <class T, int D>
  static T depth(const Participants<T, D, 1>& p, const T& height, const Vector<T, D>& n) {
    const T s = height - n.dot(p.position[0]);
    return select(s > T(0.0), s, T(0.0));
  }
};

}  // namespace detail

/// F = k s n,   E = k s^2 / 2,   s = max(0, h - n . x) the depth below the surface n . x = h.
/// stiffness k [N/m]; height h [m]; normal n [1] of length 1, out of the floor: in D dimensions its first D components.
/// Contact without other forces lasts pi sqrt(m/k), and takes its speed along n back to the last bit but for rounding.
///
/// The force has a kink at the surface, so that the motion is analytic only between contacts, and the series of a step
/// knows the side on which the step begins. Steps that a control chooses from the series, and those of clocks, end there
/// (model/kinks.hpp). A step that is fixed goes on as if there were no surface: it misses up to k (v h)^2 / 2 of energy on
/// the way in, (omega h)^2 of that along n with omega = sqrt(k/m), and as much on the way out, whatever its degree. Who needs
/// the order of the method all the same ends a step there, with an Event at the surface (schedule/events.hpp) whose
/// `change` carries the state over it, since rounding may leave it on either side:
///     .change = [](State<double>& state) { state.position += 1e-14 * state.velocity; }
/// Conserves: energy, momentum along the surface.
struct Floor : detail::HalfSpace<1> {
  static constexpr const char* name = "floor";

  static double stiffness(double k, double, double, double, double) { return k; }
};

/// F = k s^2 n,   E = k s^3 / 3;   stiffness k [N/m^2], the others as in Floor. The force has a continuous slope: a step
/// across the surface misses k (v h)^3 / 3 of energy. Its stiffness 2 k s grows with the depth: `courant` limits go without it.
struct QuadraticFloor : detail::HalfSpace<2> {
  static constexpr const char* name = "quadratic_floor";
  static constexpr bool unbounded = true;
};

extern template RecordedLaw record_law<Floor>(int);  // recorded in src/forces
extern template RecordedLaw record_law<QuadraticFloor>(int);

}  // namespace jetlag
