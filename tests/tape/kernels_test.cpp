// SPDX-License-Identifier: MIT
// The same rule in its other lives: what a tape computes in lanes is what a jet computes.
#include "jetlag/tape/kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "jetlag/tape/recording.hpp"
#include "support/close.hpp"
#include "support/random.hpp"
#include "support/rules.hpp"
#include "support/run_tape.hpp"

namespace jetlag::testing::kernels_test {
namespace {

constexpr int degree = 12;
constexpr int elements = 70;  // two blocks of 32 lanes and a part of a third
using J = Jet<double, degree>;
using Tracked = Jet<RunningError<double>, degree>;

/// Of each element, the operands of one rule.
using Operands = std::vector<std::vector<J>>;

// ---- rules without their types: the tests are compiled once -------------------------------------------------

struct RuleOnATape {
  std::string name;
  int id;
  std::vector<Reads> reads;  // of each operand, then of the result
  Interval domain;
  bool is_comparison;
  J (*on_jets)(const std::vector<J>& operands);
  Tracked (*on_tracked_jets)(const std::vector<J>& operands);
  friend void PrintTo(const RuleOnATape& rule, std::ostream* out) { *out << rule.name; }

  std::size_t arity() const { return reads.size() - 1; }
};

/// The rule on jets of another number type.
template <class R, class Result>
Result on_jets(const std::vector<J>& operands) {
  return [&]<std::size_t... A>(std::index_sequence<A...>) {
    const auto operand = [&](auto a) {
      if constexpr (R::reads[a] == Reads::constant) {
        return operands[a][0];
      } else {
        Result u;
        for (int k = 0; k <= degree; ++k) u[k] = operands[a][k];
        return u;
      }
    };
    return lift<R, Result>(operand(std::integral_constant<std::size_t, A>{})...);
  }(std::make_index_sequence<arity<R>>{});
}

template <class R>
RuleOnATape on_a_tape() {
  return {NameOfRule::GetName<R>(0),
          rule_id<R>,
          {R::reads.begin(), R::reads.end()},
          domain<R>(),
          std::is_same_v<R, Less> || std::is_same_v<R, LessOrEqual>,
          on_jets<R, J>,
          on_jets<R, Tracked>};
}

std::vector<RuleOnATape> all_rules() {
  return []<Rule... R>(RuleList<R...>) { return std::vector<RuleOnATape>{on_a_tape<R>()...}; }(Rules{});
}

// ---- tests of each ------------------------------------------------------------------------------------------

/// Series with |u_k| < 2^-k, and a number where a constant is expected.
Operands random_operands(const Interval& domain, const std::vector<bool>& is_constant) {
  Uniform draw(3);
  Operands all(elements, std::vector<J>(is_constant.size()));
  for (auto& operands : all)
    for (std::size_t a = 0; a < operands.size(); ++a) {
      operands[a][0] = draw(domain.low, domain.high);
      if (!is_constant[a])
        for (int k = 1; k <= degree; ++k) operands[a][k] = draw(-1, 1) * std::ldexp(1.0, -k);
    }
  return all;
}

class KernelLaws : public ::testing::TestWithParam<RuleOnATape> {
 protected:
  const RuleOnATape& rule = GetParam();

  bool is_constant(std::size_t operand) const { return rule.reads[operand] == Reads::constant; }

  Operands random_operands() const {
    std::vector<bool> constant;
    for (std::size_t a = 0; a < rule.arity(); ++a) constant.push_back(is_constant(a));
    return kernels_test::random_operands(rule.domain, constant);
  }

  /// One operation of the rule: series are inputs, constants are parameters.
  Tape tape() const {
    Recording recording;
    std::vector<int> operands;
    int constants = 0;
    for (std::size_t a = 0; a < rule.arity(); ++a)
      operands.push_back(is_constant(a)
                             ? recording.parameter(constants++).node()
                             : recording.input({Input::Kind::position, 0, static_cast<int>(a)}).node());
    return recording.finish({recording.operation(rule.id, operands, false)});
  }

