// SPDX-License-Identifier: MIT
// A user's program: a force law of its own, the series of a motion under it, and the motion itself.
//
// Two particles of mass 1 that attract each other as 1/r^3, with strength 1, have d'' = -2 d / |d|^4. The
// square of their distance is then a parabola in time (Jacobi):
//     |d|^2 = |d_0|^2 + 2 d_0.d'_0 t + (|d'_0|^2 - 2 / |d_0|^2) t^2.

// [readme]
#include <jetlag/jetlag.hpp>

struct InverseCube {  // F = c d / |d|^4 on the first of two particles, its opposite on the second
  static constexpr const char* name = "inverse_cube";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"strength"};

  template <class T, int D>
  static jetlag::Vector<T, D> force(const jetlag::Participants<T, D, 2>& p, const T& strength) {
    const jetlag::Vector<T, D> d = p.position[1] - p.position[0];
    return T(strength / (d.squaredNorm() * d.squaredNorm())) * d;
  }
};

jetlag::Expansion<> series_of(const jetlag::System<>& system, const jetlag::State<>& start) {
  jetlag::Expansion<> motion(system);
  motion.start(start);
  motion.grow_to(16);  // motion.position(k) is coefficient k of all positions
  return motion;
}

jetlag::State<> state_at(double time, const jetlag::System<>& system, jetlag::State<> state) {
  jetlag::Lockstep run(jetlag::taylor(system, 20, std::make_unique<jetlag::JorbaZou>()));
  run.run(state, time, {});  // degree 20, each step chosen from the series: to rounding
  return state;
}
// [readme end]

#include <cmath>
#include <cstdio>
#include <memory>

namespace {

bool near(const char* what, double actual, double expected, double tolerance) {
  if (std::abs(actual - expected) <= tolerance) return true;
  std::printf("%s is %.17g instead of %.17g\n", what, actual, expected);
  return false;
}

}  // namespace

int main() {
  jetlag::System<> pair(2, {1.0, 1.0});  // in the plane
  pair.add<InverseCube>({{0, 1}}, {{1.0}});
  using Rows = jetlag::Coordinates<>;
  const jetlag::State<> start{0.0, Rows{{-0.5, 0.0}, {0.5, 0.0}}, Rows{{-0.1, -0.8}, {0.1, 0.8}}};
  const double parabola[] = {1.0, 0.4, 0.6};  // d_0 = (1, 0), d'_0 = (0.2, 1.6)
  bool good = true;

  // Coefficient k of |d|^2. Coefficients of d are of the size of 1; a sum of 2 (k + 1) <= 34 of their
  // products that carry some ulps each.
  const jetlag::Expansion<> motion = series_of(pair, start);
  const auto d = [&](int k) { return (motion.position(k).row(1) - motion.position(k).row(0)).eval(); };
  for (int k = 0; k <= motion.order(); ++k) {
    double sum = 0, size = 0;
    for (int j = 0; j <= k; ++j) {
      sum += d(j).dot(d(k - j));
      size += d(j).norm() * d(k - j).norm();
    }
    good &= near("a coefficient of |d|^2", sum, k < 3 ? parabola[k] : 0.0, 34 * 0x1p-52 * size);
  }

  // Rounding of some ten steps of numbers below 2; the error of a step of degree 20 is smaller still.
  const jetlag::State<> state = state_at(1.0, pair, start);
  good &= near("|d|^2 at t = 1", (state.position.row(1) - state.position.row(0)).squaredNorm(),
               parabola[0] + parabola[1] + parabola[2], 1e-14);

  // A law of the library: masses 1 at distance 1 turn about each other, d'' = -2 d, at |d'| = 2^1/2. Ten steps.
  jetlag::System<> circle(2, {1.0, 1.0});
  circle.add<jetlag::Gravity>({{0, 1}}, {{1.0}});
  const jetlag::State<> turned = state_at(
      1.0, circle, {0.0, Rows{{-0.5, 0.0}, {0.5, 0.0}}, Rows{{0.0, -std::sqrt(0.5)}, {0.0, std::sqrt(0.5)}}});
  good &= near("|d| of a circle", (turned.position.row(1) - turned.position.row(0)).norm(), 1.0, 1e-14);
  return good ? 0 : 1;
}
