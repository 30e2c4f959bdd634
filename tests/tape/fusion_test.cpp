// SPDX-License-Identifier: MIT
// Fusion: fewer operations, the same outputs.
#include "jetlag/tape/fusion.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "jetlag/series/functions.hpp"
#include "jetlag/tape/recording.hpp"

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
