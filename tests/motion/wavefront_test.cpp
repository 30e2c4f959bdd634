// SPDX-License-Identifier: MIT
// The wavefront keeps its promises whatever the number of workers.
#include "jetlag/motion/wavefront.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <stdexcept>
#include <vector>

namespace jetlag::testing {
namespace {

/// Chunks that need neighbours up to three further on.
std::vector<std::size_t> random_needs(std::size_t chunks) {
  std::mt19937 random(3);
  std::vector<std::size_t> needed;
  for (std::size_t c = 0; c < chunks; ++c) needed.push_back(std::min(chunks - 1, c + random() % 4));
  return needed;
}

TEST(Wavefront, RunsEachChunkOnceInEachPassAfterWhatItNeeds) {
  constexpr std::size_t chunks = 37, passes = 9;
  const auto needed = random_needs(chunks);
  for (const int threads : {1, 2, 4}) {
    Wavefront front(needed);
    std::vector<std::atomic<std::size_t>> ended(passes);  // chunks that have ended each pass
    std::vector<std::atomic<int>> runs(passes * chunks);
    front(
        passes, Workers(threads),
        [&](std::size_t c, std::size_t p) {
          ++runs[p * chunks + c];
          if (p > 0) {
            EXPECT_GT(ended[p - 1], needed[c]) << "chunk " << c << ", pass " << p;
          }
        },
        [&](std::size_t c, std::size_t p) {
          for (std::size_t before = 0; before <= c; ++before) EXPECT_EQ(runs[p * chunks + before], 1);
          EXPECT_EQ(ended[p]++, c) << "in order, pass " << p;
        });
    for (const auto& all : ended) EXPECT_EQ(all, chunks);
  }
}

TEST(Wavefront, LeadsAChunkThroughAllPassesBeforeTheNextWhereNothingIsNeeded) {
  Wavefront front({0, 1, 2});
  std::vector<std::size_t> order;
  front(2, Workers(1), [&](std::size_t c, std::size_t p) { order.push_back(10 * c + p); }, [](auto, auto) {});
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 10, 11, 20, 21}));
}

TEST(Wavefront, HandsOnAnException) {
  for (const int threads : {1, 3}) {
    Wavefront front(random_needs(20));
    const auto run = [&] {
      front(
          3, Workers(threads),
          [](std::size_t c, std::size_t) {
            if (c == 7) throw std::runtime_error("chunk 7");
          },
          [](auto, auto) {});
    };
    EXPECT_THROW(run(), std::runtime_error);
    EXPECT_THROW(run(), std::runtime_error);  // and can be used again
  }
}

TEST(Workers, AreAtLeastOne) { EXPECT_THROW(Workers(0), std::invalid_argument); }

TEST(Workers, DoEachTaskOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> done(1000);
    Workers(threads).each(done.size(), [&](std::size_t i) { ++done[i]; });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
}

}  // namespace
}  // namespace jetlag::testing
