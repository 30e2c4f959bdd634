// SPDX-License-Identifier: MIT
// Free clocks wake neighbours that have been told wrong things: each time is counted, and it ends.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "schedule/networks.hpp"

namespace jetlag::testing {
namespace {

/// Updates of a run over 1 s, whose ticks are exact doubles: all, those before the end of the step that they end, and
/// those at the time of another of the same particle.
struct Seen {
  std::uint64_t updates = 0, early = 0, repeated = 0;
  Work work;
};
Seen seen(double notify) {
  const Problem scene = stiff_spot_in_a_chain(24, 1e3);
  Asynchronous::Options options;
  options.tolerance = 1e-8;
  options.notify = notify;
  Asynchronous schedule(scene.system, 8, options);
  std::vector<double> begin(scene.system.particles(), -1.0), end(scene.system.particles(), 0.0);
  Seen seen;
  RunOptions run;
  run.observer.on_update = [&](const Update& update) {
    ++seen.updates;
    seen.early += update.begin < end[update.particle];
    seen.repeated += update.begin == begin[update.particle];
    EXPECT_GE(update.begin, begin[update.particle]);
    EXPECT_LE(update.begin, end[update.particle]);
    begin[update.particle] = update.begin;
    end[update.particle] = update.begin + update.step;
  };
  State<double> state = scene.start;
  EXPECT_EQ(schedule.run(state, 1.0, run).outcome, Outcome::success);
  seen.work = schedule.work();
  return seen;
}

TEST(WakeUps, AreTheUpdatesBeforeTheirTime) {
  // At most a hundredth of a tolerance may be hidden: whole ones are, between neighbours so alike.
  const Seen some = seen(1e-2), deaf = seen(std::numeric_limits<double>::infinity());
  EXPECT_GT(some.early, 0u);
  EXPECT_EQ(some.work.wake_ups, some.early);
  EXPECT_EQ(some.work.updates, some.updates);
  EXPECT_EQ(deaf.work.wake_ups, 0u);
  EXPECT_EQ(deaf.early, 0u);
}

TEST(WakeUps, ComeAtMostOnceForAParticleAtATime) {
  // However much is to be told: a thousandth of a tolerance wakes almost everybody.
  for (const double notify : {1.0, 1e-3, 1e-6}) {
    const Seen some = seen(notify);
    EXPECT_EQ(some.repeated, 0u);
    EXPECT_EQ(some.work.wake_ups, some.early);
  }
}

TEST(WakeUps, AreNoneWithBlocks) {
  const Problem scene = stiff_spot_in_a_chain(24, 1e3);
  BlockSteps schedule(scene.system, 8, {});
  State<double> state = scene.start;
  ASSERT_EQ(schedule.run(state, 1.0, {}).outcome, Outcome::success);
  EXPECT_EQ(schedule.work().wake_ups, 0u);
}

}  // namespace
}  // namespace jetlag::testing
