// SPDX-License-Identifier: MIT
// The queue of clocks: the same order as a sorted set gives, and never more entries than clocks.

#include "jetlag/schedule/event_queue.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "support/random.hpp"

namespace jetlag::testing {
namespace {

TEST(EventQueue, GivesTheEarliestAndOfThoseTheLeastNumber) {
  // Few different times, so that most are ties.
  for (int clocks : {1, 2, 5, 6, 100, 1000}) {
    EventQueue queue(clocks);
    std::set<std::pair<EventQueue::Time, int>> sorted;
    std::vector<EventQueue::Time> time(clocks, EventQueue::never);
    for (int i = 0; i < clocks; ++i) sorted.insert({time[i], i});
    EXPECT_TRUE(queue.empty());
    Uniform random(clocks);
    for (int change = 0; change < 20000; ++change) {
      const int i = static_cast<int>(random(0, clocks));
      const auto t = random(0, 10) < 1 ? EventQueue::never : static_cast<EventQueue::Time>(random(0, 50));
      sorted.erase({time[i], i});
      sorted.insert({t, i});
      time[i] = t;
      queue.set(i, t);
      ASSERT_EQ(queue.time(), sorted.begin()->first);
      ASSERT_EQ(queue.clock(), sorted.begin()->second);
      ASSERT_EQ(queue.time_of(i), t);
      ASSERT_EQ(queue.size(), static_cast<std::size_t>(clocks));
    }
  }
}

TEST(EventQueue, OfNoClocksIsEmpty) {
  const EventQueue queue;
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.time(), EventQueue::never);
}

}  // namespace
}  // namespace jetlag::testing
