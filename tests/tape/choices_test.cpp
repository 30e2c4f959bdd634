// SPDX-License-Identifier: MIT
// Choices on tapes: each element decides for itself, and only at order 0.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "jetlag/series/comparisons.hpp"
#include "jetlag/tape/recording.hpp"
#include "support/random.hpp"
#include "support/recorded_names.hpp"
#include "support/run_tape.hpp"

namespace jetlag::testing::choices_test {
namespace {

using ::testing::ElementsAre;

constexpr int degree = 6;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using J = Jet<double, degree>;
using Pair = std::array<J, 2>;

/// The law f(x, y) on a tape.
template <class F>
Tape tape_of(F f) {
  Recording recording;
  const Recorded x = recording.input({Input::Kind::position, 0, 0}),
                 y = recording.input({Input::Kind::position, 0, 1});
  return recording.finish({f(x, y)});
}

/// Series whose first coefficients are -1, 0 or 1, so that ties, zeros and kinks of all orders are frequent.
std::vector<Pair> elements_with_ties() {
  Uniform draw(11);
  std::vector<Pair> elements(200);
  for (auto& pair : elements)
    for (J& u : pair)
      for (int k = 0; k <= degree; ++k) u[k] = k < 4 ? std::floor(draw(-1, 2)) : draw(-1, 1);
  return elements;
}

/// Each element of the tape has the jet's value, or NaN where that is NaN: choosing rounds nothing.
template <class F>
void expect_jets(F f, const std::vector<Pair>& elements) {
  const Tape tape = tape_of(f);
  for (const auto* table : available_kernels()) {
    SCOPED_TRACE(table->instruction_set);
    const auto results = run_tape(tape, elements, {}, *table);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const J jet = f(elements[e][0], elements[e][1]);
      for (int k = 0; k <= degree; ++k)
        EXPECT_TRUE(results[e][k] == jet[k] || (std::isnan(results[e][k]) && std::isnan(jet[k])))
            << "element " << e << ", order " << k << ": " << results[e][k] << " instead of " << jet[k];
    }
  }
}

template <class F>
void expect_jets(F f) {
  expect_jets(f, elements_with_ties());
}

/// What a tape compares: coefficient 0. Jets are compared for small t > 0, and differ where values tie.
double at_zero(const J& u) { return u[0]; }
Recorded at_zero(const Recorded& u) { return u; }

TEST(Choices, OnATapeAreThoseOfJets) {
  expect_jets([](const auto& x, const auto&) { return abs(x); });
  expect_jets([](const auto& x, const auto& y) { return min(x, y); });
  expect_jets([](const auto& x, const auto& y) { return max(x, y); });
  expect_jets([](const auto& x, const auto&) { return max(x, 0.0); });
  expect_jets([](const auto& x, const auto&) { return min(0.5, x); });
  expect_jets([](const auto& x, const auto& y) { return select(at_zero(x) < at_zero(y), x, y); });
  expect_jets([](const auto& x, const auto& y) { return select(at_zero(x) <= at_zero(y), x, y); });
  expect_jets([](const auto& x, const auto& y) { return select(at_zero(x) > at_zero(y), x, y); });
  expect_jets([](const auto& x, const auto& y) { return select(at_zero(x) >= at_zero(y), x, y); });
  expect_jets([](const auto& x, const auto& y) {
    return select(0.0 < at_zero(x) && at_zero(x) < at_zero(y), x, 2.0);
  });
  expect_jets(
      [](const auto& x, const auto& y) { return select(at_zero(x) < 0.0 || !(at_zero(y) < 0.0), 3.0, y); });
}

TEST(Choices, OnATapeKeepNaNInItsLane) {
  auto elements = elements_with_ties();
  for (std::size_t e = 0; e < elements.size(); e += 7) elements[e][e % 2][0] = nan;
  for (std::size_t e = 3; e < elements.size(); e += 7) elements[e][e % 2][2] = nan;
  expect_jets([](const auto& x, const auto&) { return abs(x); }, elements);
  expect_jets([](const auto& x, const auto& y) { return min(x, y); }, elements);
  expect_jets([](const auto& x, const auto& y) { return select(at_zero(x) < at_zero(y), x, y); }, elements);
}

TEST(Choices, AreNotHarmedByABranchThatIsNotSelected) {
  expect_jets([](const auto& x, const auto& y) { return select(at_zero(x) > 0.0, x, y / (x - x)); },
              {{J::variable(1.0), J(0.0)}, {J::variable(2.0), J::variable(nan)}});
}

// ---- what is recorded ------------------------------------------------------------------------------------

class RecordChoice : public ::testing::Test {
 protected:
  Recording recording_;
  const Recorded x_ = recording_.input({Input::Kind::position, 0, 0}),
                 y_ = recording_.input({Input::Kind::position, 0, 1}), a_ = recording_.parameter(0);

  std::vector<std::string> operations(const Recorded& output) {
    return names_of_operations(recording_.finish({output}));
  }
};

TEST_F(RecordChoice, ConditionsAreDecidedAtOrder0) {
  EXPECT_THAT(operations(select(x_ < y_, x_, y_)), ElementsAre("(less)", "select"));
  EXPECT_THAT(operations(select(x_ * y_ >= 1.0 || !(exp(x_) < 2.0), x_, y_)),
              ElementsAre("(multiply)", "(less or equal)", "(exp)", "(less)", "(not)", "(or)", "select"));
  EXPECT_THAT(operations(select(a_ < 1.0, x_, y_)), ElementsAre("[less]", "select"));
  EXPECT_THAT(operations(select(a_ < 1.0, a_, 2.0)), ElementsAre("[less]", "[select]"));
}

TEST_F(RecordChoice, SelectsAmongNumbersByEmbeddingThem) {
  EXPECT_THAT(operations(select(x_ < 0.0, 1.0, 2.0)), ElementsAre("(less)", "embed", "embed", "select"));
}

TEST_F(RecordChoice, SignsAreShared) {
  EXPECT_THAT(operations(min(x_, y_) * max(x_, y_)),
              ElementsAre("subtract", "sign", "by sign", "by sign", "multiply"));
  EXPECT_THAT(operations(abs(x_)), ElementsAre("sign", "abs"));
  EXPECT_THAT(operations(max(x_, 0.0)), ElementsAre("sign", "embed", "by sign"));
}

TEST_F(RecordChoice, PlainNumbersAreChosenAtOnce) {
  const Recorded one = 1.0, two = 2.0;
  EXPECT_EQ(select(one < two, x_, y_).node(), x_.node());
  EXPECT_EQ(select(one >= two, x_, y_).node(), y_.node());
  EXPECT_EQ(select(one < two && !(two < one), x_, y_).node(), x_.node());
  EXPECT_EQ(select(two <= one || one > two, x_, y_).node(), y_.node());
  EXPECT_EQ(min(one, two).value(), 1.0);
  EXPECT_EQ(max(one, two).value(), 2.0);
  EXPECT_EQ(abs(-two).value(), 2.0);
}

}  // namespace
}  // namespace jetlag::testing::choices_test
