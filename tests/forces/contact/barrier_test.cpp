// SPDX-License-Identifier: MIT
// Barriers as formulas: energies, forces, what they conserve, their limits.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "forces/contact/stencils.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/running_error.hpp"

namespace jetlag::testing::barrier_test {
namespace {

using namespace contact;
using Number = RunningError<double>;

template <class L, class T, int D>
T energy_at(const Participants<T, D, L::participants>& p, const std::vector<double>& c) {
  return with_parameters<L, T>(p, c,
                               [](const auto& q, const auto&... each) { return T(L::energy(q, each...)); });
}
/// On all participants, component by component.
template <class L, class T, int D>
std::vector<T> forces_at(const Participants<T, D, L::participants>& p, const std::vector<double>& c) {
  const auto given = with_parameters<L, T>(
      p, c, [](const auto& q, const auto&... each) { return forces_of<L>(q, each...); });
  std::vector<T> all;
  Vector<T, D> last = Vector<T, D>::Constant(T(0.0));
  for (const auto& f : given) {
    all.insert(all.end(), f.data(), f.data() + D);
    last -= f;
  }
  all.insert(all.end(), last.data(), last.data() + D);
  return all;
}

/// Minus the slope of an energy, in 50 digits: differences over 1e-12 err by (1e-12)^2 times its third derivative, some
/// (20/d)^3 of it; 1e-17.
template <class L, int D>
std::vector<Digits50> minus_gradient(Participants<Digits50, D, L::participants> p,
                                     const std::vector<double>& c) {
  const Digits50 h = 1e-12;
  std::vector<Digits50> slopes;
  for (auto& x : p.position)
    for (Digits50& component : x) {
      const Digits50 here = component;
      component = here - h;
      const Digits50 before = energy_at<L, Digits50, D>(p, c);
      component = here + h;
      const Digits50 after = energy_at<L, Digits50, D>(p, c);
      component = here;
      slopes.push_back((before - after) / (2 * h));
    }
  return slopes;
}

/// f<L, D>(stencil, parameters) for stencils between a tenth and nine tenths of the thickness, with a gap and without.
template <class L, int D, class F>
void at_random_stencils(int power, F f) {
  Uniform draw(power + 10 * D + 100 * L::participants);
  for (int i = 0; i < 6; ++i) {
    const double gap = i % 2 == 0 ? 0.0 : 0.03, y = draw(0.1, 0.9);
    const auto stencil = stencil_at<L, D>(gap + 0.1 * y, draw);
    SCOPED_TRACE(std::string(L::name) + " in " + std::to_string(D) + ", power " + std::to_string(power) +
                 ", y " + std::to_string(y));
    f(stencil, parameters_for<L, D>(stencil, gap, power));
  }
}

/// The bounds that numbers carry, of a few hundred roundings, are checked to be small themselves.
template <class L, int D>
void expect_gradient(int power) {
  at_random_stencils<L, D>(power, [](const auto& stencil, const auto& c) {
    const auto rounded = participants_of<Number, D, L::participants>(stencil.position);
    const auto exact = participants_of<Digits50, D, L::participants>(stencil.position);
    EXPECT_THAT((energy_at<L, Number, D>(rounded, c)),
                IsCloseTo(energy_at<ByGram<L>, Digits50, D>(exact, c)));
    EXPECT_THAT((forces_at<L, Number, D>(rounded, c)), IsCloseTo(minus_gradient<ByGram<L>, D>(exact, c)));
  });
}
TEST(Barrier, PushesAlongMinusTheGradientOfItsEnergyForEveryPower) {
  for (int power = 1; power <= 7; ++power)
    for_each_barrier([power]<class L, int D>() { expect_gradient<L, D>(power); });
}
TEST(LogBarrier, PushesAlongMinusTheGradientOfItsEnergy) {
  for_each_log_barrier([]<class L, int D>() { expect_gradient<L, D>(1); });
}

/// sum_i (x_i - x_last) x f_i = 0 in each plane: within the bounds carried, and to 2^-40 of its largest terms.
template <class L, int D>
void expect_no_torque(int power) {
  at_random_stencils<L, D>(power, [](const auto& stencil, const auto& c) {
    const auto p = participants_of<Number, D, L::participants>(stencil.position);
    const auto f = forces_at<L, Number, D>(p, c);
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < a; ++b) {
        Number turn = 0;
        double largest = 0;
        for (int i = 0; i + 1 < L::participants; ++i) {
          const Vector<Number, D> x = p.position[i] - p.position[L::participants - 1];
          turn += x[a] * f[i * D + b] - x[b] * f[i * D + a];
          largest = std::max(largest, std::abs((x[a] * f[i * D + b]).value));
        }
        EXPECT_LE(std::abs(turn.value), turn.error);
        EXPECT_LE(std::abs(turn.value), 0x1p-40 * largest);
      }
  });
}
TEST(Barrier, TurnsNothing) {
  for_each_barrier([]<class L, int D>() { expect_no_torque<L, D>(7); });
  for_each_log_barrier([]<class L, int D>() { expect_no_torque<L, D>(7); });
}

/// Two vertices on a line, in 50 digits.
template <class L>
Digits50 energy_of_gap(const Digits50& y, const std::vector<double>& c) {
  Participants<Digits50, 1, 2> p =
      participants_of<Digits50, 1, 2>({Vector<double, 1>(0), Vector<double, 1>(0)});
  p.position[0][0] = Digits50(c[2]) + y * Digits50(c[1]);
  return energy_at<L, Digits50, 1>(p, c);
}

/// With z = 1 - y and xi = 0 it is k d_hat^2 z^3 (1 - z/2)^3 (1 - z)^(-2q), the logarithm k d_hat^2 z^3 (1 + z/2 + ..): at z = 1e-9
/// the ratios are 1 + (2q - 3/2) z and 1 + z/2, to terms of some 100 z^2.
TEST(Barrier, BeginsAsTheThirdPowerOfTheDepth) {
  const Digits50 z = 1e-9, most = 1e-16;
  for (int power = 1; power <= 7; ++power) {
    const Digits50 ratio =
        energy_of_gap<BarrierVertexVertex>(1 - z, {1000, 0.125, 0, double(power)}) / (1000 * z * z * z / 64);
    EXPECT_LE(abs(ratio - 1 - (2 * power - Digits50(1.5)) * z), most) << power;
  }
  const Digits50 ratio =
      energy_of_gap<LogBarrierVertexVertex>(1 - z, {1000, 0.125, 0}) / (1000 * z * z * z / 64);
  EXPECT_LE(abs(ratio - 1 - z / 2), most);
}

/// 1 - w = 2 z (d_hat + xi) / (d_hat + 2 xi) + O(z^2): k d_hat (d_hat + xi)^3 / (d_hat + 2 xi)^2 z^3, to a few tens of z; and y -> 0.
TEST(Barrier, WithAGapEndsAtIt) {
  const Digits50 z = 1e-9;
  const std::vector<double> c{1000, 0.125, 0.0625, 7};
  const Digits50 begin = Digits50(1000) / 8 * pow(Digits50(0.1875), 3) / (Digits50(0.25) * Digits50(0.25));
  EXPECT_LE(abs(energy_of_gap<BarrierVertexVertex>(1 - z, c) / (begin * z * z * z) - 1), 50 * z);
  // w = y (2 xi + y d_hat) / (d_hat + 2 xi) = y / 2 + O(y^2)
  const Digits50 y = 1e-9, end = 1000 * Digits50(0.03125) / 8 * pow(2 / y, 7);
  EXPECT_LE(abs(energy_of_gap<BarrierVertexVertex>(y, c) / end - 1), 50 * y);
  EXPECT_LE(
      abs(energy_of_gap<LogBarrierVertexVertex>(y, {1000, 0.125, 0.0625}) / (1000 * log(1 / y) / 64) - 1),
      50 * y);
}

/// y at which an energy that falls with y is E.
template <class V>
double turning_point(V energy, double e) {
  double low = 1e-3, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double y = (low + high) / 2;
    (energy(y) > e ? low : high) = y;
  }
  return low;
}

