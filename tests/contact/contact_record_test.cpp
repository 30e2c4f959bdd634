// SPDX-License-Identifier: MIT
// What contacts count, and how near they say that things came.
#include "jetlag/contact/contact_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/random.hpp"

namespace jetlag::testing::contact_record_test {
namespace {

/// A unit mass comes from 1 m at v towards a wall at 0 on a line and leaves again, or its run ends before that.
ContactRecord bounce(double v, std::unique_ptr<Control> control, double until) {
  System<double> system(1, {1.0, 1.0});
  system.fix(0);
  ContactBarrier contact{.surface = Surface({}, {}, {0, 1}),
                         .rest = Coordinates<double>{{0.0}, {1.0}},
                         .thickness = 0.1,
                         .stiffness = 1000};
  contact.record = std::make_shared<ContactRecord>();
  add(system, contact);
  State<double> state{0.0, contact.rest, Coordinates<double>{{0.0}, {-v}}};
  EnergyMeter energy(system);
  RunOptions options;  // who only looks is not counted
  options.observer.after_step = [&](const StepView& step) { return energy(step.state()).total() > 0; };
  Lockstep lockstep(taylor(system, 20, std::move(control)));
  EXPECT_EQ(lockstep.run(state, until, options).outcome, Outcome::success);
  return *contact.record;
}

/// Turning points of the barrier, in parts of the thickness: V(y) = v^2 / 2, in 50 digits.
struct Turn {
  double v, part;
};
class ContactRecords : public ::testing::TestWithParam<Turn> {};

TEST_P(ContactRecords, KnowHowNearABounceCame) {
  const auto [v, part] = GetParam();
  const ContactRecord record = bounce(v, std::make_unique<JorbaZou>(), 2.2 / v);
  EXPECT_NEAR(record.smallest_gap.value, 0.1 * part, 1e-5 * 0.1 * part);
  EXPECT_GE(record.smallest_gap.value, 0.1 * part * (1 - 1e-12));
  EXPECT_EQ(record.smallest_gap.particles, (std::vector{0, 1}));
  EXPECT_GT(record.smallest_gap.time, 0.9 / v);
  EXPECT_LT(record.smallest_gap.time, 1.1 / v);
  EXPECT_EQ(record.begun, 1u);
  EXPECT_EQ(record.ended, 1u);
  EXPECT_EQ(record.active_largest, 1u);
  EXPECT_GE(record.stencils_tested, record.crossings_tested);
  EXPECT_GT(record.crossings_tested, 0u);
  EXPECT_GT(record.looks, 0u);
}

INSTANTIATE_TEST_SUITE_P(Speeds, ContactRecords,
                         ::testing::Values(Turn{1, .83066808164548}, Turn{100, .51728466849295},
                                           Turn{1e4, .28139636224563}));

TEST(ContactRecord, CountsAContactThatGoesOn) {
  const ContactRecord record = bounce(1, std::make_unique<JorbaZou>(), 0.91);
  EXPECT_EQ(record.begun, 1u);
  EXPECT_EQ(record.ended, 0u);
}

TEST(ContactRecord, HasNoGapWhereNothingCameNear) {
  const ContactRecord record = bounce(1, std::make_unique<JorbaZou>(), 0.5);
  EXPECT_EQ(record.begun, 0u);
  EXPECT_TRUE(std::isinf(record.smallest_gap.value));
}

TEST(ContactRecord, IsOfStepsThatAreGivenToo) {
  const ContactRecord record = bounce(1, std::make_unique<FixedStep>(1e-3), 2.2);
  EXPECT_NEAR(record.smallest_gap.value, .083066808164548, 1e-5);
  EXPECT_EQ(record.begun, 1u);
  EXPECT_EQ(record.ended, 1u);
}

/// A net of 12 x 12 masses whose triangles may touch each other, and do not.
TEST(ContactRecord, OfWhatStaysApartIsNextToNothing) {
  constexpr int n = 12;
  System<double> system(3, std::vector<double>(n * n, 1.0));
  State<double> state{0.0, Coordinates<double>(n * n, 3), Coordinates<double>(n * n, 3)};
  const auto at = [](int i, int j) { return i * n + j; };
  Uniform draw(1);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      state.position.row(at(i, j)) << i, j, 0.3 * std::sin(0.3 * i);
      for (int d = 0; d < 3; ++d) state.velocity(at(i, j), d) = draw(-0.2, 0.2);
    }
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  ContactBarrier contact{
      .surface = Surface(triangles, {}, {}), .rest = state.position, .thickness = 0.05, .stiffness = 1000};
  for (const auto& [a, b] : contact.surface.edges())
    system.add<Spring>({{a, b}}, {{100.0, (state.position.row(a) - state.position.row(b)).norm()}});
  contact.record = std::make_shared<ContactRecord>();
  add(system, contact);
  Lockstep lockstep(taylor(system, 12, std::make_unique<LastTwo>(1e-9)));
  ASSERT_EQ(lockstep.run(state, 4.0, {}).outcome, Outcome::success);
  const ContactRecord& record = *contact.record;
  EXPECT_EQ(record.begun, 0u);
  // Rooms grow until they last for 16 steps: four times, and some looks on the way. Features beside each other are some twenty
  // pairs a vertex; tracks tell of most of them between looks.
  EXPECT_LE(8 * record.looks, lockstep.work().steps);
  EXPECT_LE(record.stencils_tested, 10 * lockstep.work().steps * n * n);
  EXPECT_EQ(record.crossings_tested, 0u);
}

}  // namespace
}  // namespace jetlag::testing::contact_record_test
