// SPDX-License-Identifier: MIT
// Laws of the rules: every rule of the register has these tests.
#include "support/rules.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "support/random.hpp"

namespace jetlag::testing::rules_test {
namespace {

constexpr int degree = 12;
using Series = Jet<double, degree>;
using Shorter = Jet<double, degree - 5>;

// ---- rules without their types: the tests are compiled once -------------------------------------------------

struct RuleOnJets {
  std::string name;
  std::vector<Reads> reads;  // of each operand, then of the result
  Interval domain;
  std::vector<std::set<int>> (*indices_read)(int k);  // of each operand and the result
  double (*coefficient)(int k, const std::vector<Series>& operands_and_result);
  Series (*whole)();  // the rule as a function of as many random operands as it has
  Shorter (*shorter)();
  int two_from;  // -1: not two orders at once
  std::array<double, 2> (*two_coefficients)(int k, const std::vector<Series>& operands_and_result);
  friend void PrintTo(const RuleOnJets& rule, std::ostream* out) { *out << rule.name; }
};

/// A series that remembers which of its coefficients have been read.
struct Probe {
  std::vector<double> coefficients;
  std::set<int>* read;
  double operator[](int j) const {
    read->insert(j);
    return coefficients.at(j);
  }
};

/// What each operand and the result were read for by coefficient k.
template <class R>
std::vector<std::set<int>> indices_read(int k) {
  constexpr std::size_t n = R::reads.size();
  std::vector<std::set<int>> read(n);
  [&]<std::size_t... A>(std::index_sequence<A...>) {
    const std::vector<double> ones(degree + 1, 1.0);
    R::coefficient(k, Probe{ones, &read[A]}...);
  }(std::make_index_sequence<n>{});
  return read;
}

template <class R>
double coefficient(int k, const std::vector<Series>& all) {
  return [&]<std::size_t... A>(std::index_sequence<A...>) {
    return double(R::coefficient(k, all[A]...));
  }(std::make_index_sequence<R::reads.size()>{});
}

template <class R>
std::array<double, 2> two_coefficients(int k, const std::vector<Series>& all) {
  const auto both = [&]<std::size_t... A>(std::index_sequence<A...>) {
    return R::two_coefficients(k, all[A]...);
  }(std::make_index_sequence<R::reads.size()>{});
  return {both[0], both[1]};
}

/// A random series, the same for every degree as far as it goes.
template <class J>
J random_operand(const Interval& domain, int number) {
  Uniform draw(7 + number);
  J u(draw(domain.low, domain.high));
  for (int k = 1; k <= J::degree; ++k) u[k] = draw(-1, 1);
  return u;
}

template <class R, class J>
J on_random_operands() {
  return [&]<std::size_t... A>(std::index_sequence<A...>) {
    const auto operand = [](auto a) {
      if constexpr (R::reads[a] == Reads::constant)
        return 2.5;
      else
        return random_operand<J>(domain<R>(), static_cast<int>(a));
    };
    return lift<R, J>(operand(std::integral_constant<std::size_t, A>{})...);
  }(std::make_index_sequence<arity<R>>{});
}

template <class R>
RuleOnJets on_jets() {
  RuleOnJets rule{NameOfRule::GetName<R>(0),
                  {R::reads.begin(), R::reads.end()},
                  domain<R>(),
                  indices_read<R>,
                  coefficient<R>,
                  on_random_operands<R, Series>,
                  on_random_operands<R, Shorter>,
                  -1,
                  nullptr};
  if constexpr (requires { R::two_from; }) {
    rule.two_from = R::two_from;
    rule.two_coefficients = two_coefficients<R>;
  }
  return rule;
}

std::vector<RuleOnJets> all_rules() {
  return []<Rule... R>(RuleList<R...>) { return std::vector<RuleOnJets>{on_jets<R>()...}; }(Rules{});
}

// ---- tests of each ------------------------------------------------------------------------------------------

class RuleLaws : public ::testing::TestWithParam<RuleOnJets> {
 protected:
  const RuleOnJets& rule = GetParam();
  const std::vector<Reads>& reads = rule.reads;

