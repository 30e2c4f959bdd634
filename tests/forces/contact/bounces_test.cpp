// SPDX-License-Identifier: MIT
// One bounce off a barrier: where it turns back, how long it takes, and what comes out.
#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "forces/contact/stencils.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/digits50.hpp"

namespace jetlag::testing::bounces_test {
namespace {

using namespace contact;

/// Mass 1 kg, thickness .1 m, stiffness 1000 N/m, power 7: from w = 1 at a speed [m/s] and back, in 50 digits.
struct Bounce {
  Digits50 turning_point, duration;  // y;  in d_hat / v
};

/// V / (m/2), with V = k d_hat^2 / 8 (1 - w)^3 w^-7.
Digits50 squared_speed(const Digits50& y) {
  const Digits50 w = y * y, beyond = 1 - w;
  return Digits50(10) / 4 * beyond * beyond * beyond / pow(w, 7);
}

/// 2 int_{y_0}^1 dy / sqrt(1 - V(y) / (m v^2 / 2)),   y = y_0 + (1 - y_0) s^2. Where s < 1e-10, by the slope at y_0.
Bounce bounce_at(double v) {
  const Digits50 energy = Digits50(v) * v, tiny = Digits50(1) / 100000000000000000000.0;
  Digits50 low = 1e-3, high = 1;
  for (int i = 0; i < 170; ++i) {
    const Digits50 y = (low + high) / 2;
    (squared_speed(y) > energy ? low : high) = y;
  }
  const Digits50 begin = low, length = 1 - begin;
  const Digits50 slope = (squared_speed(begin) - squared_speed(begin + tiny)) / tiny;
  boost::math::quadrature::tanh_sinh<Digits50> rule(9);
  const auto integrand = [&](const Digits50& s) {
    const Digits50 y = begin + length * s * s;
    if (s < 1e-10) return Digits50(2 * sqrt(Digits50(length * energy / slope)));
    return Digits50(2 * length * s / sqrt(Digits50(1 - squared_speed(y) / energy)));
  };
  return {begin, 2 * rule.integrate(integrand, Digits50(0), Digits50(1), Digits50(1e-18))};
}

struct Known {
  double v, turning_point, duration;
};
constexpr Known known[] = {{1, .83066808164548, .41912219280745},
                           {100, .51728466849295, 1.05551392292834},
                           {1e4, .28139636224563, 1.49269878313055}};

TEST(Bounce, HasTheKnownTurningPointAndDuration) {
  for (const Known& at : known) {  // half of the last of 14 digits given, and the quadrature's 1e-18
    const Bounce bounce = bounce_at(at.v);
    EXPECT_NEAR(static_cast<double>(bounce.turning_point), at.turning_point, 5.1e-15) << at.v;
    EXPECT_NEAR(static_cast<double>(bounce.duration), at.duration, 1.01e-14) << at.v;
  }
}

/// The first feature, of 1 kg in all, thrown along its normal at the other, which is fixed. Masses are by the weights of the closest
/// points, so that an edge does not turn.
template <class L, int D>
void expect_bounce() {
  Uniform draw(31 + D);
  const auto stencil = stencil_at<L, D>(0.1, draw);
  constexpr int P = L::participants, thrown = is_of_edges<L> ? 2 : 1;
  std::vector<double> mass(P, 1.0);
  if (is_of_edges<L>) {
    const Vector<double, D> a = stencil.position[1] - stencil.position[0],
                            b = stencil.position[3] - stencil.position[2];
    const Vector<double, D> m = stencil.position[0] - stencil.position[2];
    const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
    const double along = (ab * m.dot(b) - bb * m.dot(a)) / (aa * bb - ab * ab);
    mass[0] = 1 - along;
    mass[1] = along;
  }
  // M = 1, and its slope is 0, at c = eps.
  const auto c = parameters_for<L, D>(stencil, 0.0, 7, 1.0);
  for (const Known& at : known) {
    System<double> system(D, mass);
    for (int i = thrown; i < P; ++i) system.fix(i);
    std::vector<int> all(P);
    std::iota(all.begin(), all.end(), 0);
    system.add(record_law<L>(D), all, c);
    State<double> state{0.0, Coordinates<double>(P, D), Coordinates<double>::Zero(P, D)};
    for (int i = 0; i < P; ++i) state.position.row(i) = stencil.position[i];
    for (int i = 0; i < thrown; ++i) state.velocity.row(i) = -at.v * stencil.normal;
    const Coordinates<double> start = state.position;
    const double until = 0.1 * at.duration / at.v;
    const Report report =
        Lockstep(taylor(system, 20, std::make_unique<JorbaZou>(until))).run(state, until, {});
    EXPECT_EQ(report.outcome, Outcome::success) << report.message;
    // Positions near 1 give distances, .1 or less, to some 4 roundings: 1e-15. The force has the slope 2 (q + 1)/d of
    // its size, so that this is 1e-13 of it; on a line, where the second vertex is not at the origin either, it is the same.
    for (int i = 0; i < thrown; ++i) {
      const std::string where =
          std::string(L::name) + " in " + std::to_string(D) + " at " + std::to_string(at.v);
      EXPECT_LE((state.position.row(i) - start.row(i)).norm(), 1e-13) << where;
      EXPECT_LE((state.velocity.row(i).transpose() / at.v - stencil.normal).norm(), 2e-13) << where;
    }
  }
}
TEST(Bounce, GivesBackTheSpeedAfterTheKnownTime) {
  for_each_barrier([]<class L, int D>() { expect_bounce<L, D>(); });
}

}  // namespace
}  // namespace jetlag::testing::bounces_test
