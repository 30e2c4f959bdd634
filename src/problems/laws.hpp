// SPDX-License-Identifier: MIT
#pragma once
// Laws of motions that methods are tried on. Those on pairs that are called linear, cubic or quadratic have no rest length:
// positions are displacements, and the ends of a spring may pass each other.

#include <array>
#include <cmath>

#include "jetlag/forces/force.hpp"

namespace jetlag::problems {

// ---- on one particle --------------------------------------------------------------------------------------

/// F = -k x;   E = k/2 x^2. Linear: the motion is that of harmonic oscillators, exactly.
struct Tether {
  static constexpr const char* name = "tether";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness"};
  static double stiffness(double k) { return k; }

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness) {
    return T(-stiffness) * p.position[0];
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p, const T& stiffness) {
    return T(0.5) * stiffness * p.position[0].squaredNorm();
  }
};

/// F = 2 m |x|^2 x. From x = 1, x' = 1 on a line: x = 1 / (1 - t), every coefficient is 1.
struct CubicPush {
  static constexpr const char* name = "cubic push";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    return T(T(2.0) * p.mass[0] * p.position[0].squaredNorm()) * p.position[0];
  }
};

/// F = m cos(omega t) in the first direction.
struct Shaker {
  static constexpr const char* name = "shaker";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"frequency"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& frequency) {
    using std::cos;
    Vector<T, D> f = T(0.0) * p.position[0];
    f[0] = p.mass[0] * cos(T(frequency * p.time));
    return f;
  }
};

/// F = -sin x in every component: pendulums of unit mass in their angles.
struct SineOfAngle {
  static constexpr const char* name = "sine of angle";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  static constexpr int unrolled_orders = 20;
  static constexpr std::array unrolled_dimensions{1};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    using std::sin;
    Vector<T, D> f;
    for (int c = 0; c < D; ++c) f[c] = -sin(p.position[0][c]);
    return f;
  }
};

/// F = -x - x^3 in every component, with the cube as a power.
struct CubicTether {
  static constexpr const char* name = "cubic tether";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    using std::pow;
    Vector<T, D> f;
    for (int c = 0; c < D; ++c) f[c] = -(p.position[0][c] + pow(p.position[0][c], 3));
    return f;
  }
};

/// H = (p^2 + q^2)/2 + q_1^2 q_2 - q_2^3 / 3.         Source: Henon, Heiles, Astron. J. 69 (1964) 73.
struct HenonHeiles {
  static constexpr const char* name = "henon_heiles";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  static constexpr int unrolled_orders = 20;
  static constexpr std::array unrolled_dimensions{2};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    const Vector<T, D>& q = p.position[0];
    Vector<T, D> f = -q;
    f[0] -= 2.0 * (q[0] * q[1]);
    f[1] += q[1] * q[1] - q[0] * q[0];
    return f;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p) {
    const Vector<T, D>& q = p.position[0];
    return T(0.5) * q.squaredNorm() + q[0] * q[0] * q[1] - q[1] * q[1] * q[1] / T(3.0);
  }
};

/// The equations of Lorenz as forces on a unit mass that starts with the velocity they prescribe:
///     x'' = sigma (y' - x'),   y'' = x' (rho - z) - x z' - y',   z'' = x' y + x y' - beta z'.
struct LorenzForce {
  static constexpr const char* name = "lorenz";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    const Vector<T, D>&x = p.position[0], &v = p.velocity[0];
    Vector<T, D> f = Vector<T, D>(-v);  // of every component, so that all of them are set
    f[0] = 10.0 * (v[1] - v[0]);
    if constexpr (D == 3) {
      f[1] = v[0] * (28.0 - x[2]) - x[0] * v[2] - v[1];
      f[2] = v[0] * x[1] + x[0] * v[1] - (8.0 / 3.0) * v[2];
    }
    return f;
  }
};

/// A body of no mass near the earth and the moon, in axes that turn with them.
/// Source: Arenstorf, Amer. J. Math. 85 (1963) 27.
struct ArenstorfForce {
  static constexpr const char* name = "arenstorf";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"mu"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& mu) {
    const Vector<T, D>&x = p.position[0], &v = p.velocity[0];
    const T to_earth = x[0] + mu, to_moon = x[0] - (1.0 - mu), yy = x[1] * x[1];
    const T earth = (1.0 - mu) * pow(to_earth * to_earth + yy, -1.5),
            moon = mu * pow(to_moon * to_moon + yy, -1.5);
    Vector<T, D> f = Vector<T, D>(-v);
    f[0] = x[0] + 2.0 * v[1] - earth * to_earth - moon * to_moon;
    f[1] = x[1] - 2.0 * v[0] - (earth + moon) * x[1];
    return f;
  }
};

/// F = -x / r^3 - delta x / r^5,   E = -1 / r - delta / (3 r^3).
struct PerturbedKepler {
  static constexpr const char* name = "perturbed_kepler";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"delta"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& delta) {
    using std::pow;
    const T rr = p.position[0].squaredNorm();
    return T(-pow(rr, -1.5) * (1.0 + delta / rr)) * p.position[0];
  }
};

// ---- on pairs: d = q_1 - q_0 ------------------------------------------------------------------------------

/// F = k d;   E = k/2 d^2.
struct LinearSpring {
  static constexpr const char* name = "linear spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  static double stiffness(double k) { return k; }

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    return stiffness * Vector<T, D>(p.position[1] - p.position[0]);
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(0.5) * stiffness * d.squaredNorm();
  }
};

/// F = k (1 + d^2) d;   E = k (d^2/2 + d^4/4).         Source: the beta chain of Fermi, Pasta, Ulam, Tsingou 1955.
struct CubicSpring {
  static constexpr const char* name = "cubic spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(stiffness * (1.0 + d.squaredNorm())) * d;
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T s = d.squaredNorm();
    return stiffness * (T(0.5) * s + T(0.25) * (s * s));
  }
};

/// F = (k + c d^2) d;   E = k/2 d^2 + c/4 d^4. The parts of a spring whose force is linear, or cubic, alone.
struct Duffing {
  static constexpr const char* name = "duffing spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"linear", "cubic"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& linear, const T& cubic) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(linear + cubic * d.squaredNorm()) * d;
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& linear, const T& cubic) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T s = d.squaredNorm();
    return s * (T(0.5) * linear + T(0.25) * cubic * s);
  }
};

/// F = d + alpha d^2 on a line.         Source: the alpha chain of Fermi, Pasta, Ulam, Tsingou 1955.
struct QuadraticSpring {
  static constexpr const char* name = "quadratic spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"alpha"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& alpha) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return d + T(alpha * d[0]) * d;
  }
};

/// E = k (s^2/2 + s^4/4) of a spring of rest length 1 with extension s.
struct HardeningSpring {
  static constexpr const char* name = "hardening spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  static double stiffness(double k) { return k; }  // at rest length

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T length = d.norm(), s = length - 1.0;
    return T(stiffness * (s + s * s * s) / length) * d;
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T s = d.norm() - 1.0, square = s * s;
    return stiffness * (0.5 * square + 0.25 * square * square);
  }
};

}  // namespace jetlag::problems

namespace jetlag {
// Their kernels take the compiler a second each: once, in problems/particles.cpp.
extern template RecordedLaw record_law<problems::SineOfAngle>(int);
extern template RecordedLaw record_law<problems::HenonHeiles>(int);
}  // namespace jetlag
