// SPDX-License-Identifier: MIT
// What a random ensemble costs: orders of the forces, the same in lanes and one by one.
#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/ensembles/random_ensemble.hpp"
#include "jetlag/forces/forces.hpp"

namespace jetlag::testing {
namespace {

using Layout = RandomEnsemble::Layout;

System<double> chain_of_four() {
  System<double> system(1, {1.0, 1.0, 1.0, 1.0});
  system.add<Spring>({{0, 1}, {1, 2}, {2, 3}}, {{1.0, 0.9}, {1.0, 0.9}, {1.0, 0.9}});
  system.fix(0);
  return system;
}

/// Where each of M particles draws, a step computes the orders up to the largest of M degrees,
///     E max K = sum_n P(max K >= n) = sum_n 1 - (1 - P(K >= n))^M,
/// in lanes as one by one, although lanes compute more. The mean of 20000 numbers from 3 to 6 (sd < 1.2) is right to
/// 4 1.2 / sqrt 20000 = 0.034. With `derivative` an order less, and never below 0.
TEST(RandomEnsemble, CostsWhatItsMembersCostByThemselves) {
  State<double> start{0.0, Coordinates<double>::Zero(4, 1), Coordinates<double>::Zero(4, 1)};
  for (int p = 0; p < 4; ++p) start.position(p, 0) = p;
  for (const bool shared_draw : {true, false})
    for (const auto velocity : {VelocitySeries::own_series, VelocitySeries::derivative}) {
      double expected = velocity == VelocitySeries::own_series ? 3 : 2;
      for (int n = 4; n <= 6; ++n) expected += 1 - std::pow(1 - std::pow(0.5, n - 3), shared_draw ? 1 : 3);
      const auto orders = [&](Layout layout) {
        RandomTaylor::Options options;
        options.shared_draw = shared_draw;
        options.velocity = velocity;
        RandomEnsemble::Options of_all;
        of_all.layout = layout;
        RandomEnsemble all(chain_of_four(),
                           {geometric(3, 6, 0.5), options, std::make_shared<FixedStep>(0.05)},
                           std::vector(1000, start), of_all);
        EXPECT_EQ(all.mean_orders(), 0.0);
        all.advance_to(1.0);
        return all.mean_orders();
      };
      EXPECT_NEAR(orders(Layout::in_lanes), expected, 0.034);
      EXPECT_EQ(orders(Layout::in_lanes), orders(Layout::one_by_one));
    }
}

/// Degree 0 and `derivative`: positions and velocities stay, or move by terms that are rare; no order is negative.
TEST(RandomEnsemble, CountsNoOrdersWhereNoneIsComputed) {
  State<double> start{0.0, Coordinates<double>::Zero(4, 1), Coordinates<double>::Zero(4, 1)};
  RandomTaylor::Options options;
  options.velocity = VelocitySeries::derivative;
  RandomEnsemble::Options of_all;
  of_all.layout = Layout::in_lanes;
  RandomEnsemble all(chain_of_four(),
                     {TruncationLaw("rare", {1.0, 1e-9}), options, std::make_shared<FixedStep>(0.25)},
                     {start, start}, of_all);
  all.advance_to(1.0);
  EXPECT_EQ(all.work().steps, 8u);
  EXPECT_EQ(all.work().coefficients, 0u);
  EXPECT_EQ(all.mean_orders(), 0.0);
}

}  // namespace
}  // namespace jetlag::testing
