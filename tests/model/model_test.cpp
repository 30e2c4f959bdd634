// SPDX-License-Identifier: MIT
// One compiled form of a system, shared; elements that come and go make its next epoch.
#include "jetlag/model/model.hpp"

#include <gmock/gmock.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/motion/partial_expansion.hpp"
#include "support/laws/laws_of_many.hpp"
#include "support/random.hpp"

namespace jetlag::testing::model_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using Pairs = std::vector<std::array<int, 2>>;

/// Particles in a row, some of whose pairs are springs beside tetrahedra, gravity and drag.
struct Row {
  int count;
  State<double> start;

  explicit Row(int count) : count(count), start{0.0, Coordinates<>(count, 3), Coordinates<>(count, 3)} {
    Uniform random(5);
    for (int i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) {
        start.position(i, c) = (c == 0 ? i : 0) + random(-0.3, 0.3);
        start.velocity(i, c) = i == 0 ? 0.0 : random(-0.2, 0.2);
      }
  }
  /// Every `step`-th pair (i, i + 1) and (i, i + 2).
  Pairs springs(int step) const {
    Pairs pairs;
    for (int i = 0; i + 2 < count; ++i)
      if (step > 0 && i % step == 0) {
        pairs.push_back({i, i + 1});
        pairs.push_back({i, i + 2});
      }
    return pairs;
  }
  static std::vector<double> parameters(const Pairs& pairs) {
    std::vector<double> each;
    for (const auto& [i, j] : pairs) each.insert(each.end(), {3.0 + 0.1 * i, 0.9 + 0.01 * j});
    return each;
  }
  static std::vector<int> flat(const Pairs& pairs) {
    std::vector<int> all;
    for (const auto& [i, j] : pairs) all.insert(all.end(), {i, j});
    return all;
  }
  System<double> system(int step, int drags) const {
    System<double> all(3, std::vector<double>(count, 0.5));
    all.fix(0);
    std::vector<std::array<int, 4>> cells;
    for (int i = 0; i + 3 < count; i += 2) cells.push_back({i, i + 1, i + 2, i + 3});
    all.add<Tetrahedron>(cells, {{2.0, 0.1}});
    all.add(record_law<Spring>(3), flat(springs(step)), parameters(springs(step)));
    std::vector<int> slowed;
    for (int i = 0; i < drags; ++i) slowed.push_back(i);
    all.add(record_law<Drag>(3), slowed, {0.2});
    return all;
  }
  /// The springs of a model become others.
  Model<double> with_springs(const Model<double>& model, int step) const {
    return model.with(1, flat(springs(step)), parameters(springs(step)));
  }
};

void expect_same_series(Expansion<double>& one, Expansion<double>& other, const State<double>& start) {
  for (auto* series : {&one, &other}) {
    series->start(start);
    series->grow_to(9);
  }
  for (int k = 0; k <= 9; ++k) EXPECT_EQ(one.position(k), other.position(k)) << k;
}

TEST(Model, OfTheNextEpochRunsLikeThatOfASystemWithItsElements) {
  const Row row(40);
  const Model<double> first = row.system(3, 10);
  for (const int step : {1, 2, 5, 0}) {
    const Model<double> next = row.with_springs(first, step);
    const System<double> system = row.system(step, 10);
    EXPECT_EQ(next.epoch(), 1u);
    Expansion<double> made(next), moved(first), fresh(system);
    moved.start(row.start);
    moved.grow_to(6);
    moved.move_to(next);
    expect_same_series(made, fresh, row.start);
    expect_same_series(moved, fresh, row.start);

    EnergyMeter energy(next), moved_energy(first), fresh_energy(system);
    moved_energy.move_to(next);
    EXPECT_EQ(energy(row.start).total(), fresh_energy(row.start).total());
    EXPECT_EQ(moved_energy(row.start).total(), fresh_energy(row.start).total());

    const auto grown = [&](PartialExpansion& part) {
      std::vector<int> places(row.count, -1);
      part.choose(std::vector{7, 8, 20}, places);
      for (int k = 0; k <= 6; ++k)
        for (int c = 0; c < 3; ++c) {
          for (std::size_t a = 0; a < part.active().size() && k < 2; ++a)
            part.active_row(k, a)[c] = fresh.position(k)(part.active()[a], c);
          for (std::size_t b = 0; b < part.known().size(); ++b)
            part.known_row(k, b)[c] = fresh.position(k)(part.known()[b], c);
        }
      part.grow_to(6, 0.0);
      std::vector<double> rows;
      for (int k = 0; k <= 6; ++k)
        rows.insert(rows.end(), part.active_row(k, 0), part.active_row(k, 0) + 3 * part.stride());
      return rows;
    };
    PartialExpansion part(next, 6), moved_part(first, 6), fresh_part(system, 6);
    grown(moved_part);
    moved_part.move_to(next);
    const auto expected = grown(fresh_part);
    EXPECT_EQ(grown(part), expected);
    EXPECT_EQ(grown(moved_part), expected);
  }
}

