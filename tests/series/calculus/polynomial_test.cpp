// SPDX-License-Identifier: MIT
// Polynomials: compensated evaluation against exact rational arithmetic.
#include "jetlag/series/calculus/polynomial.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/binomial.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "jetlag/series/jet.hpp"
#include "support/random.hpp"

namespace jetlag::testing::polynomial_test {
namespace {

using Exact = boost::multiprecision::cpp_rational;

template <class T>
Exact exact(T x) {  // a number is m 2^e
  int e = 0;
  const auto digits = std::numeric_limits<T>::digits;
  const T m = std::ldexp(std::frexp(x, &e), digits);
  const boost::multiprecision::cpp_int numerator(m);
  const auto power = boost::multiprecision::cpp_int(1) << std::abs(e - digits);
  return e >= digits ? Exact(numerator * power) : Exact(numerator, power);
}

/// (t - 1)^n, whole coefficients of at most 2^24, exact in all types; near t = 1 its condition is ((1 + t)/(1 - t))^n.
template <class T>
std::vector<T> power_of_t_minus_1(unsigned n) {
  std::vector<T> c;
  for (unsigned k = 0; k <= n; ++k)
    c.push_back(((n - k) % 2 ? -1 : 1) * std::round(boost::math::binomial_coefficient<T>(n, k)));
  return c;
}

template <class T>
class CompensatedHorner : public ::testing::Test {
 protected:
  static constexpr unsigned degree = 12;
  /// The points 1 + j 2^-i, near the root, ever closer.
  static std::vector<T> near_one() {
    std::vector<T> points;
    for (int i = 1; i < std::numeric_limits<T>::digits - 8; ++i)
      for (const int j : {-3, -1, 1, 5, 7}) points.push_back(T(1) + j * std::ldexp(T(1), -i - 3));
    return points;
  }
  /// u, and g^2 sum |c_k| |t|^k of the theorem, exactly.
  static Exact unit() { return exact(std::numeric_limits<T>::epsilon()) / 2; }
  static Exact second_order(const std::vector<T>& c, T t) {
    const Exact n = 2 * static_cast<int>(c.size() - 1), g = n * unit() / (1 - n * unit());
    std::vector<Exact> sizes;
    for (const T& x : c) sizes.push_back(exact(std::abs(x)));
    return g * g * evaluate(sizes, exact(std::abs(t)));
  }
  static Exact truth(const std::vector<T>& c, T t) {
    std::vector<Exact> coefficients;
    for (const T& x : c) coefficients.push_back(exact(x));
    return evaluate(coefficients, exact(t));
  }
};
using Floats = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(CompensatedHorner, Floats);

TYPED_TEST(CompensatedHorner, KeepsTheBoundOfItsTheoremNearARootOfHighOrder) {
  using T = TypeParam;
  const auto c = power_of_t_minus_1<T>(this->degree);
  for (const T t : this->near_one()) {
    const Exact p = this->truth(c, t), second = this->second_order(c, t);
    const auto parts = evaluate_in_two_parts(c, t);
    EXPECT_LE(abs(exact(parts.high) + exact(parts.low) - p), second) << t;
    EXPECT_LE(abs(exact(evaluate_compensated(c, t)) - p), this->unit() * abs(p) + second) << t;
    EXPECT_EQ(parts.high, evaluate(c, t));
  }
}

TYPED_TEST(CompensatedHorner, KeepsItsBoundOnRandomSeries) {
  using T = TypeParam;
  Uniform draw(3);
  for (int i = 0; i < 50; ++i) {
    std::vector<T> c;
    for (int k = 0; k <= 20; ++k) c.push_back(static_cast<T>(draw(-1, 1)) / T(3));
    const T t = static_cast<T>(draw(-2, 2));
    const Exact p = this->truth(c, t);
    EXPECT_LE(abs(exact(evaluate_compensated(c, t)) - p), this->unit() * abs(p) + this->second_order(c, t));
  }
}

// Condition (2.07/0.07)^12 = 2^58: Horner's rule has no digit left, the compensated one (24 u)^2 2^58 = 2^-39 of p.
TEST(EvaluateCompensated, HasTheDigitsThatHornerHasLost) {
  const auto c = power_of_t_minus_1<double>(12);
  const double t = 1.0 + 0x1.23456789abcdep-4;
  const double p = std::pow(t - 1.0, 12);  // t - 1 is exact
  EXPECT_LE(std::abs(evaluate_compensated(c, t) - p), 0x1p-39 * p);
  EXPECT_GT(std::abs(evaluate(c, t) - p), 0.01 * p);
}

TEST(EvaluateCompensated, TakesAnyContainerAndJets) {
  using J = Jet<double, 3>;
  EXPECT_EQ(evaluate_compensated(std::array{1.0F, 2.0F, 3.0F}, 10.0), 321.0);
  EXPECT_EQ(evaluate_compensated(J::from({1, 2, 3, 4}), 10.0), 4321.0);
  EXPECT_EQ(evaluate_compensated(std::vector<double>{}, 10.0), 0.0);
  EXPECT_EQ(evaluate_compensated(std::vector<double>{7.0}, 10.0), 7.0);
}

TEST(EvaluateCompensated, IsInfiniteWhereHornerIs) {
  const std::vector<double> c{1.0, 1e300, 1e300};
  EXPECT_EQ(evaluate_compensated(c, 1e10), std::numeric_limits<double>::infinity());
  EXPECT_EQ(evaluate_in_two_parts(c, 1e10).low, 0.0);
  EXPECT_EQ(evaluate_compensated(std::vector<double>{0.0, 0x1p1000}, 0x1p20), 0x1p1020);  // the largest too
}

}  // namespace
}  // namespace jetlag::testing::polynomial_test
