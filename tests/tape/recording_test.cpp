// SPDX-License-Identifier: MIT
// What recording a law leaves on the tape.
#include "jetlag/tape/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/tape/program.hpp"
#include "support/recorded_names.hpp"

namespace jetlag::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

class Record : public ::testing::Test {
 protected:
  Recorded position(int component) { return recording_.input({Input::Kind::position, 0, component}); }

  Recording recording_;
  const Recorded x_ = position(0), y_ = position(1);
  const Recorded a_ = recording_.parameter(0), b_ = recording_.parameter(1);
};

int inputs(const Tape& tape) {
  int count = 0;
  for (const Node& node : tape.nodes) count += node.kind == Node::Kind::input;
  return count;
}

int histories(const Tape& tape) {
  int count = 0;
  for (const bool keeps : tape.keeps_history()) count += keeps;
  return count;
}

// ---- what is recorded ------------------------------------------------------------------------------------

TEST_F(Record, HasTheExampleOfItsFirstPage) {
  EXPECT_THAT(names_of_operations(recording_.finish({-4.0 * x_ * x_})), ElementsAre("scale", "multiply"));
  EXPECT_THAT(names_of_operations(recording_.finish({-4.0 * (x_ * x_)})), ElementsAre("square", "scale"));
}

TEST_F(Record, SharesCommonSubexpressions) {
  const Tape tape = recording_.finish({sqrt(x_ * y_) + sqrt(y_ * x_), sqrt(x_ * y_)});
  EXPECT_THAT(names_of_operations(tape), ElementsAre("multiply", "sqrt", "add"));
  EXPECT_EQ(tape.outputs.size(), 2u);
}

TEST_F(Record, SharesSinAndCosOfTheSameArgument) {
  EXPECT_THAT(names_of_operations(recording_.finish({sin(x_) * cos(x_)})),
              ElementsAre("sin", "cos", "multiply"));
}

TEST_F(Record, SharesConstantsAndParameters) {
  const Tape tape = recording_.finish({2.5 * x_, 2.5 * y_, recording_.parameter(0) * x_ + a_ * y_});
  int constants = 0, parameters = 0;
  for (const Node& node : tape.nodes) {
    constants += node.kind == Node::Kind::constant;
    parameters += node.kind == Node::Kind::parameter;
  }
  EXPECT_EQ(constants, 1);
  EXPECT_EQ(parameters, 1);
}

TEST_F(Record, SeesASquareInAProductWithItself) {
  EXPECT_THAT(names_of_operations(recording_.finish({x_ * x_})), ElementsAre("square"));
  const Recorded same = position(0);
  EXPECT_THAT(names_of_operations(recording_.finish({x_ * same})), ElementsAre("square"));
  EXPECT_THAT(names_of_operations(recording_.finish({pow(x_, 4)})), ElementsAre("square", "square"));
}

TEST_F(Record, TurnsOperationsWithNumbersIntoCheapOnes) {
  EXPECT_THAT(names_of_operations(recording_.finish({a_ * x_})), ElementsAre("scale"));
  EXPECT_THAT(names_of_operations(recording_.finish({x_ * 3.0})), ElementsAre("scale"));
  EXPECT_THAT(names_of_operations(recording_.finish({x_ + a_})), ElementsAre("offset"));
  EXPECT_THAT(names_of_operations(recording_.finish({x_ - 3.0})), ElementsAre("offset"));
  EXPECT_THAT(names_of_operations(recording_.finish({a_ - x_})), ElementsAre("negate", "offset"));
  EXPECT_THAT(names_of_operations(recording_.finish({x_ / a_})), ElementsAre("divide by constant"));
  EXPECT_THAT(names_of_operations(recording_.finish({a_ / x_})), ElementsAre("reciprocal"));
  EXPECT_THAT(names_of_operations(recording_.finish({y_ / x_})), ElementsAre("divide"));
}

TEST_F(Record, DrawsRootsOfTheValuesOfAChoiceBesideANumber) {  // 0 then has the root 0 at all orders
  const auto same = [&](const Recorded& root, const Recorded& choice) {
    EXPECT_EQ(root.node(), choice.node());
  };
  same(sqrt(select(x_ < y_, x_, Recorded(4.0))), select(x_ < y_, sqrt(x_), Recorded(2.0)));
  same(cbrt(max(x_, a_)),
       jetlag::detail::record<BySign>(jetlag::detail::record<Sign>(x_ - a_), cbrt(a_), cbrt(x_)));
  same(pow(-b_ * max(y_, 0.0) / a_, 1.5),
       jetlag::detail::record<BySign>(jetlag::detail::record<Sign>(y_), pow(-b_ * Recorded(0.0) / a_, 1.5),
                                      pow(-b_ * y_ / a_, 1.5)));
  EXPECT_THAT(names_of_operations(recording_.finish({sqrt(max(x_, y_))})),
              ElementsAre("subtract", "sign", "by sign", "sqrt"));  // both move
}

TEST_F(Record, LeavesOutOperationsThatChangeNothing) {
  for (const Recorded& same : {x_ + 0.0, 0.0 + x_, x_ - 0.0, 1.0 * x_, x_ * 1.0, x_ / 1.0, +x_, pow(x_, 1)})
    EXPECT_EQ(same.node(), x_.node());
}

