// SPDX-License-Identifier: MIT
// Every function on a tape is what it is on jets, on every instruction set; and what it costs there.
#include "jetlag/series/functions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "jetlag/series/comparisons.hpp"
#include "jetlag/tape/recording.hpp"
#include "support/close.hpp"
#include "support/functions_of_two.hpp"
#include "support/random.hpp"
#include "support/recorded_names.hpp"
#include "support/run_tape.hpp"

namespace jetlag::testing::functions_test {
namespace {

using ::testing::UnorderedElementsAre;

constexpr int degree = 12;
constexpr int elements = 70;  // two blocks of 32 lanes and a part of a third
using J = Jet<double, degree>;
using Tracked = Jet<RunningError<double>, degree>;
using Operands = std::vector<std::array<J, 2>>;

/// A function without its type: the tests are compiled once.
struct Function {
  std::string name;
  Recorded (*on_tape)(const Recorded& x, const Recorded& y);
  J (*on_jets)(const J& x, const J& y);
  Tracked (*on_tracked_jets)(const Tracked& x, const Tracked& y);

  template <class F>
  Function(const char* its_name, F)
      : name(its_name),
        on_tape(&call<F, Recorded>),
        on_jets(&call<F, J>),
        on_tracked_jets(&call<F, Tracked>) {}

 private:
  template <class F, class T>
  static T call(const T& x, const T& y) {
    return F{}(x, y);
  }
};

const std::vector<Function> functions = [] {
  std::vector<Function> all;
  for_each_function([&](const char* name, auto f) { all.emplace_back(name, f); });
  return all;
}();

Tape tape_of(const Function& f) {
  Recording recording;
  const Recorded x = recording.input({Input::Kind::position, 0, 0}),
                 y = recording.input({Input::Kind::position, 0, 1});
  return recording.finish({f.on_tape(x, y)});
}

Operands random_operands() {
  Uniform draw(3);
  Operands operands(elements);
  for (auto& [x, y] : operands) {
    x[0] = draw(0.125, 0.875);
    y[0] = draw(1.125, 2.0);
    for (int k = 1; k <= degree; ++k) {
      x[k] = draw(-1, 1) * std::ldexp(0.25, -k);
      y[k] = draw(-1, 1) * std::ldexp(0.25, -k);
    }
  }
  return operands;
}

/// What functions are made of: on tapes of kernels_test.cpp, fusion_test.cpp and choices_test.cpp.
using ArithmeticAndConditions =
    RuleList<Embed, Add, Subtract, Negate, Offset, Scale, Multiply, Square, Divide, DivideByConstant,
             Reciprocal, Sum<3>, Sum<4>, SquaredNorm<2>, SquaredNorm<3>, Dot<2>, Dot<3>, DifferenceOfProducts,
             LinearCombination<1>, LinearCombination<2>, LinearCombination<3>, LinearCombination<5>, Less,
             LessOrEqual, And, Or, Not>;

TEST(FunctionsOnATape, AreAllOfTheRegister) {
  std::vector<bool> is_recorded(Rules::size, false);
  for (const Function& f : functions) {
    for (const Node& node : tape_of(f).nodes)
      if (node.kind == Node::Kind::operation) is_recorded[node.rule] = true;
  }
  [&]<Rule... R>(RuleList<R...>) { ((is_recorded[rule_id<R>] = true), ...); }(ArithmeticAndConditions{});
  const auto expect_recorded = [&](const char* name, int id) {
    EXPECT_TRUE(is_recorded[id]) << name << ": add a function that records it to the list above";
  };
  [&]<Rule... R>(RuleList<R...>) { (expect_recorded(R::name, rule_id<R>), ...); }(Rules{});
}

TEST(FunctionsOnATape, HaveTheBitsOfJetsOnOneLane) {
  const auto operands = random_operands();
  for (const Function& f : functions) {
    // A tape adds many terms in another order, and multiplies the factors of a product in the order of its nodes.
    if (f.name == "all together" || f.name == "acosh") continue;
    const auto results = run_tape(tape_of(f), operands, {}, scalar_kernels<double>());
    for (int e = 0; e < elements; ++e) {
      const J jet = f.on_jets(operands[e][0], operands[e][1]);
      for (int k = 0; k <= degree; ++k)
        EXPECT_TRUE(same_bits(results[e][k], jet[k])) << f.name << ", element " << e << ", order " << k
                                                      << ": " << results[e][k] << " instead of " << jet[k];
    }
  }
}

TEST(FunctionsOnATape, AgreeWithJetsOnEveryInstructionSet) {
  // A fused multiply-add rounds once where the jet rounds twice: both lie within the bound that the jet carries.
  const auto operands = random_operands();
  for (const Function& f : functions) {
    const Tape tape = tape_of(f);
    for (const auto* table : available_kernels()) {
      SCOPED_TRACE(table->instruction_set);
      const auto results = run_tape(tape, operands, {}, *table);
      for (int e = 0; e < elements; ++e) {
        std::array<Tracked, 2> u;
        for (int k = 0; k <= degree; ++k)
          for (int a = 0; a < 2; ++a) u[a][k] = operands[e][a][k];
        EXPECT_THAT(f.on_tracked_jets(u[0], u[1]),
                    HasCoefficients([&](int k) { return RunningError<double>(results[e][k]); }))
            << f.name << ", element " << e;
      }
    }
  }
}

int first_not_finite(const J& u) {
  int k = 0;
  while (k <= degree && std::isfinite(u[k])) ++k;
  return k;
}

TEST(FunctionsOnATape, AreNotFiniteWhereJetsAreNotAndHarmNoOtherLane) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double ill[] = {0.0, 1.0, -1.0, -3.0, infinity, std::numeric_limits<double>::quiet_NaN()};
  const auto well = random_operands();
  auto operands = well;
  std::vector<bool> is_ill(elements, false);
  int e = 2;
  for (const double x : ill)
    for (const auto& pair : {std::array{J::variable(x), well[0][1]}, std::array{well[0][0], J::variable(x)},
                             std::array{J::variable(x), J::variable(x)}}) {
      operands[e] = pair;
      is_ill[e] = true;
      e += 3;
    }
  for (const Function& f : functions) {
    const Tape tape = tape_of(f);
    for (const auto* table : available_kernels()) {
      SCOPED_TRACE(table->instruction_set);
      const auto before = run_tape(tape, well, {}, *table), after = run_tape(tape, operands, {}, *table);
      for (int i = 0; i < elements; ++i) {
        if (is_ill[i]) {
          const J jet = f.on_jets(operands[i][0], operands[i][1]);
          EXPECT_LE(first_not_finite(after[i]), first_not_finite(jet)) << f.name << ", element " << i;
          continue;
        }
        for (int k = 0; k <= degree; ++k)
          EXPECT_TRUE(same_bits(after[i][k], before[i][k])) << f.name << ", element " << i << ", order " << k;
      }
    }
  }
}

// ---- what is recorded ------------------------------------------------------------------------------------

class RecordFunction : public ::testing::Test {
 protected:
  Recording recording_;
  const Recorded x_ = recording_.input({Input::Kind::position, 0, 0}),
                 y_ = recording_.input({Input::Kind::position, 0, 1}), a_ = recording_.parameter(0);

