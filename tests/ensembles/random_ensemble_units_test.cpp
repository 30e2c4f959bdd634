// SPDX-License-Identifier: MIT
// Members in lanes and one by one: the same motion however fast or slow it is.
#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/ensembles/random_ensemble.hpp"
#include "jetlag/forces/forces.hpp"

namespace jetlag::testing {
namespace {

using Layout = RandomEnsemble::Layout;

/// F = -k x cos t/T: reads the time.
struct Breathing {
  static constexpr const char* name = "breathing";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"stiffness", "period"};
  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& stiffness, const T& period) {
    using std::cos;
    return T(T(-stiffness) * cos(T(p.time / period))) * p.position[0];
  }
};

/// Masses [kg], angular frequencies [rad/s] and lengths [m]: a slow one, an ordinary one, a molecule (500 N/m), a fast
/// one.
struct Scales {
  double mass, omega, length;
};
const Scales all_scales[] = {
    {1.0, 1e-17, 1.0}, {1.0, 1.0, 1.0}, {1.67e-27, 5.47e14, 1e-10}, {1.0, 1e15, 1.0}};

RandomEnsemble oscillators(const Scales& s, VelocitySeries velocity, Layout layout, bool timed) {
  System<double> system(1, {s.mass});
  const double stiffness = s.mass * s.omega * s.omega;
  if (timed)
    system.add<Breathing>({{0}}, {{stiffness, 3 / s.omega}});
  else
    system.add<Breathing>({{0}}, {{stiffness, 1e9 / s.omega}});
  system.add<Drag>({{0}}, {{0.2 * s.mass * s.omega}});
  const State<double> start{0.0, Coordinates<double>::Constant(1, 1, s.length),
                            Coordinates<double>::Constant(1, 1, 0.5 * s.length * s.omega)};
  RandomTaylor::Options options;
  options.velocity = velocity;
  RandomEnsemble::Options of_all;
  of_all.layout = layout;
  return {system,
          {geometric(3, 26, 0.1), options, std::make_shared<FixedStep>(0.5 / s.omega)},
          std::vector(40, start),
          of_all};
}

/// In units of its own mass, time and length the motion is that of omega = 1, whatever these are: rounding apart, of
/// some ten steps of 26 terms below 4, ten 26 4 2e-16 = 2e-13. Coefficient 26 is some omega^26 / 26!, beyond all
/// doubles.
TEST(RandomEnsemble, IsTheSameForFastAndForSlowMotions) {
  for (const auto velocity : {VelocitySeries::own_series, VelocitySeries::derivative})
    for (const bool timed : {false, true}) {
      auto ordinary = oscillators({1, 1, 1}, velocity, Layout::one_by_one, timed);
      ordinary.advance_to(4.2);
      EXPECT_GT(std::abs(ordinary.state(0).position(0, 0) - ordinary.state(1).position(0, 0)), 1e-6);
      for (const Scales& s : all_scales)
        for (const Layout layout : {Layout::in_lanes, Layout::one_by_one}) {
          auto all = oscillators(s, velocity, layout, timed);
          all.advance_to(4.2 / s.omega);
          for (std::size_t i = 0; i < all.size(); ++i) {
            ASSERT_EQ(all.report(i).outcome, Outcome::success) << s.omega << ' ' << all.report(i).message;
            const State<double> state = all.state(i), expected = ordinary.state(i);
            EXPECT_NEAR(state.position(0, 0) / s.length, expected.position(0, 0), 2e-13) << s.omega;
            EXPECT_NEAR(state.velocity(0, 0) / (s.length * s.omega), expected.velocity(0, 0), 2e-13)
                << s.omega;
          }
        }
    }
}

}  // namespace
}  // namespace jetlag::testing
