// SPDX-License-Identifier: MIT
// Fusion: fewer operations, the same outputs.
#include "jetlag/tape/fusion.hpp"

#include <gmock/gmock.h>

#include <array>
#include <string>
#include <vector>

#include "jetlag/series/functions.hpp"
#include "jetlag/tape/recording.hpp"
#include "support/run_tape.hpp"

namespace jetlag::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

template <Rule... R>
std::string name_of(int rule, RuleList<R...>) {
  const std::array<std::string, sizeof...(R)> names{R::name...};
  return names.at(rule);
}

/// The names of the operations of a tape, in order.
std::vector<std::string> operations(const Tape& tape) {
  std::vector<std::string> names;
  for (const Node& node : tape.nodes)
    if (node.kind == Node::Kind::operation) names.push_back(name_of(node.rule, Rules{}));
  return names;
}

/// The output for v = (3, 5, 7) + (1, 2, 4) t and a parameter: coefficient k.
double value_of(const Tape& tape, double parameter, int k = 0) {
  using J = Jet<double, 2>;
  std::vector<std::array<J, 3>> v{{J(3), J(5), J(7)}};
  for (int c = 0; c < 3; ++c) v[0][c][1] = 1 << c;
  return run_tape(tape, v, std::vector<double>(tape.parameters, parameter), scalar_kernels<double>())[0][k];
}

class Fusion : public ::testing::Test {
 protected:
  Recorded x(int participant, int component) {
    return recording_.input({Input::Kind::position, participant, component});
  }
  Recorded v(int component) { return recording_.input({Input::Kind::velocity, 0, component}); }

  Recording recording_;
};

TEST_F(Fusion, MakesASeparationOfTwoPositionsAnInput) {
  const Tape tape = with_separations(recording_.finish({x(1, 0) - x(0, 0)}));
  ASSERT_EQ(tape.nodes.size(), 1u);
  EXPECT_EQ(tape.nodes[0].input, (Input{Input::Kind::separation, 1, 0}));
}

TEST_F(Fusion, TellsTheTwoSeparationsApart) {
  const Tape tape = with_separations(recording_.finish({x(0, 2) - x(1, 2)}));
  EXPECT_EQ(tape.nodes[0].input, (Input{Input::Kind::separation, 0, 2, 1}));
}

TEST_F(Fusion, LeavesOtherDifferencesAlone) {
  EXPECT_THAT(operations(recording_.finish({x(1, 0) - x(0, 1)})), ElementsAre("subtract"));  // two components
  EXPECT_THAT(operations(recording_.finish({x(0, 1) - x(0, 0)})),
              ElementsAre("subtract"));  // one participant
  EXPECT_THAT(operations(recording_.finish({x(0, 0) - v(0)})), ElementsAre("subtract"));
}

TEST_F(Fusion, MakesSumsOfSquaresASquaredNorm) {
  EXPECT_THAT(operations(recording_.finish({v(0) * v(0) + v(1) * v(1)})), ElementsAre("squared norm of 2"));
  EXPECT_THAT(operations(recording_.finish({v(0) * v(0) + v(1) * v(1) + v(2) * v(2)})),
              ElementsAre("squared norm of 3"));
}

TEST_F(Fusion, MakesSumsOfProductsADotProduct) {
  EXPECT_THAT(operations(recording_.finish({x(0, 0) * v(0) + x(0, 1) * v(1) + x(0, 2) * v(2)})),
              ElementsAre("dot of 3"));
}

TEST_F(Fusion, AddsSeveralTermsAtOnce) {
  EXPECT_THAT(operations(recording_.finish({v(0) + v(1) + v(2)})), ElementsAre("sum of 3"));
  EXPECT_THAT(operations(recording_.finish({v(0) + v(1) + v(2) + x(0, 0) + x(0, 1)})),
              ElementsAre("sum of 4", "add"));
  EXPECT_THAT(operations(recording_.finish({v(0) + v(1)})), ElementsAre("add"));
}

TEST_F(Fusion, MakesAComponentOfACrossProductADifferenceOfProducts) {
  EXPECT_THAT(operations(recording_.finish({v(0) * x(0, 1) - v(1) * x(0, 0)})),
              ElementsAre("difference of products"));
  const Recorded product = v(0) * x(0, 1);
  EXPECT_THAT(operations(recording_.finish({product - v(1) * x(0, 0), product})),  // read elsewhere
              ElementsAre("multiply", "multiply", "subtract"));
}

TEST_F(Fusion, KeepsTheSignsOfADifferenceOfProducts) {
  const Tape tape = recording_.finish({v(0) * v(1) - v(2) * v(0)});
  EXPECT_EQ(value_of(tape, 0), 3 * 5 - 7 * 3);
  EXPECT_EQ(value_of(tape, 0, 1), (3 * 2 + 1 * 5) - (7 * 1 + 4 * 3));
  EXPECT_EQ(value_of(tape, 0, 2), 1 * 2 - 4 * 1);
}

