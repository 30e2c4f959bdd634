// SPDX-License-Identifier: MIT
// Sign changes of polynomials: all of them, in order, to the last bit; truth from 50 digits.

#include "jetlag/series/calculus/roots.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/series/calculus/polynomial.hpp"
#include "support/digits50.hpp"
#include "support/random.hpp"

namespace jetlag::testing::roots_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Coefficients = std::vector<double>;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Digits50> in_50_digits(const Coefficients& c) { return {c.begin(), c.end()}; }

/// All roots in (0, h) at which a polynomial changes sign: between neighbouring roots of its derivative it is monotone.
std::vector<Digits50> true_roots(const std::vector<Digits50>& c, const Digits50& h) {
  if (c.size() < 2) return {};
  std::vector<Digits50> derivative;
  for (std::size_t k = 1; k < c.size(); ++k) derivative.push_back(c[k] * static_cast<double>(k));
  std::vector<Digits50> borders = true_roots(derivative, h), roots;
  borders.insert(borders.begin(), Digits50(0));
  borders.push_back(h);
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const auto f = [&](const Digits50& s) { return evaluate(c, s); };
    if (f(borders[i - 1]) * f(borders[i]) >= 0) continue;
    std::uintmax_t steps = 5000;
    const auto bracket = boost::math::tools::toms748_solve(
        f, borders[i - 1], borders[i], boost::math::tools::eps_tolerance<Digits50>(150), steps);
    roots.push_back((bracket.first + bracket.second) / 2);
  }
  return roots;
}

/// prod_i (s - root_i), in 50 digits, rounded at the end.
Coefficients with_roots(const std::vector<double>& roots) {
  std::vector<Digits50> c{1};
  for (const double root : roots) {
    c.insert(c.begin(), Digits50(0));
    for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] -= root * c[k + 1];
  }
  Coefficients rounded;
  for (const Digits50& x : c) rounded.push_back(static_cast<double>(x));
  return rounded;
}

/// Each root lies in (the double before s, s], and the signs alternate as they must.
void expect_true_roots(const Coefficients& c, double h) {
  const auto truth = true_roots(in_50_digits(c), h);
  const auto found = sign_changes(c, h);
  ASSERT_EQ(found.size(), truth.size()) << ::testing::PrintToString(c);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LE(truth[i], found[i].s) << i;
    EXPECT_GT(truth[i], std::nextafter(found[i].s, 0.0)) << i;
    const Digits50 before = i == 0 ? Digits50(0) : truth[i - 1];
    EXPECT_EQ(evaluate(in_50_digits(c), Digits50((before + truth[i]) / 2)) < 0, found[i].rising) << i;
  }
}

TEST(SignChanges, AreInOrder) {
  EXPECT_THAT(sign_changes(Coefficients{0.5, -1.5, 1.0}, 2.0),
              ElementsAre(SignChange{0.5, false}, SignChange{1.0, true}));
}

TEST(SignChanges, AreTheRootsOfRandomPolynomials) {
  // Coefficients as of a motion, with terms that decrease (size 1/2) or not (size 2) at h = 1. None of these has two
  // roots so close that they might be taken for a touch.
  Uniform random(1);
  std::size_t roots = 0;
  for (int i = 0; i < 60; ++i) {
    Coefficients c(2 + i % 20);
    const double size = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 1.0 : 2.0;
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = random(-1, 1) * std::pow(size, static_cast<double>(k));
    c[0] *= 0.1;
    SCOPED_TRACE(::testing::Message() << "seed 1, polynomial " << i);
    expect_true_roots(c, 1.0);
    roots += sign_changes(c, 1.0).size();
  }
  EXPECT_GT(roots, 40u);
}

TEST(SignChanges, AreTheRootsThatAPolynomialWasMadeFrom) {
  // Up to six roots inside, at least 0.01 apart, and up to four outside.
  Uniform random(2);
  for (int i = 0; i < 60; ++i) {
    std::vector<double> roots;
    while (roots.size() < static_cast<std::size_t>(1 + i % 6)) {
      const double root = random(0.01, 0.99);
      if (std::ranges::all_of(roots, [&](double other) { return std::abs(other - root) > 0.01; }))
        roots.push_back(root);
    }
    const std::size_t inside = roots.size();
    for (int j = 0; j < i % 5; ++j) roots.push_back(random(1.1, 3.0) * (j % 2 == 0 ? 1 : -1));
    SCOPED_TRACE(::testing::Message() << "seed 2, polynomial " << i);
    expect_true_roots(with_roots(roots), 1.0);
    EXPECT_EQ(sign_changes(with_roots(roots), 1.0).size(), inside);
  }
}