/// Layers l = 1, 2, .. of thickness .1 l^(-1/4) and stiffness 1000 l^3 add up to y^-14: 1/840 = 1/8/105. For m = 1 turning
/// points then agree the better the faster the particle is.
TEST(Barrier, OfPowerSevenIsAnInfiniteStackOfLayers) {
  const auto layers = [](double y) {
    double v = 0;
    for (int l = 1; std::pow(l, -0.25) > y; ++l) {
      const double depth = 0.1 * (std::pow(l, -0.25) - y);
      v += 500 * std::pow(l, 3.0) * depth * depth;
    }
    return v;
  };
  const auto barrier = [](double y) {
    return static_cast<double>(energy_of_gap<BarrierVertexVertex>(y, {1000.0 / 105, 0.1, 0, 7}));
  };
  const double known[] = {0.076577929, 0.055107246, 0.039658779, 0.028541855, 0.020541164};
  const double within_percent[] = {12, 6, 3, 2, 1};
  double v = 1;
  for (int i = 0; i < 5; ++i, v *= 10) {
    const double of_layers = turning_point(layers, v * v / 2), of_barrier = turning_point(barrier, v * v / 2);
    EXPECT_NEAR(0.1 * of_layers, known[i], 5e-10) << v;  // half of the last digit given
    EXPECT_NEAR(100 * (of_barrier / of_layers - 1), 0, within_percent[i] + 0.5) << v;  // percents are rounded
  }
}

/// Of what is said of fast particles: y = (k d_hat^2 / (4 m v^2))^(1/(2q)), where (1 - w)^3 is nearly 1.
TEST(Barrier, TurnsAFastParticleWhereItSays) {
  const double v = 1e8,
               y = turning_point(
                   [](double at) {
                     return static_cast<double>(energy_of_gap<BarrierVertexVertex>(at, {1000, 0.1, 0, 7}));
                   },
                   v * v / 2);
  const double expected = std::pow(10.0 / (4 * v * v), 1.0 / 14);
  EXPECT_NEAR(y / expected, 1, 3.0 / 14 * 1.5 * y * y);  // 3 w / (2q), and half as much again
  EXPECT_LT(y, 0.09);
}

TEST(Barrier, GivesNoStiffness) {
  for_each_barrier([]<class L, int D>() {
    EXPECT_TRUE(record_law<L>(D).unbounded);
    EXPECT_EQ(record_law<L>(D).stiffness, nullptr);
    EXPECT_TRUE(record_law<L>(D).force.conditions.empty());  // and has nothing to decide
  });
}

}  // namespace
}  // namespace jetlag::testing::barrier_test
