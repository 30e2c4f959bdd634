// SPDX-License-Identifier: MIT
// Large scenes go chunk by chunk, in threads: the same motion, and the same bits for any number of them.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/model/model.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag::testing::large_scenes_test {
namespace {

constexpr int side = 45;  // 45 x 45 particles, some 4000 springs: two chunks of 2048
constexpr int degree = 9;

/// A square net, its particles numbered at random unless told.
struct Net {
  explicit Net(bool shuffled) : number(side * side) {
    for (int i = 0; i < side * side; ++i) number[i] = i;
    std::mt19937 random(5);
    if (shuffled) std::shuffle(number.begin(), number.end(), random);
    state.position.resize(side * side, 3);
    state.velocity.resize(side * side, 3);
    std::uniform_real_distribution<double> noise(-0.1, 0.1);
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const int a = number[i * side + j];
        state.position.row(a) << i + noise(random), j + noise(random), noise(random);
        state.velocity.row(a) << noise(random), noise(random), noise(random);
        if (i + 1 < side) pairs.push_back({a, number[(i + 1) * side + j]});
        if (j + 1 < side) pairs.push_back({a, number[i * side + j + 1]});
      }
  }

  System<> system(bool with_drag) const {
    System<> all(3, std::vector<double>(side * side, 0.5));
    all.fix(number[0]);
    if (with_drag) {
      std::vector<std::array<int, 1>> each;
      for (int i = 0; i < side * side; ++i) each.push_back({i});
      all.add<Drag>(each, {{0.2}});
      all.add<UniformField>(each, {{0.0, 0.0, -9.8}});
    }
    all.add<Spring>(pairs, {{80.0, 0.9}});
    return all;
  }

  State<> start() const {
    State<> at_rest = state;
    at_rest.velocity.row(number[0]).setZero();
    return at_rest;
  }

  std::vector<int> number;
  std::vector<std::array<int, 2>> pairs;
  State<> state;
};

Expansion<> grown(const System<>& system, const State<>& state, int threads) {
  Expansion<> series(system, degree, kernels<double>(), Workers(threads));
  series.start(state);
  series.grow_to(degree);
  return series;
}

class LargeScenes : public ::testing::TestWithParam<bool> {};  // with drag

TEST_P(LargeScenes, HaveTheSameBitsForAnyNumberOfThreads) {
  const Net net(true);
  const auto system = net.system(GetParam());
  const auto one = grown(system, net.start(), 1);
  for (const int threads : {2, 4, 8}) {
    const auto many = grown(system, net.start(), threads);
    EXPECT_EQ(many.element_coefficients(), one.element_coefficients());
    for (int k = 0; k <= degree; ++k) EXPECT_EQ(many.position(k), one.position(k)) << k;
  }
}

TEST_P(LargeScenes, HaveTheSameBitsGrownAtOnceOrStepByStep) {
  const Net net(false);
  const auto system = net.system(GetParam());
  const auto at_once = grown(system, net.start(), 1);
  Expansion<> series(system, 2, kernels<double>(), Workers(2));
  series.start(net.start());
  while (series.order() < degree) series.grow();
  for (int k = 0; k <= degree; ++k) EXPECT_EQ(series.position(k), at_once.position(k)) << k;
}

TEST_P(LargeScenes, MoveAsTheyDoInOneChunk) {
  // The scalar kernels have chunks of 64 springs, the wide ones of 2048, and add up in another order: coefficient k then
  // differs by its rounding, some 6 forces of size k |d| a particle, amplified at each order by the growth of the series.
  const Net net(true);
  const auto system = net.system(GetParam());
  const auto wide = grown(system, net.start(), 1);
  Expansion<> narrow(system, degree, scalar_kernels<double>());
  narrow.start(net.start());
  narrow.grow_to(degree);
  for (int k = 0; k <= degree; ++k)
    EXPECT_LE((wide.position(k) - narrow.position(k)).cwiseAbs().maxCoeff(),
              1e-15 * (1 + k * k) * (1 + narrow.position(k).cwiseAbs().maxCoeff()))
        << k;
}

INSTANTIATE_TEST_SUITE_P(Forces, LargeScenes, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "SpringsDragAndField" : "Springs"; });

TEST(LargeScenes, TakeAtMostOneKibibyteForASpring) {
  System<> cloth(3, std::vector<double>(50 * 50, 1.0));
  std::vector<std::array<int, 2>> pairs;  // structural, shear, bend: six a particle
  const auto add = [&](int i, int j, int k, int l) {
    if (k < 50 && 0 <= l && l < 50) pairs.push_back({50 * i + j, 50 * k + l});
  };
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 50; ++j)
      for (const auto& [k, l] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 0}, {0, 2}})
        add(i, j, i + k, j + l);
  cloth.add<Spring>(pairs, {{1.0, 1.0}});
  EXPECT_LE(Expansion<>(cloth, 16).bytes(), 1024 * pairs.size());
}

TEST(ParticleOrder, BringsNeighboursTogether) {
  const Net net(true);
  const auto rank = Model<>(net.system(false)).rank();
  ASSERT_EQ(rank.size(), net.number.size());
  int furthest = 0;
  for (const auto& [a, b] : net.pairs) furthest = std::max(furthest, std::abs(rank[a] - rank[b]));
  EXPECT_LE(furthest,
            side + 1);  // breadth first from a corner goes along diagonals of at most `side` particles
}

TEST(ParticleOrder, KeepsAnOrderThatIsAsGood) {
  const auto rank = Model<>(Net(false).system(false)).rank();
  for (int i = 0; i < side * side; ++i) EXPECT_EQ(rank[i], i);
}

}  // namespace
}  // namespace jetlag::testing::large_scenes_test
