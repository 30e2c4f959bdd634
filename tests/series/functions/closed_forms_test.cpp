// SPDX-License-Identifier: MIT
// Coefficients of f(x + t) known in closed form, in 100 digits, in every number type.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/bernoulli.hpp>
#include <boost/math/special_functions/factorials.hpp>
#include <boost/math/special_functions/hermite.hpp>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/number_types.hpp"
#include "support/random.hpp"

namespace jetlag::testing::closed_forms_test {
namespace {

using D = Digits100;
constexpr int highest_degree = 40;

D sign(int k) { return k % 2 == 0 ? 1 : -1; }  // (-1)^k
D inverse_factorial(int k) { return 1 / boost::math::factorial<D>(k); }

/// P_k(z) for any real z. Source: Bonnet, k P_k = (2k - 1) z P_{k-1} - (k - 1) P_{k-2}.
D legendre(int k, const D& z) {
  D older = 0, p = 1;
  for (int j = 1; j <= k; ++j) {
    const D next = ((2 * j - 1) * z * p - (j - 1) * older) / j;
    older = p;
    p = next;
  }
  return p;
}

template <class T>
class ClosedForms : public ::testing::Test {
 protected:
  /// Coefficient k of f(x + t) is expected(x, k), at random x in [low, high).
  template <class F, class E>
  void expect(F f, E expected, double low, double high) {
    constexpr int degree = std::is_same_v<T, float> ? 20 : highest_degree;  // 1/40! underflows in float
    using J = Jet<RunningError<T>, degree>;
    Uniform draw(31);
    for (int i = 0; i < 4; ++i) {
      const T x(static_cast<float>(draw(low, high)));  // a number of all types
      const J actual = f(J::variable(x));
      EXPECT_THAT(actual, HasCoefficients([&](int k) { return D(expected(D(x), k)); })) << "at " << x;
      const auto plain =
          f(Jet<T, degree>::variable(x));  // what is proved of tracked numbers holds for plain ones
      for (int k = 0; k <= degree; ++k) EXPECT_EQ(plain[k], actual[k].value) << "at " << x << ", order " << k;
    }
  }
};
TYPED_TEST_SUITE(ClosedForms, NumberTypes, NameOfNumberType);

TYPED_TEST(ClosedForms, Cbrt) {  // binomial series: c_k = x^(1/3 - k) C(1/3, k)
  const auto expected = [](const D& x, int k) {
    D c = cbrt(x);
    for (int j = 0; j < k; ++j) c *= (D(1) / 3 - j) / (j + 1) / x;
    return c;
  };
  this->expect([](const auto& u) { return cbrt(u); }, expected, 0.5, 20.0);
  this->expect([](const auto& u) { return cbrt(u); }, expected, -20.0, -0.5);
}

TYPED_TEST(ClosedForms, Expm1) {
  this->expect([](const auto& u) { return expm1(u); },
               [](const D& x, int k) { return D(k == 0 ? expm1(x) : exp(x) * inverse_factorial(k)); }, -3.0,
               3.0);
}

/// Coefficient k of log(x + t).
D log_coefficient(const D& x, int k) { return k == 0 ? log(x) : D(-sign(k) / (k * pow(x, k))); }

TYPED_TEST(ClosedForms, Logarithms) {
  this->expect([](const auto& u) { return log1p(u); },
               [](const D& x, int k) { return log_coefficient(1 + x, k); }, -0.5, 5.0);
  this->expect([](const auto& u) { return log2(u); },
               [](const D& x, int k) { return log_coefficient(x, k) / log(D(2)); }, 0.5, 5.0);
  this->expect([](const auto& u) { return log10(u); },
               [](const D& x, int k) { return log_coefficient(x, k) / log(D(10)); }, 0.5, 5.0);
}

TYPED_TEST(ClosedForms, SinhAndCosh) {
  const auto of_parity = [](int odd) {
    return [odd](const D& x, int k) { return D((k % 2 == odd ? cosh(x) : sinh(x)) * inverse_factorial(k)); };
  };
  this->expect([](const auto& u) { return sinh(u); }, of_parity(1), -3.0, 3.0);
  this->expect([](const auto& u) { return cosh(u); }, of_parity(0), -3.0, 3.0);
}

/// Coefficients of f about x when f' = 1 + s f^2, from f(x): f^(k) = P_k(f), P_0(y) = y, P_{k+1} = (1 + s y^2) P_k',
/// polynomials with whole coefficients (derivative polynomials, as for tan in Knuth and Buckholtz 1967).
std::vector<D> of_derivative_polynomials(const D& f, int s) {
  std::vector<D> p{0, 1}, coefficients;
  for (int k = 0; k <= highest_degree; ++k) {
    D value = 0;
    for (std::size_t i = p.size(); i-- > 0;) value = value * f + p[i];
    coefficients.push_back(value * inverse_factorial(k));
    std::vector<D> next(p.size() + 1, D(0));
    for (std::size_t i = 1; i < p.size(); ++i) {
      next[i - 1] += i * p[i];
      next[i + 1] += s * (i * p[i]);
    }
    p = std::move(next);
  }
  return coefficients;
}

TYPED_TEST(ClosedForms, TanAndTanh) {
  this->expect([](const auto& u) { return tan(u); },
               [](const D& x, int k) { return of_derivative_polynomials(tan(x), 1)[k]; }, -1.25, 1.25);
  this->expect([](const auto& u) { return tanh(u); },
               [](const D& x, int k) { return of_derivative_polynomials(tanh(x), -1)[k]; }, -1.5, 1.5);
}

TYPED_TEST(ClosedForms, AsinAndAcos) {
  // asin' = (1 - x^2 - 2xt - t^2)^(-1/2) = (1/a) sum q_k (t/a)^k, a = sqrt(1 - x^2): Legendre's generating function at
  // i t/a, of the argument x/(i a), q_k = i^k P_k; the q_k are real, k q_k = (2k - 1) (x/a) q_{k-1} + (k - 1) q_{k-2}
  const auto asin_coefficient = [](const D& x, int k) -> D {
    if (k == 0) return asin(x);
    const D a = sqrt((1 - x) * (1 + x));
    D older = 0, q = 1;
    for (int j = 1; j < k; ++j) {
      const D next = ((2 * j - 1) * (x / a) * q + (j - 1) * older) / j;
      older = q;
      q = next;
    }
    return q / (k * pow(a, k));
  };
  this->expect([](const auto& u) { return asin(u); }, asin_coefficient, -0.75, 0.75);
  this->expect([](const auto& u) { return acos(u); },
               [&](const D& x, int k) { return k == 0 ? D(acos(x)) : D(-asin_coefficient(x, k)); }, -0.75,
               0.75);
}

/// Coefficient k of atan(x + t): the imaginary part of log(1 + i(x + t)), polar form of 1/(x - i)^k.
D atan_coefficient(const D& x, int k) {
  if (k == 0) return atan(x);
  return -sign(k) * sin(k * atan2(D(1), x)) / (k * pow(hypot(x, D(1)), k));
}

TYPED_TEST(ClosedForms, Atan) {
  this->expect([](const auto& u) { return atan(u); }, atan_coefficient, -3.0, 3.0);
}

TYPED_TEST(ClosedForms,
           Atan2WithANumber) {  // in all quadrants; derivatives are those of atan(y / c), -atan(x / c)
  for (const double c : {2.0, -2.0}) {
    this->expect([&](const auto& u) { return atan2(u, c); },
                 [&](const D& y, int k) {
                   return k == 0 ? D(atan2(y, D(c))) : D(atan_coefficient(y / c, k) / pow(D(c), k));
                 },
                 -3.0, 3.0);
    this->expect([&](const auto& u) { return atan2(c, u); },
                 [&](const D& x, int k) {
                   return k == 0 ? D(atan2(D(c), x)) : D(-atan_coefficient(x / c, k) / pow(D(c), k));
                 },
                 -3.0, 3.0);
  }
}

TYPED_TEST(ClosedForms, AreaFunctions) {
  // asinh' = (1 + x^2 + 2xt + t^2)^(-1/2) = (1/r) sum P_k(-x/r) (t/r)^k, r = sqrt(x^2 + 1); acosh the same with
  // r = sqrt(x^2 - 1): Legendre's generating function
  const auto with = [](const D& x, const D& r, int k) {
    return D(legendre(k - 1, -x / r) / (k * pow(r, k)));
  };
  this->expect([](const auto& u) { return asinh(u); },
               [&](const D& x, int k) { return k == 0 ? D(asinh(x)) : with(x, hypot(x, D(1)), k); }, -3.0,
               3.0);
  this->expect([](const auto& u) { return acosh(u); },
               [&](const D& x, int k) { return k == 0 ? D(acosh(x)) : with(x, sqrt(x * x - 1), k); }, 1.5,
               5.0);
  this->expect([](const auto& u) { return atanh(u); },
               [](const D& x, int k) {  // half of log(1 + x) - log(1 - x)
                 return D((log_coefficient(1 + x, k) - sign(k) * log_coefficient(1 - x, k)) / 2);
               },
               -0.75, 0.75);
}

TYPED_TEST(ClosedForms, HypotWithANumber) {
  // sqrt(r^2 + 2xt + t^2) = r sum C_k (t/r)^k, Gegenbauer polynomials C_k of -x/r with index -1/2:
  // C_0 = 1, C_1 = x/r, C_k = (P_{k-2} - P_k) / (2k - 1)          DLMF 18.12.4, 18.7.9, 18.9.7
  this->expect([](const auto& u) { return hypot(u, 0.75); },
               [](const D& x, int k) -> D {
                 const D r = hypot(x, D(0.75)), z = -x / r;
                 if (k == 0) return r;
                 if (k == 1) return x / r;
                 return (legendre(k - 2, z) - legendre(k, z)) / (2 * k - 1) * pow(r, 1 - k);
               },
               -3.0, 3.0);
}

TYPED_TEST(ClosedForms, ErrorFunctions) {
  // erf^(k) = 2/sqrt(pi) (-1)^(k-1) H_{k-1}(x) exp(-x^2), Hermite polynomials          DLMF 7.10.1
  const auto erf_coefficient = [](const D& x, int k) -> D {
    if (k == 0) return erf(x);
    const D bell = 2 / sqrt(boost::math::constants::pi<D>()) * exp(-x * x);
    return -sign(k) * boost::math::hermite(k - 1, x) * bell * inverse_factorial(k);
  };
  const auto erfc_coefficient = [&](const D& x, int k) -> D {
    return k == 0 ? D(erfc(x)) : -erf_coefficient(x, k);
  };
  this->expect([](const auto& u) { return erf(u); }, erf_coefficient, -2.0, 2.0);
  this->expect([](const auto& u) { return erfc(u); }, erfc_coefficient, -2.0, 2.0);
}

TYPED_TEST(ClosedForms, PowerOfANumber) {  // 2.5^(x+t) = 2.5^x sum (t log 2.5)^k / k!
  this->expect(
      [](const auto& u) { return pow(2.5, u); },
      [](const D& x, int k) { return D(pow(D(2.5), x) * pow(log(D(2.5)), k) * inverse_factorial(k)); }, -3.0,
      3.0);
}

// ---- published coefficients ------------------------------------------------------------------------------

using Tracked = Jet<RunningError<double>, 20>;

TEST(Cbrt, HasPublishedCoefficients) {
  const auto c = cbrt(1.0 + Tracked::variable(0.0));
  EXPECT_THAT(c[2], IsCloseTo(D(-1) / 9, CarriedError{}));
  EXPECT_THAT(c[4], IsCloseTo(D(-10) / 243, CarriedError{}));
}

TEST(Tan, HasTangentNumbers) {
  const auto v = tan(Tracked::variable(0.0));
  EXPECT_THAT(v[7], IsCloseTo(D(17) / 315, CarriedError{}));
  EXPECT_THAT(v[13], IsCloseTo(D(21844) / 6081075, CarriedError{}));
  EXPECT_THAT(v, HasCoefficients([](int k) {  // tangent_t2n(n) = T_(2n-1)
                return k % 2 ? boost::math::tangent_t2n<D>((k + 1) / 2) * inverse_factorial(k) : D(0);
              }));
  EXPECT_THAT(tanh(Tracked::variable(0.0)), HasCoefficients([](int k) {
                return k % 2 ? sign(k / 2) * boost::math::tangent_t2n<D>((k + 1) / 2) * inverse_factorial(k)
                             : D(0);
              }));
}

}  // namespace
}  // namespace jetlag::testing::closed_forms_test
