// SPDX-License-Identifier: MIT
#pragma once
// Laws whose forces have no series somewhere, and motions that begin there.

#include <array>
#include <cmath>

#include "jetlag/model/system.hpp"

namespace jetlag::testing::singular_laws {

/// F = -c |v| v.
struct QuadraticDrag {
  static constexpr const char* name = "quadratic_drag";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"coefficient"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& c) {
    return T(-c * p.velocity[0].norm()) * p.velocity[0];
  }
};

/// F = sqrt(t (1 - t)) along x.
struct HalfDisc {
  static constexpr const char* name = "half_disc";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    using std::sqrt;
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = sqrt(T(p.time * (1.0 - p.time)));
    return f;
  }
};

/// F = 1 + s - |v| v + (s + s^2/2)^2 along x, s = t - start: the motion from rest is v = s + s^2/2.
struct GrowingPush {
  static constexpr const char* name = "growing_push";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"start"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& start) {
    const T s = p.time - start, v = s + 0.5 * s * s;
    Vector<T, D> f = T(-p.velocity[0].norm()) * p.velocity[0];
    f[0] += 1.0 + s + v * v;
    return f;
  }
};

/// F = sqrt(|x|) along x: rest at x = 0 may end at any time, x = (t - t_0)^4 / 144.
struct Cone {
  static constexpr const char* name = "cone";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    using std::sqrt;
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = sqrt(p.position[0].norm());
    return f;
  }
};

/// Relative drag F = -|u| u of the first particle, u = v_0 - v_1.
struct RelativeDrag {
  static constexpr const char* name = "relative_drag";
  static constexpr int participants = 2;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p) {
    const Vector<T, D> u = p.velocity[0] - p.velocity[1];
    return T(-u.norm()) * u;
  }
};

/// The push of 1 N along x lasts from 1 s to 2 s.
struct Push {
  static constexpr const char* name = "push";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = select(p.time >= 1.0 && p.time < 2.0, T(1.0), T(0.0));
    return f;
  }
};

/// F = atan2(sin t, cos t) along x: t, with a jump to t - 2 pi at pi of which the tape knows nothing.
struct Sawtooth {
  static constexpr const char* name = "sawtooth";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = atan2(sin(p.time), cos(p.time));
    return f;
  }
};

/// Pushes towards x + v = 0 from both sides: nothing but sliding follows.
struct ToALine {
  static constexpr const char* name = "to_a_line";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    Vector<T, D> f = Vector<T, D>::Constant(T(0.0));
    f[0] = select(p.position[0][0] + p.velocity[0][0] > T(0.0), T(-1.0), T(1.0));
    return f;
  }
};

inline constexpr std::array<double, 0> none{};

inline State<> at_rest(int particles, int dimension) {
  return {0.0, Coordinates<>::Zero(particles, dimension), Coordinates<>::Zero(particles, dimension)};
}

/// x'' = g - c x'^2 from rest:   x = ln cosh(sqrt(g c) t) / c.
inline double fallen(double g, double c, double t) { return std::log(std::cosh(std::sqrt(g * c) * t)) / c; }
inline double falling(double g, double c, double t) {
  return std::sqrt(g / c) * std::tanh(std::sqrt(g * c) * t);
}

}  // namespace jetlag::testing::singular_laws