  std::vector<std::string> operations(const Recorded& output) {
    return names_of_operations(recording_.finish({output}));
  }
};

TEST_F(RecordFunction, IsOneOperationOrSharesTheRest) {
  EXPECT_THAT(operations(cbrt(x_)), UnorderedElementsAre("cbrt"));
  EXPECT_THAT(operations(log2(x_)), UnorderedElementsAre("log2"));
  EXPECT_THAT(operations(expm1(x_)), UnorderedElementsAre("exp", "expm1"));
  EXPECT_THAT(operations(tan(x_)), UnorderedElementsAre("tan", "secant squared"));
  EXPECT_THAT(operations(tanh(x_)), UnorderedElementsAre("tanh", "hyperbolic secant squared"));
  EXPECT_THAT(operations(sinh(x_) / cosh(x_)), UnorderedElementsAre("sinh", "cosh", "divide"));
  EXPECT_THAT(operations(asin(x_) + acos(x_)),
              UnorderedElementsAre("one minus square", "sqrt", "asin", "acos", "add"));
  EXPECT_THAT(operations(atan(x_)), UnorderedElementsAre("square", "offset", "atan"));
  EXPECT_THAT(operations(asinh(x_)),
              UnorderedElementsAre("(length)", "scaled square", "root of scaled", "asinh"));
  EXPECT_THAT(operations(acosh(x_)),
              UnorderedElementsAre("offset", "sqrt", "offset", "sqrt", "multiply", "acosh"));
  EXPECT_THAT(operations(atanh(x_)), UnorderedElementsAre("one minus square", "atanh"));
  EXPECT_THAT(operations(erf(x_) + erfc(x_)),
              UnorderedElementsAre("square", "gaussian", "erf", "erfc", "add"));
}

TEST_F(RecordFunction, PolarCoordinatesShareTheirSquares) {
  EXPECT_THAT(operations(hypot(x_, y_) * hypot(y_, x_) * atan2(x_, y_) * atan2(y_, x_)),
              UnorderedElementsAre("(length)", "scaled sum of squares", "root of scaled", "square", "atan2",
                                   "multiply", "atan2", "multiply"));
  EXPECT_THAT(operations(hypot(x_, 2.0) * atan2(x_, 2.0) * atan2(2.0, x_)),
              UnorderedElementsAre("(length)", "scaled square", "root of scaled", "atan2 over constant",
                                   "multiply", "atan2 of constant", "multiply"));
}

TEST_F(RecordFunction, OfParametersHasNoSeries) {
  EXPECT_THAT(operations(hypot(a_, 3.0)), UnorderedElementsAre("[length]"));
  EXPECT_THAT(operations(atan2(a_, 3.0)),
              UnorderedElementsAre("[length]", "[scaled sum of squares]", "[atan2]"));
  EXPECT_THAT(operations(erf(a_) * x_), UnorderedElementsAre("[square]", "[gaussian]", "[erf]", "scale"));
}

TEST_F(RecordFunction, OfTwoSeriesAsPowerIsTheirExponential) {
  EXPECT_THAT(operations(pow(x_, y_)), UnorderedElementsAre("log", "multiply", "power of series"));
  EXPECT_THAT(operations(pow(2.0, y_)), UnorderedElementsAre("[log]", "scale", "power of series"));
  EXPECT_THAT(operations(pow(x_, a_)), UnorderedElementsAre("power"));
}

TEST_F(RecordFunction, OfPlainNumbersIsANumber) {
  const Recorded half = 0.5, two = 2.0;
  EXPECT_EQ(tan(half).value(), std::tan(0.5));
  EXPECT_EQ(tanh(half).value(), std::tanh(0.5));
  EXPECT_EQ(asinh(half).value(), std::asinh(0.5));
  EXPECT_EQ(erfc(half).value(), std::erfc(0.5));
  EXPECT_EQ(expm1(half).value(), std::expm1(0.5));
  EXPECT_EQ(hypot(half, two).value(), std::hypot(0.5, 2.0));
  EXPECT_EQ(atan2(half, two).value(), std::atan2(0.5, 2.0));
}

}  // namespace
}  // namespace jetlag::testing::functions_test