  /// The tape of the rule; what it reads as constant are the parameters.
  std::vector<J> run(const Operands& operands, const KernelTable<double>& table, int at_once = 1) const {
    std::vector<double> parameters;
    for (const auto& of_element : operands)
      for (std::size_t a = 0; a < rule.arity(); ++a)
        if (is_constant(a)) parameters.push_back(of_element[a][0]);
    return run_tape(tape(), operands, parameters, table, at_once);
  }
};
INSTANTIATE_TEST_SUITE_P(, KernelLaws, ::testing::ValuesIn(all_rules()),
                         [](const auto& info) { return info.param.name; });

TEST_P(KernelLaws, OneLaneHasTheBitsOfAJet) {
  const auto operands = random_operands();
  const auto results = run(operands, scalar_kernels<double>());
  for (int e = 0; e < elements; ++e) {
    const J jet = rule.on_jets(operands[e]);
    for (int k = 0; k <= degree; ++k)
      EXPECT_TRUE(same_bits(results[e][k], jet[k])) << "element " << e << ", order " << k;
  }
}

TEST_P(KernelLaws, LanesAgreeWithAJetOnEveryInstructionSet) {
  // A fused multiply-add rounds once where the jet rounds twice: both lie within the bound that the jet
  // carries.
  const auto operands = random_operands();
  for (const auto* table : tables_of_all_widths()) {
    SCOPED_TRACE(name(*table));
    const auto results = run(operands, *table);
    for (int e = 0; e < elements; ++e)
      EXPECT_THAT(rule.on_tracked_jets(operands[e]),
                  HasCoefficients([&](int k) { return RunningError<double>(results[e][k]); }))
          << "element " << e;
  }
}

TEST_P(KernelLaws, TwoOrdersAtOnceHaveTheBitsOfOneAfterTheOther) {
  const auto operands = random_operands();
  for (const auto* table : tables_of_all_widths()) {
    SCOPED_TRACE(name(*table));
    const auto one = run(operands, *table, 1), two = run(operands, *table, 2);
    for (int e = 0; e < elements; ++e)
      for (int k = 0; k <= degree; ++k)
        EXPECT_TRUE(same_bits(one[e][k], two[e][k])) << "element " << e << ", order " << k;
  }
}

TEST_P(KernelLaws, NotFiniteLanesLeaveTheOthersAlone) {
  for (const auto* table : tables_of_all_widths()) {
    SCOPED_TRACE(name(*table));
    auto operands = random_operands();
    const auto before = run(operands, *table);
    const int ill[] = {1, 31, 40, elements - 1};
    std::ranges::fill(operands[ill[0]], J(std::numeric_limits<double>::quiet_NaN()));
    std::ranges::fill(operands[ill[1]], J(std::numeric_limits<double>::infinity()));
    std::ranges::fill(operands[ill[2]], J(0.0));
    std::ranges::fill(operands[ill[3]], J(-1.0));
    const auto after = run(operands, *table);
    for (int e = 0; e < elements; ++e)
      for (int k = 0; k <= degree && std::ranges::find(ill, e) == std::end(ill); ++k)
        EXPECT_TRUE(same_bits(after[e][k], before[e][k])) << "element " << e << ", order " << k;
    if (rule.arity() > 0 && !rule.is_comparison) {    // a comparison with NaN does not hold
      EXPECT_FALSE(std::isfinite(after[ill[0]][0]));  // and the ill lane is not made well
    }
  }
}

TEST(Kernels, ComputeAWholeFunctionAsJetsDo) {  // all rules in one tape, the coupled ones too
  const auto f = [](const auto& x, const auto& y) {
    return exp(sin(x) * cos(y) - 0.5) / sqrt(1.0 + x * x) + pow(y, 1.5) * log(y) - 2.0 / (3.0 + y) +
           (x - y) / 4.0;
  };
  Recording recording;
  const Tape tape = recording.finish(
      {f(recording.input({Input::Kind::position, 0, 0}), recording.input({Input::Kind::position, 0, 1}))});
  const auto operands = random_operands(domain<Multiply>(), {false, false});
  for (const auto* table : tables_of_all_widths()) {
    SCOPED_TRACE(name(*table));
    const auto results = run_tape(tape, operands, {}, *table);
    for (int e = 0; e < elements; ++e) {
      std::array<Tracked, 2> u;
      for (int k = 0; k <= degree; ++k)
        for (int a = 0; a < 2; ++a) u[a][k] = operands[e][a][k];
      EXPECT_THAT(f(u[0], u[1]), HasCoefficients([&](int k) { return RunningError<double>(results[e][k]); }));
    }
  }
}

TEST(Kernels,
     ComputeCoupledFunctionsTwoOrdersAtOnce) {  // sine and cosine need each other's newest coefficient
  Recording recording;
  const Recorded x = recording.input({Input::Kind::position, 0, 0});
  const Tape tape = recording.finish({sin(x * x) * cos(x) + exp(cos(x))});
  const auto operands = random_operands(domain<Square>(), {false});
  for (const auto* table : tables_of_all_widths()) {
    SCOPED_TRACE(name(*table));
    const auto one = run_tape(tape, operands, {}, *table, 1), two = run_tape(tape, operands, {}, *table, 2);
    for (int e = 0; e < elements; ++e)
      for (int k = 0; k <= degree; ++k) EXPECT_TRUE(same_bits(one[e][k], two[e][k])) << e << ", order " << k;
  }
}

/// Elements between rows of one to three coordinates; rows of three are padded to four.
struct Rows {
  static constexpr int particles = 11, widest = 32;
  int dimension, stride;
  AlignedVector<double> of_particles, of_elements;  // shape (particles, stride); (dimension, widest)
  std::array<int, widest> plus, minus;

