// SPDX-License-Identifier: MIT
// Laws of the rules: every rule of the register has these tests.
#include "support/rules.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "support/random.hpp"

namespace jetlag::testing::rules_test {
namespace {

constexpr int degree = 12;

template <class R>
class RuleLaws : public ::testing::Test {};
TYPED_TEST_SUITE(RuleLaws, AllRules, NameOfRule);

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
auto indices_read(int k) {
  constexpr std::size_t n = R::reads.size();
  std::array<std::set<int>, n> read;
  [&]<std::size_t... A>(std::index_sequence<A...>) {
    const std::vector<double> ones(degree + 1, 1.0);
    R::coefficient(k, Probe{ones, &read[A]}...);
  }(std::make_index_sequence<n>{});
  return read;
}

TYPED_TEST(RuleLaws, ReadsOnlyWhatItDeclares) {
  constexpr auto reads = TypeParam::reads;
  for (int k = 0; k <= degree; ++k) {
    const auto read = indices_read<TypeParam>(k);
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

TYPED_TEST(RuleLaws, DeclaresNoMoreThanItReads) {  // what is declared as history is stored for every element
  constexpr auto reads = TypeParam::reads;
  std::array<bool, reads.size()> reads_older{}, reads_any{};
  for (int k = 0; k <= degree; ++k) {
    const auto read = indices_read<TypeParam>(k);
    for (std::size_t a = 0; a < reads.size(); ++a) {
      reads_any[a] |= !read[a].empty();
      for (const int j : read[a]) reads_older[a] |= 0 < j && j < k;  // 0 alone would be a constant
    }
  }
  for (std::size_t a = 0; a < reads.size(); ++a) {
    EXPECT_EQ(reads_any[a], reads[a] != Reads::nothing) << "operand " << a;
    if (reads[a] == Reads::history) {
      EXPECT_TRUE(reads_older[a]) << "operand " << a;
    }
  }
}

/// A random series, the same for every degree as far as it goes.
template <class R, int N>
Jet<double, N> random_operand(int number) {
  Uniform draw(7 + number);
  Jet<double, N> u(draw(domain<R>().low, domain<R>().high));
  for (int k = 1; k <= N; ++k) u[k] = draw(-1, 1);
  return u;
}

/// The rule as a function of as many random operands as it has.
template <class R, int N>
Jet<double, N> on_random_operands() {
  return [&]<std::size_t... A>(std::index_sequence<A...>) {
    const auto operand = [](auto a) {
      if constexpr (R::reads[a] == Reads::constant)
        return 2.5;
      else
        return random_operand<R, N>(a);
    };
    return lift<R, Jet<double, N>>(operand(std::integral_constant<std::size_t, A>{})...);
  }(std::make_index_sequence<arity<R>>{});
}

TYPED_TEST(RuleLaws, FirstCoefficientsDoNotDependOnTheDegree) {  // bit for bit
  const auto all = on_random_operands<TypeParam, degree>();
  const auto some = on_random_operands<TypeParam, degree - 5>();
  for (int k = 0; k <= degree - 5; ++k) EXPECT_EQ(some[k], all[k]) << k;
}

TYPED_TEST(RuleLaws, ResumedSeriesIsTheFreshOne) {
  // In the first pass all coefficients from `half` on are NaN; then they become known and the rule goes on.
  constexpr int half = 6;
  constexpr std::size_t n = TypeParam::reads.size();
  std::array<Jet<double, degree>, n> known, unknown;
  for (std::size_t a = 0; a < n; ++a) {
    known[a] = TypeParam::reads[a] == Reads::constant
                   ? Jet<double, degree>(2.5)
                   : random_operand<TypeParam, degree>(static_cast<int>(a));
    unknown[a] = known[a];
    for (int k = half; k <= degree; ++k) unknown[a][k] = std::numeric_limits<double>::quiet_NaN();
  }
  Jet<double, degree> v(std::numeric_limits<double>::quiet_NaN());
  const auto compute = [&]<std::size_t... A>(int k, const auto& operands, std::index_sequence<A...>) {
    v[k] = TypeParam::coefficient(k, operands[A]..., v);
  };
  for (int k = 0; k < half; ++k) compute(k, unknown, std::make_index_sequence<n - 1>{});
  for (int k = half; k <= degree; ++k) compute(k, known, std::make_index_sequence<n - 1>{});
  const auto fresh = on_random_operands<TypeParam, degree>();
  for (int k = 0; k <= degree; ++k) EXPECT_EQ(v[k], fresh[k]) << k;
}

TYPED_TEST(RuleLaws, TwoOrdersAtOnceAreOneAfterTheOther) {  // bit for bit, and nothing unknown is read
  if constexpr (requires { TypeParam::two_from; }) {
    constexpr std::size_t n = TypeParam::reads.size();
    std::array<Jet<double, degree>, n> operands;
    for (std::size_t a = 0; a + 1 < n; ++a)
      operands[a] = TypeParam::reads[a] == Reads::constant
                        ? Jet<double, degree>(2.5)
                        : random_operand<TypeParam, degree>(static_cast<int>(a));
    const auto fresh = on_random_operands<TypeParam, degree>();
    for (int k = TypeParam::two_from; k < degree; ++k) {
      auto& v = operands[n - 1];
      for (int j = 0; j <= degree; ++j) v[j] = j < k ? fresh[j] : std::numeric_limits<double>::quiet_NaN();
      const auto both =
          std::apply([&](const auto&... u) { return TypeParam::two_coefficients(k, u...); }, operands);
      EXPECT_EQ(both[0], fresh[k]) << k;
      EXPECT_EQ(both[1], fresh[k + 1]) << k;
    }
  }
}

TEST(Embed, GivesANumberTheSeriesOfAConstant) {
  EXPECT_EQ((lift<Embed, Jet<double, 3>>(2.5)), (Jet<double, 3>::from({2.5, 0, 0, 0})));
}

}  // namespace
}  // namespace jetlag::testing::rules_test
