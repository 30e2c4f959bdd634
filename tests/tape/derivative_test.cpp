// SPDX-License-Identifier: MIT
// Derivatives of recorded values: of every rule of the register, along whole series.
#include "jetlag/tape/derivative.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "jetlag/tape/program.hpp"
#include "support/close.hpp"
#include "support/engine_of_numbers.hpp"
#include "support/functions_of_two.hpp"
#include "support/random.hpp"
#include "support/recorded_names.hpp"

namespace jetlag::testing::derivative_test {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

constexpr int degree = 10;
using Number = RunningError<double>;
using Tracked = Jet<Number, degree>;

/// The first output of a tape of x and y, inputs 0 and 1, to all orders.
Tracked on_a_tape(const Tape& tape, const std::array<Tracked, 2>& xy,
                  const std::vector<Number>& parameters = {0.0, 0.0}) {
  const Program program(tape);
  Blocks<Number> blocks(program, 1, parameters, scalar_kernels<Number>());
  blocks.reserve(degree + 1);
  Tracked result;
  for (int k = 0; k <= degree; ++k) {
    for (const auto& [place, input] : program.inputs) *blocks.at(0, place, k) = xy[input.component][k];
    blocks.run(0, k);
    result[k] = program.is_static && k > 0 ? Number(0.0) : *blocks.at(0, program.outputs[0], k);
  }
  return result;
}

struct XY {
  Recording recording;
  std::array<Recorded, 2> inputs{recording.input({Input::Kind::position, 0, 0}),
                                 recording.input({Input::Kind::position, 0, 1})};
  const Recorded &x = inputs[0], &y = inputs[1];
  Recorded a = recording.parameter(0), b = recording.parameter(1);

