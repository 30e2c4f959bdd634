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

constexpr int side = 45;  // 45 x 45 particles, some 4000 springs: eight chunks of 512
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

TEST_P(LargeScenes, GoOnFromALookAheadWithTheBitsOfAStart) {
  const Net net(true);
  const auto system = net.system(GetParam());
  State<> next = net.start();
  next.position += 0.01 * next.velocity;
  for (const bool has_rest : {false, true})
    for (const int threads : {1, 2})
      for (const int order : {2, 3}) {
        if (has_rest) next.position_rest = 1e-18 * Coordinates<double>::Ones(side * side, 3);
        Expansion<> series(system, degree, kernels<double>(), Workers(threads));
        series.start(net.start());
        series.grow_to(degree);
        series.look_ahead(next, order);
        series.start(next);
        ASSERT_EQ(series.order(), order);
        series.grow_to(degree);
        const auto fresh = grown(system, next, 1);
        for (int k = 0; k <= degree; ++k) EXPECT_EQ(series.position(k), fresh.position(k)) << k;
      }
}

TEST_P(LargeScenes, MoveAsTheyDoInOneChunk) {
  // The scalar kernels have chunks of 16 springs, the wide ones of up to 512, and add up in another order: coefficient k then
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

/// A cloth of so many rows of 20 particles with structural, shear and bend springs: six a particle.
System<> ribbon(int rows) {
  System<> cloth(3, std::vector<double>(rows * 20, 1.0));
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 20; ++j)
      for (const auto& [k, l] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 0}, {0, 2}})
        if (i + k < rows && 0 <= j + l && j + l < 20) pairs.push_back({20 * i + j, 20 * (i + k) + j + l});
  cloth.add<Spring>(pairs, {{1.0, 0.9}});
  return cloth;
}

State<> flat(int rows) {
  State<> state;
  state.position.setZero(rows * 20, 3);
  state.velocity.setZero(rows * 20, 3);
  for (int i = 0; i < rows * 20; ++i) state.position.row(i) << i / 20, i % 20, 0.01 * (i % 7);
  return state;
}

/// Bytes that `more` rows of a ribbon cost beside `rows`, a spring.
double bytes_of_a_spring(int rows, int more, bool piece_by_piece) {
  const auto held = [&](int of) {
    Expansion<> series(ribbon(of), 16);
    series.start(flat(of));
    if (piece_by_piece) series.grow_to(8);
    series.grow_to(16);
    return static_cast<double>(series.bytes());
  };
  return (held(rows + more) - held(rows)) / (6.0 * 20 * more);
}

// A spring keeps five series of 15 orders: 600 bytes. A particle has 17 coefficients of positions and velocities of four
// numbers each, 1088 bytes, and six springs; with rows of forces, indices and parameters a spring takes less than 350.
TEST(LargeScenes, KeepHistoriesOfChunksUnderWayOnly) { EXPECT_LE(bytes_of_a_spring(300, 300, false), 350); }

TEST(LargeScenes, KeepAllHistoriesWhereTheyGrowPieceByPiece) {
  EXPECT_GE(bytes_of_a_spring(300, 300, true), 600);
  EXPECT_LE(bytes_of_a_spring(300, 300, true), 1024);
}

// Between two passes there are two rows of 400 springs, at least two chunks of 512, so that at degree 40, in twenty passes, forty
// chunks or more are under way, each of 512 springs with five series of 39 orders: 32 MB, which go in two sweeps.
TEST(LargeScenes, HaveTheSameBitsInTwoSweeps) {
  constexpr int n = 100, order = 40;
  System<> cloth(3, std::vector<double>(n * n, 1.0));
  std::vector<std::array<int, 2>> pairs;
  State<> state;
  state.position.resize(n * n, 3);
  state.velocity.setZero(n * n, 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      state.position.row(n * i + j) << i, j + 0.05 * (i % 5), 0.02 * ((i + j) % 7);
      for (const auto& [k, l] : {std::pair{1, 0}, {0, 1}, {2, 0}, {0, 2}})
        if (i + k < n && j + l < n) pairs.push_back({n * i + j, n * (i + k) + j + l});
    }
  cloth.add<Spring>(pairs, {{1.0, 0.9}});
  Expansion<> series(cloth, order), kept(cloth, order);
  series.start(state);
  series.grow_to(order);
  kept.start(state);
  for (const int piece : {5, 9, order}) kept.grow_to(piece);  // keeps all histories
  EXPECT_EQ(series.element_coefficients(), kept.element_coefficients());
  for (int k = 0; k <= order; ++k) EXPECT_EQ(series.position(k), kept.position(k)) << k;
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