TEST(Model, MayLoseTheForcesThatReadVelocitiesAndGetThemBack) {  // which go order by order
  const Row row(12);
  const Model<double> slowed = row.system(1, 12), free = slowed.with(2, {}, {}),
                      again = free.with(2, {1, 2}, {0.2, 0.2});
  Expansion<double> moved(slowed), without(row.system(1, 0)), fresh(row.system(1, 12));
  moved.move_to(free);
  expect_same_series(moved, without, row.start);
  moved.move_to(slowed);
  expect_same_series(moved, fresh, row.start);
  moved.move_to(again);
  Expansion<double> made(again);
  expect_same_series(moved, made, row.start);
  EXPECT_EQ(again.epoch(), 2u);
}

TEST(Model, MayGrowToALargeSceneAndBack) {  // of ten chunks of 512 springs at most, and of three
  const Row row(2500);
  const Model<double> small = row.system(4, 0), large = row.with_springs(small, 1);
  Expansion<double> moved(small, 9, kernels<double>(), Workers(2)), made_large(large), made_small(small);
  moved.move_to(large);
  expect_same_series(moved, made_large, row.start);
  moved.move_to(small);
  expect_same_series(moved, made_small, row.start);
}

TEST(Model, MayLoseTheForcesOfALargeSceneAndGetAFewBack) {
  const Row row(2500);
  const Model<double> large = row.with_springs(row.system(4, 0), 1), none = large.with(1, {}, {}),
                      few = row.with_springs(large, 40);
  Expansion<double> moved(large), made(few);
  moved.start(row.start);
  moved.grow_to(6);
  moved.move_to(none);
  moved.move_to(few);
  expect_same_series(moved, made, row.start);
}

TEST(Model, IsNoEpochOfAnother) {
  const Row row(12);
  const Model<double> one = row.system(1, 12), other = row.system(1, 12);
  const auto refused = ThrowsMessage<std::invalid_argument>(HasSubstr("another epoch of the same model"));
  EXPECT_THAT([&] { Expansion<double>(one).move_to(other); }, refused);
  EXPECT_THAT([&] { PartialExpansion(one, 6).move_to(other); }, refused);
  EXPECT_THAT([&] { EnergyMeter(one).move_to(other); }, refused);
}

TEST(Model, SharesWhatStays) {
  const Row row(10);
  const Model<double> first = row.system(1, 10), copy = first, next = row.with_springs(first, 2);
  EXPECT_EQ(&copy.law(0), &first.law(0));
  EXPECT_EQ(&next.law(0), &first.law(0));
  EXPECT_NE(&next.law(1), &first.law(1));
  EXPECT_EQ(&next.law(2).forces(), &first.law(2).forces());
  EXPECT_EQ(first.law(1).count(), 16u);  // is what it was
  EXPECT_EQ(next.law(1).count(), 8u);
}

TEST(Model, KnowsWhoTakesPartInWhat) {
  const Row row(8);
  const Model<double> model = row.system(4, 3);  // tetrahedra 0 .. 3, 2 .. 5, 4 .. 7; springs 0-1 0-2 4-5 4-6
  const auto list = [](std::span<const int> of) { return std::vector<int>(of.begin(), of.end()); };
  EXPECT_THAT(list(model.law(0).of(3)), ElementsAre(0, 1));
  EXPECT_THAT(list(model.law(0).particles_of(1)), ElementsAre(2, 3, 4, 5));
  EXPECT_THAT(list(model.law(1).of(4)), ElementsAre(2, 3));
  EXPECT_THAT(list(model.law(2).of(5)), ElementsAre());
  EXPECT_THAT(list(model.neighbours(1)), ElementsAre(2, 3));  // 0 is fixed
  EXPECT_THAT(list(model.neighbours(4)), ElementsAre(2, 3, 5, 6, 7));
  EXPECT_EQ(model.inverse_mass(0), 0.0);
  EXPECT_EQ(model.inverse_mass(1), 2.0);
}

TEST(Model, RefusesElementsAsASystemDoes) {
  const Row row(6);
  const Model<double> model = row.system(1, 3);
  EXPECT_THAT([&] { model.with(3, {}, {}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("law 3 does not exist, there are 3")));
  EXPECT_THAT([&] { model.with(1, {0, 6}, {1.0, 1.0}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("particle 6 does not exist")));
  EXPECT_THROW(model.with(1, {0, 0}, {1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(model.with(0, {0, 1, 2}, {1.0, 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::model_test
