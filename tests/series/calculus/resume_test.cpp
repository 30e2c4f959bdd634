// SPDX-License-Identifier: MIT
// A series can go on where it stopped: order K+1 costs O(K), with the bits of a series made at once.
#include "jetlag/series/calculus/resume.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <tuple>

#include "jetlag/series/elementary.hpp"
#include "support/counted.hpp"
#include "support/random.hpp"
#include "support/rules.hpp"

namespace jetlag::testing {
namespace {

/// A random series, the same for every degree as far as it goes.
template <class R, class T>
Jet<T, Dynamic> random_operand(int number, int degree) {
  Uniform draw(7 + number);
  auto u = Jet<T, Dynamic>::variable(draw(domain<R>().low, domain<R>().high), degree);
  for (int k = 1; k <= degree; ++k) u[k] = draw(-1, 1);
  return u;
}

/// f(u...) with as many random operands of a degree as the rule has; constant ones are numbers.
template <class R, class T, class F>
auto with_operands(int degree, F f) {
  const auto operand = [&]<std::size_t A>(std::integral_constant<std::size_t, A>) {
    if constexpr (R::reads[A] == Reads::constant)
      return T(2.5);
    else
      return random_operand<R, T>(A, degree);
  };
  return [&]<std::size_t... A>(std::index_sequence<A...>) {
    return f(operand(std::integral_constant<std::size_t, A>{})...);
  }(std::make_index_sequence<arity<R>>{});
}

template <class R, class T>
Jet<T, Dynamic> fresh(int degree) {
  return with_operands<R, T>(degree, [](const auto&... u) { return lift<R, Jet<T, Dynamic>>(u...); });
}
template <class R, class T>
void resume_to(Jet<T, Dynamic>& v, int degree) {
  with_operands<R, T>(degree, [&](const auto&... u) { resume<R>(v, u...); });
}

void expect_same_bits(const Jet<double, Dynamic>& u, const Jet<double, Dynamic>& v) {
  ASSERT_EQ(u.degree(), v.degree());
  for (int k = 0; k <= u.degree(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(u[k]), std::bit_cast<std::uint64_t>(v[k])) << "coefficient " << k;
}

template <class R>
class ResumedRule : public ::testing::Test {};
TYPED_TEST_SUITE(ResumedRule, AllRules, NameOfRule);

TYPED_TEST(ResumedRule, HasTheBitsOfTheFreshOne) {
  for (const int first : {0, 1, 4, 7}) {
    auto v = fresh<TypeParam, double>(first);
    resume_to<TypeParam>(v, first + 1);
    resume_to<TypeParam>(v, 12);
    expect_same_bits(v, fresh<TypeParam, double>(12));
  }
}

/// Products for orders first .. last.
template <class R>
std::int64_t products(int first, int last) {
  auto v = fresh<R, Counted>(first - 1);
  std::int64_t count = 0;
  with_operands<R, Counted>(last, [&](const auto&... u) {
    const auto before = Counted::products;
    resume<R>(v, u...);
    count = Counted::products - before;
  });
  return count;
}

TYPED_TEST(ResumedRule, PaysForOneMoreOrderOnly) {
  // at most 8 products for each of the 2 (K + 1) pairs of the longest sums; a fresh start costs K^2 / 2
  for (const int K : {16, 64, 128}) EXPECT_LE(products<TypeParam>(K, K), 16 * (K + 1)) << "order " << K;
  EXPECT_LE(products<TypeParam>(128, 128), 2 * products<TypeParam>(64, 64) + 16);
}

TEST(ResumedRule, CostsInStepsWhatItCostsAtOnce) {
  std::int64_t in_steps = 0;
  for (int k = 1; k <= 40; ++k) in_steps += products<Multiply>(k, k);
  EXPECT_EQ(in_steps, products<Multiply>(1, 40));
  EXPECT_EQ(in_steps, 41 * 42 / 2 - 1);
}

TEST(ResumedJet, GoesOnAsItsOperandsDo) {
  using D = Jet<double, Dynamic>;
  D x = D::from({0.5, 2, -1}), v = exp(x);
  x.append(3.0);
  x.append(-0.25);
  resume<Exp>(v, x);
  expect_same_bits(v, exp(x));
}

TEST(ResumedJet, IsAsLongAsTheShorterOperand) {
  using D = Jet<double, Dynamic>;
  D x = D::from({0.5, 2, -1}), y = x, v = x * y;
  x.append(3.0);
  resume<Multiply>(v, x, y);
  expect_same_bits(v, D::from({0.5, 2, -1}) * y);
  resume<Multiply>(v, x, D(2.0));  // a constant has all coefficients
  EXPECT_EQ(v.degree(), 3);
}

TEST(ResumedJet, OfCoupledRulesIsTheFreshOne) {
  using D = Jet<double, Dynamic>;
  D x = random_operand<Sin, double>(3, 4);
  auto [s, c] = lift_coupled<Sin, Cos>(x);
  x = random_operand<Sin, double>(3, 12);
  resume_coupled<Sin, Cos>(s, c, x);
  expect_same_bits(s, sin(x));
  expect_same_bits(c, cos(x));
}

TEST(ResumedJet, FindsACommonPowerThatHasBecomeKnown) {
  using D = Jet<double, Dynamic>;
  D f = D::from({0, 0}), v = sqrt(f);  // O(t^2), of which the root is O(t)
  EXPECT_EQ(v, D::from({0}));
  f.append(4.0);
  f.append(4.0);
  resume<Sqrt>(v, f);
  expect_same_bits(v, D::from({0, 2, 1}));  // 2 t sqrt(1 + t)
}

TEST(ResumedJet, IsCheckedAsAFreshOne) {
  using C = CheckedJet<double, Dynamic>;
  C x = C::from({700}), v = exp(x);
  x.append(1e300);
  EXPECT_THROW(resume<Exp>(v, x), SingularPoint);
}

}  // namespace
}  // namespace jetlag::testing