TEST_F(Record, ComputesPlainNumbersAtOnce) {
  EXPECT_THAT(
      names_of_operations(recording_.finish({x_ * (Recorded(2.0) + Recorded(3.0)) * sqrt(Recorded(4.0))})),
      ElementsAre("scale", "scale"));
  const Recorded one = 1.0, angle = 0.5;
  EXPECT_EQ((one + one).value(), 2.0);
  EXPECT_EQ(exp(one).value(), std::exp(1.0));
  EXPECT_EQ(sin(angle).value(), std::sin(0.5));
  EXPECT_EQ(cos(angle).value(), std::cos(0.5));
  EXPECT_EQ(pow(angle, -1.5).value(), std::pow(0.5, -1.5));
}

TEST_F(Record, GivesNoSeriesToConstantsAndParameters) {
  const Tape tape = recording_.finish({sqrt(a_ * a_ + b_) * x_});
  EXPECT_THAT(names_of_operations(tape), ElementsAre("[multiply]", "[add]", "[sqrt]", "scale"));
  EXPECT_EQ(histories(tape), 0);
  EXPECT_FALSE(tape.is_static());
  EXPECT_TRUE(recording_.finish({sin(a_) - 2.0}).is_static());
}

TEST_F(Record, PrunesWhatNoOutputNeeds) {
  const Recorded unused = exp(x_ * y_) + b_;
  const Tape tape = recording_.finish({2.0 * y_});
  EXPECT_THAT(names_of_operations(tape), ElementsAre("scale"));
  EXPECT_EQ(inputs(tape), 1);
  EXPECT_EQ(names_of_operations(recording_.finish({unused})).size(), 3u);  // still there for a later tape
}

TEST_F(Record, KeepsTheHistoryOnlyOfWhatARuleReads) {
  EXPECT_EQ(histories(recording_.finish({x_ + y_ - 3.0 * x_})), 0);  // linear: newest coefficients only
  EXPECT_EQ(histories(recording_.finish({x_ * y_})), 2);             // both factors, not the product
  EXPECT_EQ(histories(recording_.finish({sqrt(x_)})), 1);            // the root, not its argument
  EXPECT_EQ(histories(recording_.finish({y_ / x_})), 2);             // divisor and quotient
  EXPECT_EQ(histories(recording_.finish({sin(x_)})), 3);             // argument, sine and cosine
}

// ---- the laws of the house -------------------------------------------------------------------------------

TEST(RecordedSpring, KeepsFiveHistories) {  // three differences, the length, the tension over the length
  EXPECT_EQ(Program(record_law<Spring>(3).force).histories, 5);
  EXPECT_EQ(Program(record_law<Spring>(2).force).histories, 4);
}

TEST(RecordedSpring, ReadsTheSeparationOnly) {
  const Tape tape = record_law<Spring>(3).force;
  EXPECT_EQ(inputs(tape), 3);
  for (const Node& node : tape.nodes) {
    if (node.kind == Node::Kind::input) {
      EXPECT_EQ(node.input.kind, Input::Kind::separation);
    }
  }
  EXPECT_THAT(names_of_operations(tape),
              UnorderedElementsAre("squared norm of 3", "sqrt", "[negate]", "offset", "scale",  // k (|d| - L)
                                   "divide", "multiply", "multiply", "multiply"));
}

TEST(RecordedDrag, KeepsNoHistory) {
  const Program program(record_law<Drag>(3).force);
  EXPECT_EQ(program.histories, 0);
  EXPECT_EQ(program.instructions.size(), 3u);
  EXPECT_EQ(program.preparation.size(), 1u);
}

TEST(RecordedUniformField, HasNoSeries) {
  const Program program(record_law<UniformField>(3).force);
  EXPECT_TRUE(program.is_static);
  EXPECT_TRUE(program.instructions.empty());
  EXPECT_TRUE(program.inputs.empty());
}

// ---- what is refused -------------------------------------------------------------------------------------

TEST_F(Record, RefusesAValueOfAnotherRecording) {
  Recording other;
  for (int i = 0; i < 100; ++i) other.parameter(i);
  const Recorded stranger =
      other.input({Input::Kind::position, 0, 0});  // a node number that does not exist here
  EXPECT_THROW(x_ + stranger, std::invalid_argument);
  EXPECT_THROW(stranger - x_, std::invalid_argument);
  EXPECT_THROW(x_ / stranger, std::invalid_argument);
  EXPECT_THROW(a_ * other.parameter(0), std::invalid_argument);
  EXPECT_THROW(recording_.finish({stranger}), std::invalid_argument);
}

TEST_F(Record, RefusesAValueOfAnotherRecordingUnderTheSameNumber) {
  Recording other;
  const Recorded twin = other.input({Input::Kind::position, 0, 0});
  ASSERT_EQ(twin.node(), x_.node());
  EXPECT_THROW(x_ * twin, std::invalid_argument);  // not a square
}

TEST_F(Record, RefusesAnExponentThatMoves) {
  EXPECT_THROW((lift<Power, Recorded>(y_, x_)), std::invalid_argument);
  EXPECT_NO_THROW((lift<Power, Recorded>(a_, x_)));
}

TEST(RecordLaw, RefusesADimensionThatSpaceDoesNotHave) {
  EXPECT_THROW(record_law<Spring>(0), std::invalid_argument);
  EXPECT_THROW(record_law<Spring>(4), std::invalid_argument);
}

template <class T>
concept AnswersNow =
    requires(T x) { x == x; } || requires(T x) { x ? 1 : 0; } || requires(T x) { static_cast<double>(x); };
static_assert(AnswersNow<double>);
static_assert(!AnswersNow<Recorded>, "a law cannot branch on a value that is being recorded");

}  // namespace
}  // namespace jetlag::testing