TEST(SignChanges, AreFoundWhereEachRootIsIllConditioned) {
  // Wilkinson's polynomials with roots 1/N, 2/N, ..., 1 on (0, 1.05]. Rounding the coefficients by eps/2 moves a root
  // by cond eps; at N = 15 the roots are still apart and real, at 20 they would not be.
  for (const int n : {5, 10, 15}) {
    std::vector<double> roots;
    for (int i = 1; i <= n; ++i) roots.push_back(i / static_cast<double>(n));
    expect_true_roots(with_roots(roots), 1.05);
    EXPECT_EQ(sign_changes(with_roots(roots), 1.05).size(), static_cast<std::size_t>(n));
  }
}

TEST(SignChanges, AreFoundAtAnyScale) {
  // (s - a)(s - 2a)(s - 1): a is far below the rounding of the interval, not of its own neighbourhood.
  for (const double a : {0x1p-40, 0x1p-100, 0x1p-500}) {
    const Coefficients c{-2 * a * a, 3 * a + 2 * a * a, -1 - 3 * a, 1.0};
    expect_true_roots(c, 2.0);
    EXPECT_EQ(sign_changes(c, 2.0).size(), 3u) << a;
  }
}

TEST(SignChanges, AreFoundWhereDoublesAreSparse) {
  // s - 1/3: the first double at or after 1/3 in real numbers, which lies above the double 1/3.
  const auto found = sign_changes(Coefficients{-1.0, 3.0}, 1.0);
  EXPECT_THAT(found, ElementsAre(SignChange{std::nextafter(1.0 / 3.0, 1.0), true}));
}

TEST(SignChanges, ResolveTwoRootsCloseTogether) {
  // (s - 1)(s - 1 - d) dips by d^2/4; its rounding is 12 eps (1 + 2 + 1) = 1.1e-14, passed from d = 2.1e-7 on.
  const auto pair = [](double d) { return Coefficients{1 + d, -2 - d, 1.0}; };
  for (const double d : {0x1p-4, 0x1p-16, 0x1p-22})
    for (const double h : {1.25, 2.0, 100.0})
      EXPECT_THAT(sign_changes(pair(d), h), ElementsAre(SignChange{1.0, false}, SignChange{1 + d, true}))
          << d;
  for (const double d : {0x1p-24, 0x1p-26, 0.0})
    for (const double h : {1.25, 2.0, 100.0}) EXPECT_THAT(sign_changes(pair(d), h), IsEmpty()) << d;
}

TEST(SignChanges, AreNotTouches) {
  // (s - a)^2, (s - a)^4 with rounded coefficients: at random places, and where a bisection would look first.
  Uniform random(3);
  for (int i = 0; i < 100; ++i) {
    const double a = i < 5 ? std::array{0.5, 0.25, 0.75, 0.4375, 1.0}[i] : random(0.0, 1.1);
    EXPECT_THAT(sign_changes(with_roots({a, a}), 1.0), IsEmpty()) << a << ", seed 3";
    EXPECT_THAT(sign_changes(with_roots({a, a, a, a}), 1.0), IsEmpty()) << a << ", seed 3";
  }
}

TEST(SignChanges, AreRootsOfOddMultiplicity) {
  // (s - a)^3 dips nowhere; rounding, 16 eps (8 a^3), spreads its root by the cube root of that: 3.1e-5 a.
  for (const double a : {0.3, 0.5, 0.7}) {
    const auto found = sign_changes(with_roots({a, a, a}), 1.0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].s, a, std::cbrt(128 * eps) * a);
    EXPECT_TRUE(found[0].rising);
  }
}

TEST(SignChanges, AtRootsOfOddMultiplicityAreExactWhereTheCoefficientsAre) {
  EXPECT_THAT(sign_changes(Coefficients{-1.0, 3.0, -3.0, 1.0}, 3.0), ElementsAre(SignChange{1.0, true}));
  for (const int multiplicity : {3, 5, 7, 9})
    for (const double a :
         {0.25, 0.375, 0.5, 0.625, 1.0, 1.5, 3.0})  // a^9 has at most 27 bits: no coefficient is rounded
      for (const double h : {3.5, 10.0, 1000.0}) {
        const Coefficients c = with_roots(std::vector<double>(multiplicity, a));
        EXPECT_THAT(sign_changes(c, h), ElementsAre(SignChange{a, true})) << a << ", " << multiplicity;
      }
}