  explicit Rows(int d)
      : dimension(d), stride(d == 3 ? 4 : d), of_particles(particles * stride), of_elements(d * widest) {
    Uniform draw(5);
    for (int i = 0; i < particles; ++i)
      for (int c = 0; c < d; ++c) of_particles[i * stride + c] = draw(-1, 1);
    for (double& x : of_elements) x = draw(-1, 1);
    for (int lane = 0; lane < widest; ++lane) {  // neighbouring lanes share particles
      plus[lane] = lane % particles * stride;
      minus[lane] = (lane + 1 + lane / 5) % particles * stride;
    }
  }
};

TEST(Kernels, GatherTheRowsOfEachLane) {
  for (const auto* table : tables_of_all_widths())
    for (int d : {1, 2, 3})
      for (bool differences : {false, true}) {
        SCOPED_TRACE(name(*table) + ", " + std::to_string(d));
        Rows rows(d);
        std::array<double*, 3> to{};
        for (int c = 0; c < d; ++c) to[c] = &rows.of_elements[c * Rows::widest];
        table->gather(d, rows.of_particles.data(), rows.plus.data(),
                      differences ? rows.minus.data() : nullptr, to.data());
        for (int lane = 0; lane < table->lanes; ++lane)
          for (int c = 0; c < d; ++c) {
            const double own = rows.of_particles[rows.plus[lane] + c],
                         other = rows.of_particles[rows.minus[lane] + c];
            EXPECT_EQ(to[c][lane], differences ? own - other : own) << lane;
          }
      }
}

TEST(Kernels, ScatterOntoRowsLaneByLane) {  // one after another: the bits of a sum depend on its order
  for (const auto* table : tables_of_all_widths())
    for (int d : {1, 2, 3})
      for (bool differences : {false, true})
        for (int active = 1; active <= table->lanes; ++active) {
          SCOPED_TRACE(name(*table) + ", " + std::to_string(d) + ", " + std::to_string(active));
          Rows rows(d);
          std::array<const double*, 3> from{};
          for (int c = 0; c < d; ++c) from[c] = &rows.of_elements[c * Rows::widest];
          auto expected = rows.of_particles;
          for (int lane = 0; lane < active; ++lane)
            for (int c = 0; c < d; ++c) {
              expected[rows.plus[lane] + c] += from[c][lane];
              if (differences) expected[rows.minus[lane] + c] -= from[c][lane];
            }
          table->scatter(d, active, from.data(), rows.plus.data(), differences ? rows.minus.data() : nullptr,
                         rows.of_particles.data());
          EXPECT_EQ(rows.of_particles, expected);
        }
}

TEST(Kernels, FitTheNumberOfElements) {
  for (const auto* widest : available_kernels()) {
    SCOPED_TRACE(widest->instruction_set);
    EXPECT_EQ(&widest->fitting(100000), widest);
    EXPECT_EQ(widest->fitting(1).lanes, 1);
    if (widest != &scalar_kernels<double>()) {
      EXPECT_EQ(widest->fitting(8).lanes, 8);
      // Three bodies have three pairs: a block as narrow as registers allow.
      EXPECT_EQ(widest->fitting(3).lanes, std::string_view(widest->instruction_set) == "avx512" ? 8 : 4);
    }
    for (std::size_t n : {1, 2, 3, 4, 5, 8, 15, 16, 17, 33}) {  // no other width costs less
      const auto cost = [n](const KernelTable<double>& table) {
        return (n + table.lanes - 1) / table.lanes * (table.lanes + 20);
      };
      for (const auto* table = widest; table; table = table->narrower)
        EXPECT_LE(cost(widest->fitting(n)), cost(*table)) << n;
    }
  }
}

TEST(Kernels, AreListedSlowestFirst) {
  const auto tables = available_kernels();
  ASSERT_FALSE(tables.empty());
  EXPECT_EQ(tables.front(), &scalar_kernels<double>());
  for (std::size_t i = 1; i < tables.size(); ++i) EXPECT_EQ(tables[i]->lanes, 32);
}

TEST(Kernels, InUseAreAvailable) {  // the fastest, or those that JETLAG_INSTRUCTION_SET asks for
  const auto tables = available_kernels();
  EXPECT_NE(std::ranges::find(tables, &kernels<double>()), tables.end());
}

}  // namespace
}  // namespace jetlag::testing::kernels_test