  Recorded derivative(const Recorded& f, int by) { return derivatives(recording, f, {inputs[by]})[0]; }
  std::vector<std::string> operations(const Recorded& f, int by = 0) {
    return names_of_operations(recording.finish({derivative(f, by)}));
  }
};

/// The rules that the functions are made of, and a sum or product of more terms.
constexpr auto arithmetic = std::tuple{
    Named{"sum", [](const auto& x, const auto& y) { return (x + y) * (2.0 + x); }},
    Named{"difference", [](const auto& x, const auto& y) { return (x - y) * (3.0 - x) * -y; }},
    Named{"square", [](const auto& x, const auto& y) { return square(x + y * y); }},
    Named{"quotient", [](const auto& x, const auto& y) { return (x * x) / y + x / 3.0 + 3.0 / y; }},
    Named{"norm", [](const auto& x, const auto& y) { return sqrt(x * x + y * y) + x / sqrt(x * x + y * y); }},
    Named{"chain of powers",
          [](const auto& x, const auto& y) { return pow(x * y, -1.5) * sqrt(x * y) / (x * y); }},
    Named{"sums of several",
          []<class S>(const S& x, const S& y) {
            return lift<Sum<3>, S>(x, y * y, x * y) * lift<Sum<4>, S>(x, x, y * y, x * y);
          }},
    Named{"squared norms",
          []<class S>(const S& x, const S& y) {
            return lift<SquaredNorm<2>, S>(x, x * y) * lift<SquaredNorm<3>, S>(x, y, x * y);
          }},
    Named{"dot products",
          []<class S>(const S& x, const S& y) {
            return lift<Dot<2>, S>(x, y, x * y, x) * lift<Dot<3>, S>(x, y, x * x, y, x, x);
          }},
    Named{"differences of products",
          []<class S>(const S& x, const S& y) { return lift<DifferenceOfProducts, S>(x, y * y, x * y, x); }},
    Named{"linear combinations",
          []<class S>(const S& x, const S& y) {
            return lift<LinearCombination<1>, S>(x, 3.0, y * y) *
                   lift<LinearCombination<2>, S>(x, 2.0, x * y, -0.5, y) *
                   lift<LinearCombination<3>, S>(x * x, 2.0, x, -0.5, y, 1.5, x * y) *
                   lift<LinearCombination<5>, S>(y, 2.0, x, -0.5, y, 1.5, x * y, 0.25, x, 3.0, y);
          }},
    Named{"conditions",
          [](const auto& x, const auto& y) {
            return select((x < 0.5 && y < 1.5) || !(x <= 0.75), x * y, sqrt(x)) * x;
          }},
    Named{"choices beside poles",
          [](const auto& x, const auto& y) {  // NaN where it is not chosen
            return select(x < 0.5, pow(0.5 - x, 1.5) * y, pow(x - 0.5, 2.5)) +
                   y * select(x > 0.5, pow(x - 0.5, 1.5), 0.0 * x);
          }},
    Named{"choices of choices",
          [](const auto& x, const auto& y) {
            const auto inner = max(x * y, 0.5), outer = min(inner, y / 2.0);
            return square(outer) + inner * abs(x - 0.5) * x;
          }},
};
template <class Action>
void for_all(Action action) {
  std::apply([&](const auto&... named) { (action(named.name, named.f), ...); }, arithmetic);
  for_each_function(action);
}

/// The derivative of f = sum f_k t^k where t is what it is taken by.
Tracked slope(const Tracked& f) {
  Tracked d;
  for (int k = 0; k < degree; ++k) d[k] = Number(k + 1.0) * f[k + 1];
  return d;
}

void expect_close(const Tracked& actual, const Tracked& expected, int last, const std::string& what) {
  for (int k = 0; k <= last; ++k) {
    const double allowed = actual[k].error + expected[k].error;
    EXPECT_LE(std::abs(actual[k].value - expected[k].value), allowed)
        << what << ", order " << k << ": " << actual[k] << " instead of " << expected[k];
    EXPECT_LE(allowed, 0x1p-20 * (std::abs(expected[k].value) + 1))
        << what << ", order " << k << ": proves nothing";
  }
}

TEST(Derivative, IsThatOfTheSeriesAlongEachOperand) {
  // x = x_0 + t: coefficient k of df/dx is k + 1 times coefficient k + 1 of f, which jets know; so for second derivatives.
  Uniform draw(7);
  for (int point = 0; point < 8; ++point) {
    const std::array at{Tracked(draw(0.125, 0.875)), Tracked(draw(1.125, 2.0))};
    for (int by = 0; by < 2; ++by) {
      auto xy = at;
      xy[by][1] = 1.0;
      for_all([&](const char* name, auto f) {
        const std::string what = std::string(name) + " by " + "xy"[by] + ", point " + std::to_string(point);
        const Tracked first = slope(f(xy[0], xy[1]));
        XY recorded;
        const Recorded d = recorded.derivative(f(recorded.x, recorded.y), by);
        expect_close(on_a_tape(recorded.recording.finish({d}), xy), first, degree - 1, what);
        XY twice;
        const Recorded dd = twice.derivative(twice.derivative(f(twice.x, twice.y), by), by);
        expect_close(on_a_tape(twice.recording.finish({dd}), xy), slope(first), degree - 2, what + ", twice");
      });
    }
  }
}

TEST(Derivative, ExistsForEveryRuleThatIsNoPartOfAnother) {
  std::vector<std::string> without;
  [&]<Rule... R>(RuleList<R...>) {
    ((has_derivative(rule_id<R>) ? void() : without.push_back(R::name)), ...);
  }(Rules{});
  EXPECT_THAT(without, UnorderedElementsAre(ScaledSumOfSquares::name, ScaledSquare::name));
}

TEST(Derivative, OfEveryRuleIsTested) {  // above, or of parameters below
  std::vector<bool> tested(Rules::size, false);
  for_all([&](const char*, auto f) {
    for (int by = 0; by < 2; ++by) {
      XY recorded;
      recorded.recording.finish(
          {recorded.derivative(recorded.derivative(f(recorded.x, recorded.y), by), by)});
      for (const Node& node : recorded.recording.nodes())
        if (node.kind == Node::Kind::operation) tested[node.rule] = true;
    }
  });
  const auto expect_tested = [&](const char* name, int id) {
    EXPECT_TRUE(tested[id]) << name << ": add a function that records it";
  };
  [&]<Rule... R>(RuleList<R...>) { (expect_tested(R::name, rule_id<R>), ...); }(Rules{});
}

TEST(Derivative, ByParametersIsTheSame) {  // of values with a series and without
  const double a = 0.375, b = 1.25;
  Tracked x = 0.75;
  for (int k = 1; k <= degree; ++k) x[k] = std::ldexp(k % 2 ? 0.5 : -0.25, -k);
  const auto f = [](const auto& u, const auto& v, const auto& z) {
    return u * z + z / v + pow(z, u) + hypot(u, v) * z + atan2(u, v) + sin(u * v) + u + max(u, z) * (u + z);
  };
  for (int by = 0; by < 2; ++by) {
    XY recorded;
    const Recorded parameter = by == 0 ? recorded.a : recorded.b;
    const Recorded d = derivatives(recorded.recording, f(recorded.a, recorded.b, recorded.x), {parameter})[0];
    const Tracked actual = on_a_tape(recorded.recording.finish({d}), {x, Tracked()}, {a, b});
    // On jets of jets: coefficient 1 of the outer one.
    using Nested = Jet<Tracked, 1>;
    Nested u{Tracked(a)}, v{Tracked(b)};
    (by == 0 ? u : v)[1] = Tracked(1.0);
    expect_close(actual, f(u, v, Nested(x))[1], degree, by == 0 ? "a" : "b");
  }
}

TEST(Derivative, OfARootOfAChoiceIsThatOfTheRoot) {  // 0 to all orders where 0 is chosen
  const auto f = [](const auto& x, const auto& y) { return y * pow(max(x - 0.5, 0.0), 1.5); };
  const auto by_hand = [](const auto& x, const auto& y) {
    return y * select(x > 0.5, pow(x - 0.5, 1.5), 0.0 * x);
  };
  for (const double x_0 : {0.25, 0.75})
    for (int by = 0; by < 2; ++by) {
      std::array xy{Tracked(x_0), Tracked(1.5)};
      xy[by][1] = 1.0;
      XY recorded;
      const Recorded d = recorded.derivative(f(recorded.x, recorded.y), by);
      expect_close(on_a_tape(recorded.recording.finish({d}), xy), slope(by_hand(xy[0], xy[1])), degree - 1,
                   "by " + std::to_string(by) + " at " + std::to_string(x_0));
    }
}

// ---- what is recorded ------------------------------------------------------------------------------------

TEST(Derivative, SharesWhatIsThere) {
  XY v;
  EXPECT_THAT(v.operations(exp(v.x)), ElementsAre("exp"));
  EXPECT_THAT(v.operations(sin(v.x)), UnorderedElementsAre("sin", "cos"));
  EXPECT_THAT(v.operations(sqrt(v.x)), ElementsAre("sqrt", "reciprocal"));
  EXPECT_THAT(v.operations(log(v.x)), ElementsAre("reciprocal"));
  EXPECT_THAT(v.operations(pow(v.x, 3.5)), ElementsAre("power", "scale"));
  EXPECT_THAT(v.operations(erf(v.x)), ::testing::IsSupersetOf({"square", "gaussian", "scale"}));
  EXPECT_THAT(v.operations(asin(v.x)), ElementsAre("one minus square", "sqrt", "reciprocal"));
}

TEST(Derivative, CancelsPowersAndNumbers) {
  XY v;
  const Recorded q = v.x * v.x + v.y * v.y;
  EXPECT_THAT(v.operations(0.5 * square(sqrt(q))), ElementsAre());  // x
  EXPECT_THAT(v.operations(-2.0 / sqrt(q)),
              UnorderedElementsAre("squared norm of 2", "power", "scale", "multiply"));
  EXPECT_THAT(v.operations(v.a * v.x * v.x * v.x),
              UnorderedElementsAre("[multiply]", "square", "scale"));  // 3 a x^2
}

TEST(Derivative, OfWhatIsNeverChosenIsNotRecorded) {
  XY v;
  const auto condition = v.x < 0.5;
  EXPECT_THAT(v.operations(select(condition, select(condition, exp(v.x), log(v.x)), v.y)),
              UnorderedElementsAre("exp", "(less)", "embed", "select"));
}

TEST(Derivative, OfWhatDoesNotDependIsZero) {
  XY v;
  for (const Recorded& f : {v.y, Recorded(3.0), v.a * 2.0, select(v.x < 0.5, Recorded(1.0), Recorded(2.0))})
    EXPECT_TRUE(v.derivative(f, 0).is_number(0.0));
}

TEST(Derivative, OfAConstantSlopeHasNoSeries) {
  XY v;
  EXPECT_TRUE(v.recording.is_static(v.derivative(v.a * v.x + 3.0, 0)));
}

TEST(Derivative, NamesTheRuleThatHasNone) {
  XY v;
  const Recorded w = lift<ScaledSquare, Recorded>(lift<Length, Recorded>(v.x, v.y), v.x);
  EXPECT_THAT([&] { v.derivative(w, 0); },
              ::testing::ThrowsMessage<std::invalid_argument>("derivatives: 'scaled square' has none"));
}

}  // namespace
}  // namespace jetlag::testing::derivative_test
