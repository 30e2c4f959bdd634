// SPDX-License-Identifier: MIT
// The conditions of a tape: what decides its choices.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "jetlag/tape/program.hpp"
#include "jetlag/tape/recording.hpp"

namespace jetlag::testing::conditions_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

class Conditions : public ::testing::Test {
 protected:
  Recording recording_;
  const Recorded x_ = recording_.input({Input::Kind::position, 0, 0}),
                 y_ = recording_.input({Input::Kind::position, 0, 1}), a_ = recording_.parameter(0);

  /// Of a tape with this output at x = 5, y = 3, a = 2: their values and what a zero is taken for.
  std::vector<std::pair<double, int>> of(const Recorded& output) {
    const Program program(with_conditions(recording_.finish({output})));
    Blocks<double> blocks(program, 1, std::vector<double>(program.parameters, 2.0), scalar_kernels<double>());
    blocks.reserve(1);
    for (const auto& [place, input] : program.inputs) *blocks.at(0, place, 0) = input.component == 0 ? 5 : 3;
    blocks.run(0, 0);
    std::vector<std::pair<double, int>> all;
    for (const auto& [place, at_zero, argument] : program.conditions) {
      EXPECT_EQ(place.space, Place::Space::history);
      all.emplace_back(*blocks.at(0, place, 0), at_zero);
    }
    return all;
  }
};

TEST_F(Conditions, OfComparisonsAreDifferences) {
  EXPECT_THAT(of(select(x_ < y_, x_, y_)), ElementsAre(Pair(2, 1)));
  EXPECT_THAT(of(select(x_ <= y_, x_, y_)), ElementsAre(Pair(2, -1)));
  EXPECT_THAT(of(select(x_ < a_, x_, y_)), ElementsAre(Pair(3, 1)));
  EXPECT_THAT(of(select(a_ < x_, x_, y_)), ElementsAre(Pair(3, -1)));  // x - a, at zero not above
  EXPECT_THAT(of(select(a_ <= x_, x_, y_)), ElementsAre(Pair(3, 1)));
  EXPECT_THAT(of(select(x_ < 0.0, x_, y_)), ElementsAre(Pair(5, 1)));
  EXPECT_THAT(of(select(x_ < 1.0 && y_ < 1.0, x_, y_)), ElementsAre(Pair(4, 1), Pair(2, 1)));
}

TEST_F(Conditions, OfSignsAndRootsAreTheirOwn) {
  EXPECT_THAT(of(abs(x_)), ElementsAre(Pair(5, 0)));
  EXPECT_THAT(of(max(x_, y_)), ElementsAre(Pair(2, 0)));
  EXPECT_THAT(of(sqrt(x_ + 4.0)), ElementsAre(Pair(3, 0)));
  EXPECT_THAT(of(pow(x_ + 4.0, 1.5)), ElementsAre(Pair(27, 0)));
  EXPECT_THAT(of(pow(x_ + 4.0, a_)), ElementsAre(Pair(81, 0)));
}

TEST_F(Conditions,
       OfStretchInvariantsAreWhereTheRotationJumps) {  // of stretches 5, 3, 1: (5 + 3) (3 + 1) (1 + 5)
  const Recorded xx = x_ * x_, yy = y_ * y_;
  const auto [a, b] = stretch_invariants(xx + yy + 1.0, xx * yy + xx + yy, x_ * y_);
  EXPECT_THAT(of(a), ElementsAre(Pair(192, 0)));
  EXPECT_THAT(of(1.0 / (a * b - x_ * y_)), ElementsAre(Pair(192, 0)));
}

TEST_F(Conditions, OfRootsKnowWhatIsDrawnWhereItMayCrossZero) {
  const auto argument_of = [&](const Recorded& root) {
    const Tape tape = with_conditions(recording_.finish({root}));
    return std::pair(tape.conditions.at(0).argument, tape.nodes[tape.conditions[0].node].operands.back());
  };
  for (const Recorded& root : {sqrt(x_ + 4.0), pow(x_ * y_, 1.5)}) {
    const auto [argument, operand] = argument_of(root);
    EXPECT_EQ(argument, operand);
  }
  for (const Recorded& root : {sqrt(x_ * x_ + y_ * y_), sqrt(x_ * x_), hypot(x_, y_)})
    EXPECT_EQ(argument_of(root).first, -1);
}

TEST_F(Conditions, AreNoneWhereNothingIsDecided) {
  EXPECT_THAT(of(x_ * y_ + exp(x_)), IsEmpty());
  EXPECT_THAT(of(pow(x_, -1.5)), IsEmpty());  // poles
  EXPECT_THAT(of(pow(x_, -(a_ + 1.0))), IsEmpty());
  EXPECT_THAT(of(select(a_ < 1.0, x_, y_)), IsEmpty());  // decided for good
}

TEST_F(Conditions, OfWhatIsNotReadAreNone) {
  abs(x_ - y_);
  EXPECT_THAT(of(x_ * y_), IsEmpty());
}

}  // namespace
}  // namespace jetlag::testing::conditions_test