TEST_F(Fusion, AddsScaledValuesInALinearCombination) {
  const Recorded a = recording_.parameter(0), b = recording_.parameter(1);
  EXPECT_THAT(operations(recording_.finish({v(0) + a * v(1) + b * v(2)})),
              ElementsAre("linear combination of 2"));
  EXPECT_THAT(operations(recording_.finish({a * v(1) + b * v(2)})),
              ElementsAre("scale", "linear combination of 1"));
  EXPECT_THAT(
      operations(recording_.finish({v(0) * v(1) + a * x(0, 0) + (v(2) + b * x(0, 1)) + 2.0 * x(0, 2)})),
      UnorderedElementsAre("multiply", "add", "linear combination of 3"));
  Recorded sum = v(0);
  for (int i = 0; i < 9; ++i) sum += recording_.parameter(i) * x(i / 3, i % 3);
  EXPECT_THAT(operations(recording_.finish({sum})),
              ElementsAre("linear combination of 5", "linear combination of 3", "linear combination of 1"));
}

TEST_F(Fusion, TakesScaledValuesAwayByTheirNumber) {
  const Recorded a = recording_.parameter(0);
  const Tape tape = recording_.finish({v(0) - a * v(1) - a * v(2)});
  EXPECT_THAT(operations(tape), ElementsAre("negate", "linear combination of 2"));  // -a is computed once
  EXPECT_EQ(value_of(tape, 2), 3 - 2 * 5 - 2 * 7);
  EXPECT_EQ(value_of(tape, 2, 1), 1 - 2 * 2 - 2 * 4);
  EXPECT_EQ(value_of(tape, 2, 2), 0);
  EXPECT_EQ(value_of(recording_.finish({a * v(0) - (v(1) - a * v(2))}), 2), 2 * 3 - (5 - 2 * 7));
  EXPECT_EQ(value_of(recording_.finish({a * v(0) - a * v(1) + v(2) * v(2)}), 2), 2 * 3 - 2 * 5 + 7 * 7);
}

TEST_F(Fusion, LeavesNothingOfWhatIsAddedAndTakenAway) {  // whatever rounding does to its product
  const Recorded a = recording_.parameter(0);
  const Tape tape = recording_.finish({a * v(0) - a * v(1)});
  EXPECT_THAT(operations(tape), UnorderedElementsAre("scale", "negate", "linear combination of 1"));
  const std::vector<std::array<Jet<double, 2>, 2>> equal(40, {Jet<double, 2>(0.1), Jet<double, 2>(0.1)});
  for (const auto* table : tables_of_all_widths())
    for (const auto& difference : run_tape(tape, equal, std::vector<double>(40, 0.3), *table))
      EXPECT_EQ(difference[0], 0.0) << name(*table);
}

TEST_F(Fusion, LeavesOneScaledValueAlone) {
  const Recorded a = recording_.parameter(0);
  EXPECT_THAT(operations(recording_.finish({v(0) - a * v(1)})), ElementsAre("scale", "subtract"));
  EXPECT_THAT(operations(recording_.finish({v(0) + v(2) + x(0, 0) - a * v(1)})),
              UnorderedElementsAre("sum of 3", "negate", "linear combination of 1"));
  EXPECT_THAT(operations(recording_.finish({v(0) + a * v(1)})), ElementsAre("scale", "add"));
  const Recorded scaled = a * v(1);
  EXPECT_THAT(operations(recording_.finish({v(0) + scaled + a * v(2), scaled})),  // read elsewhere
              UnorderedElementsAre("scale", "scale", "sum of 3"));
}

TEST_F(Fusion, SplitsLongNorms) {
  Recorded sum = v(0) * v(0);
  for (int c : {1, 2}) sum += v(c) * v(c);
  for (int c : {0, 1}) sum += x(0, c) * x(0, c);
  EXPECT_THAT(operations(recording_.finish({sum})),
              ElementsAre("squared norm of 3", "squared norm of 2", "add"));
}

TEST_F(Fusion, KeepsWhatIsReadElsewhere) {
  const Recorded square = v(0) * v(0), norm = square + v(1) * v(1);
  EXPECT_THAT(operations(recording_.finish({norm, square})), UnorderedElementsAre("square", "square", "add"));
  EXPECT_THAT(operations(recording_.finish({norm + v(2) * v(2), norm})),  // the inner sum is an output
              UnorderedElementsAre("squared norm of 2", "square", "add"));
}

TEST_F(Fusion, KeepsCoupledOperationsTogether) {
  const Recorded angle = v(0) * v(0) + v(1) * v(1);
  const Tape tape = recording_.finish({sin(angle) + cos(angle) + v(2)});
  EXPECT_THAT(operations(tape), ElementsAre("squared norm of 2", "sin", "cos", "sum of 3"));
  EXPECT_EQ(tape.nodes[tape.nodes.size() - 3].operands[1], static_cast<int>(tape.nodes.size()) - 2);
  EXPECT_EQ(tape.nodes[tape.nodes.size() - 2].operands[1], static_cast<int>(tape.nodes.size()) - 3);
}

}  // namespace
}  // namespace jetlag::testing
