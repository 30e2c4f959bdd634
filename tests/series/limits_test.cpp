// SPDX-License-Identifier: MIT
// What generic code asks of a number: limits, isnan, isinf; and powers with exponents of every kind.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "jetlag/series/eigen.hpp"
#include "jetlag/tape/recording.hpp"

namespace jetlag::testing::limits_test {
namespace {

template <class S>
class Limits : public ::testing::Test {};
using Jets = ::testing::Types<Jet<double, 4>, Jet<double, Dynamic>, CheckedJet<double, 4>,
                              CheckedJet<double, Dynamic>, Jet<Jet<double, 2>, 3>>;
TYPED_TEST_SUITE(Limits, Jets);

TYPED_TEST(Limits, AreThoseOfTheCoefficients) {
  using L = std::numeric_limits<TypeParam>;
  using D = std::numeric_limits<double>;
  static_assert(L::is_specialized && !L::is_integer && L::is_signed && L::has_infinity && L::has_quiet_NaN);
  static_assert(L::digits == D::digits && L::radix == 2 && L::max_exponent == D::max_exponent);
  EXPECT_EQ(L::max(), TypeParam(D::max()));
  EXPECT_EQ(L::lowest(), TypeParam(D::lowest()));
  EXPECT_EQ(L::epsilon(), TypeParam(D::epsilon()));
  EXPECT_EQ(L::infinity(), TypeParam(D::infinity()));
  EXPECT_TRUE(isnan(L::quiet_NaN()));
}

TEST(Limits, OfTheSmallestAreInfinitelySmall) {  // in the order of jets
  using L = std::numeric_limits<Jet<double, 4>>;
  const auto t = Jet<double, 4>::variable(0.0);
  EXPECT_GT(L::min(), 0.0);
  EXPECT_LT(L::min(), 1e-300 * pow(t, 4));
  EXPECT_GT(L::denorm_min(), 0.0);
  EXPECT_LT(L::denorm_min(), L::min());
}

TYPED_TEST(Limits, ClassesAreThoseOfTheWorstCoefficient) {
  using L = std::numeric_limits<TypeParam>;
  TypeParam u = TypeParam::from({1.0, 2.0});
  EXPECT_FALSE(isnan(u) || isinf(u));
  EXPECT_TRUE(isfinite(u));
  u[1] = L::infinity()[0];
  EXPECT_TRUE(isinf(u));
  EXPECT_FALSE(isnan(u) || isfinite(u));
  u[0] = L::quiet_NaN()[0];
  EXPECT_TRUE(isnan(u));
  EXPECT_FALSE(isinf(u) || isfinite(u));
}

TYPED_TEST(Limits, InEigenAreThoseOfTheCoefficients) {
  using Traits = Eigen::NumTraits<TypeParam>;
  EXPECT_EQ(jetlag::detail::size_in_series(Traits::dummy_precision()),
            Eigen::NumTraits<double>::dummy_precision());
  EXPECT_TRUE(Eigen::internal::isApprox(TypeParam(1.0), TypeParam(1.0 + 1e-13)));
  EXPECT_FALSE(Eigen::internal::isApprox(TypeParam(1.0), TypeParam(1.0 + 1e-11)));
  EXPECT_EQ(Traits::highest(), TypeParam(std::numeric_limits<double>::max()));
  EXPECT_EQ(Traits::digits10(), 15);
}

TEST(Limits, OfRecordedNumbersAreThoseOfDouble) {
  using Traits = Eigen::NumTraits<Recorded>;
  EXPECT_EQ(Traits::epsilon().value(), 0x1p-52);
  EXPECT_EQ(Traits::dummy_precision().value(), 1e-12);
  EXPECT_EQ(Traits::highest().value(), std::numeric_limits<double>::max());
  EXPECT_EQ(std::numeric_limits<Recorded>::digits, 53);
}

// ---- powers ----------------------------------------------------------------------------------------------

using J = Jet<double, 4>;
const J t = J::variable(0.0);

TEST(Pow, TakesWholeExponentsOfAnyType) {
  EXPECT_EQ(pow(1.0 + t, std::int64_t{3}), pow(1.0 + t, 3));
  EXPECT_EQ(pow(1.0 + t, std::uint8_t{3}), pow(1.0 + t, 3));
  EXPECT_EQ(pow(2.0 + t, -3L), pow(2.0 + t, -3));
  EXPECT_EQ(pow(-2.0 + t, 3ULL), pow(-2.0 + t, 3));
  EXPECT_EQ(pow(t, std::numeric_limits<std::int64_t>::max()), J(0.0));
  EXPECT_EQ(pow(J(1.0), std::numeric_limits<int>::min()), J(1.0));
  EXPECT_EQ(pow(J(1.0), std::numeric_limits<std::int64_t>::min()), J(1.0));
  EXPECT_EQ(pow(J(-1.0), std::numeric_limits<std::uint64_t>::max()), J(-1.0));
}

TEST(Pow,
     OfAnExponentBeyond32BitsHasItsBinomials) {  // (1 + t)^n = sum n (n-1) ... / k! t^k
  for (const std::int64_t n : {4294967297LL, -4294967297LL, (1LL << 53) - 1, 1LL << 40}) {
    const J p = pow(1.0 + t, n), q = pow(-1.0 - t, n);
    long double binomial = 1;
    for (int k = 0; k <= 4; ++k) {
      const double expected = static_cast<double>(binomial);  // each order rounds a few times, not n times
      EXPECT_NEAR(p[k], expected, 64 * 0x1p-52 * std::abs(expected)) << n << ", " << k;
      EXPECT_NEAR(q[k], n % 2 == 0 ? expected : -expected, 64 * 0x1p-52 * std::abs(expected))
          << n << ", " << k;
      binomial = binomial * (static_cast<long double>(n) - k) / (k + 1);
    }
  }
  // (1 + 2^-30)^n = exp(n log1p(2^-30)), about e^4: the argument is off by 4 eps; n products would be off by n eps/2.
  const double x = 1 + 0x1p-30;
  EXPECT_NEAR(pow(x + t, 4294967297LL)[0] / std::exp(4294967297.0 * std::log1p(0x1p-30)), 1, 16 * 0x1p-52);
}

TEST(Pow, OfANegativeNumberByANumberIsThatNumber) {
  EXPECT_EQ(pow(-2.0, J(3.0)), J(-8.0));
  EXPECT_EQ(pow(-2.0, J(3.0)), pow(J(-2.0), J(3.0)));
  EXPECT_EQ(pow(-2, J(-2.0)), J(0.25));
  EXPECT_EQ(pow(0.0, J(2.0)), J(0.0));
  EXPECT_EQ(pow(-2.0, 3.0 + 0.0 * t), J(-8.0));
  EXPECT_TRUE(isnan(pow(-2.0, J(0.5))));
  EXPECT_TRUE(isnan(pow(-2.0, 3.0 + t)));
  using D = Jet<double, Dynamic>;
  EXPECT_EQ(pow(-2.0, D::from({3, 0, 0})), D::from({-8, 0, 0}));
  EXPECT_EQ(pow(-2.0, D::from({3, 0, 0})).degree(), 2);
  EXPECT_THROW((pow(-2.0, CheckedJet<double, 4>(0.5))), SingularPoint);
}

}  // namespace
}  // namespace jetlag::testing::limits_test