  /// The operands of rule.whole, and room for the result.
  std::vector<Series> random_operands() const {
    std::vector<Series> operands(reads.size());
    for (std::size_t a = 0; a + 1 < reads.size(); ++a)
      operands[a] = reads[a] == Reads::constant ? Series(2.5)
                                                : random_operand<Series>(rule.domain, static_cast<int>(a));
    return operands;
  }
};
INSTANTIATE_TEST_SUITE_P(, RuleLaws, ::testing::ValuesIn(all_rules()),
                         [](const auto& info) { return info.param.name; });

TEST_P(RuleLaws, ReadsOnlyWhatItDeclares) {
  for (int k = 0; k <= degree; ++k) {
    const auto read = rule.indices_read(k);
    for (std::size_t a = 0; a < reads.size(); ++a)
      for (const int j : read[a]) {
        SCOPED_TRACE("order " + std::to_string(k) + " reads coefficient " + std::to_string(j) +
                     " of operand " + std::to_string(a));
        const bool is_result = a + 1 == reads.size();
        EXPECT_GE(j, 0);
        EXPECT_LE(j, is_result ? k - 1 : k);
        EXPECT_NE(reads[a], Reads::nothing);
        if (reads[a] == Reads::constant || reads[a] == Reads::first) {
          EXPECT_EQ(j, 0);
        }
        if (reads[a] == Reads::newest) {
          EXPECT_EQ(j, k);
        }
      }
  }
}

TEST_P(RuleLaws, DeclaresNoMoreThanItReads) {  // what is declared as history is stored for every element
  std::vector<bool> reads_older(reads.size()), reads_any(reads.size());
  for (int k = 0; k <= degree; ++k) {
    const auto read = rule.indices_read(k);
    for (std::size_t a = 0; a < reads.size(); ++a) {
      if (!read[a].empty()) reads_any[a] = true;
      for (const int j : read[a])
        if (0 < j && j < k) reads_older[a] = true;  // 0 alone would be a constant
    }
  }
  for (std::size_t a = 0; a < reads.size(); ++a) {
    EXPECT_EQ(reads_any[a], reads[a] != Reads::nothing) << "operand " << a;
    if (reads[a] == Reads::history) {
      EXPECT_TRUE(reads_older[a]) << "operand " << a;
    }
  }
}

TEST_P(RuleLaws, FirstCoefficientsDoNotDependOnTheDegree) {  // bit for bit
  const Series all = rule.whole();
  const Shorter some = rule.shorter();
  for (int k = 0; k <= Shorter::degree; ++k) EXPECT_EQ(some[k], all[k]) << k;
}

TEST_P(RuleLaws, ResumedSeriesIsTheFreshOne) {
  // In the first pass all coefficients from `half` on are NaN; then they become known and the rule goes on.
  constexpr int half = 6;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Series> known = random_operands(), unknown = known;
  for (Series& u : unknown)
    for (int k = half; k <= degree; ++k) u[k] = nan;
  Series v(nan);
  const auto compute = [&](int k, std::vector<Series>& all) {
    all.back() = v;
    v[k] = rule.coefficient(k, all);
  };
  for (int k = 0; k < half; ++k) compute(k, unknown);
  for (int k = half; k <= degree; ++k) compute(k, known);
  const Series fresh = rule.whole();
  for (int k = 0; k <= degree; ++k) EXPECT_EQ(v[k], fresh[k]) << k;
}

TEST_P(RuleLaws, TwoOrdersAtOnceAreOneAfterTheOther) {  // bit for bit, and nothing unknown is read
  if (rule.two_coefficients == nullptr) return;
  std::vector<Series> all = random_operands();
  const Series fresh = rule.whole();
  for (int k = rule.two_from; k < degree; ++k) {
    for (int j = 0; j <= degree; ++j)
      all.back()[j] = j < k ? fresh[j] : std::numeric_limits<double>::quiet_NaN();
    const auto both = rule.two_coefficients(k, all);
    EXPECT_EQ(both[0], fresh[k]) << k;
    EXPECT_EQ(both[1], fresh[k + 1]) << k;
  }
}

TEST(Embed, GivesANumberTheSeriesOfAConstant) {
  EXPECT_EQ((lift<Embed, Jet<double, 3>>(2.5)), (Jet<double, 3>::from({2.5, 0, 0, 0})));
}

}  // namespace
}  // namespace jetlag::testing::rules_test