TEST(SignChanges,
     BesideARootOfOddMultiplicityAreExact) {  // (s - 1/2)^3 (s - 2)^2 (s - 3), whole numbers over 8
  EXPECT_THAT(sign_changes(with_roots({0.5, 0.5, 0.5, 2.0, 2.0, 3.0}), 5.0),
              ElementsAre(SignChange{0.5, false}, SignChange{3.0, true}));
  EXPECT_THAT(sign_changes(with_roots({0.5, 0.5, 0.5, 1.5, 1.5, 1.5}), 5.0),
              ElementsAre(SignChange{0.5, false}, SignChange{1.5, true}));
}

TEST(SignChanges, OfRoundedCoefficientsAreThoseOfThePolynomialTheyAre) {
  // (s - a)^3, a with 53 bits: rounded, its three roots are up to 1e-5 from a; the sign in 50 digits changes there.
  Uniform random(5);
  for (int i = 0; i < 50; ++i) {
    const double a = random(0.1, 0.9);
    const Coefficients c = with_roots({a, a, a});
    const auto found = sign_changes(c, 1.0);
    ASSERT_EQ(found.size(), 1u) << a << ", seed 5";
    EXPECT_GE(evaluate(in_50_digits(c), Digits50(found[0].s)), 0) << a;
    EXPECT_LT(evaluate(in_50_digits(c), Digits50(std::nextafter(found[0].s, 0.0))), 0) << a;
  }
}

TEST(SignChanges, AtTheBordersOfTheInterval) {
  // A root at 0 is left, one at h is reached; the doubles beside h are told apart.
  EXPECT_THAT(sign_changes(Coefficients{0.0, 1.0}, 1.0), IsEmpty());
  EXPECT_THAT(sign_changes(Coefficients{0.0, -1.0, 2.0}, 1.0), ElementsAre(SignChange{0.5, true}));
  EXPECT_THAT(sign_changes(Coefficients{0.0, 0.0, -1.0, 2.0}, 1.0), ElementsAre(SignChange{0.5, true}));
  for (const double h : {0.3, 1.0, 7.7}) {
    EXPECT_THAT(sign_changes(Coefficients{-h, 1.0}, h), ElementsAre(SignChange{h, true}));
    EXPECT_THAT(sign_changes(Coefficients{-h, 1.0}, std::nextafter(h, 0.0)), IsEmpty());
    EXPECT_THAT(sign_changes(Coefficients{-h, 1.0}, std::nextafter(h, 10.0)),
                ElementsAre(SignChange{h, true}));
  }
  EXPECT_THAT(sign_changes(with_roots({1.0, 1.0}), 1.0), IsEmpty());  // touches at h
}

TEST(SignChanges, OfWhatHasNone) {
  EXPECT_THAT(sign_changes(Coefficients{}, 1.0), IsEmpty());
  EXPECT_THAT(sign_changes(Coefficients{0.0, 0.0, 0.0}, 1.0), IsEmpty());
  EXPECT_THAT(sign_changes(Coefficients{-3.0}, 1.0), IsEmpty());
  EXPECT_THAT(sign_changes(Coefficients{1.0, 0.0, 1.0}, 1e6), IsEmpty());
}

TEST(SignChanges, RefuseWhatIsNotFinite) {
  EXPECT_THROW(sign_changes(Coefficients{1.0, NAN}, 1.0), std::invalid_argument);
  EXPECT_THROW(sign_changes(Coefficients{infinity, 1.0}, 1.0), std::invalid_argument);
  for (const double h : {0.0, -1.0, infinity, double{NAN}})
    EXPECT_THROW(sign_changes(Coefficients{-1.0, 1.0}, h), std::invalid_argument);
  EXPECT_THROW(sign_changes(Coefficients{-1.0, 0.0, 1.0}, 1e200), std::invalid_argument);
}

TEST(AccurateValue, HasTwiceTheDigits) {
  // (s - 1)^7 near 1, where Horner's rule in double has no correct digit: to eps, and 15^2 eps^2 128 of the sum.
  const Coefficients c = with_roots({1, 1, 1, 1, 1, 1, 1});
  for (const double s : {1.0 + 0x1p-10, 1.0 - 0x1p-12, 1.001, 0.9993}) {
    const Digits50 truth = evaluate(in_50_digits(c), Digits50(s));
    EXPECT_LE(abs(accurate_value(c, s) - truth), eps * abs(truth) + 49 * eps * eps * 128) << s;
  }
}

}  // namespace
}  // namespace jetlag::testing::roots_test
