// SPDX-License-Identifier: MIT
#include "accuracy/functions.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "accuracy/terms.hpp"
#include "jetlag/series/comparisons.hpp"

namespace jetlag::accuracy {

namespace {

// ---- domains -------------------------------------------------------------------------------------------------

constexpr double pi = std::numbers::pi, ulp = std::numeric_limits<double>::epsilon();

double size(double x) { return x == 0 ? 1 : std::abs(x); }
double one(double) { return 1; }

/// Uniform in [low, high].
Domain from(double low, double high, std::string text, std::vector<double> corners,
            std::function<double(double)> scale) {
  return {std::move(text), std::move(corners), [=](double x) { return low + (high - low) * x; },
          std::move(scale)};
}

/// From low at x = 0 to high at x = 1, the logarithm linear.
double between(double low, double high, double x) {
  return std::exp((1 - x) * std::log(low) + x * std::log(high));
}

/// The logarithm uniform, from low to high.
Domain positive(double low, double high, std::string text, std::vector<double> corners,
                std::function<double(double)> scale = size) {
  return {std::move(text), std::move(corners), [=](double x) { return between(low, high, x); },
          std::move(scale)};
}

/// The same with both signs.
Domain both_signs(double low, double high, std::string text, std::vector<double> corners,
                  std::function<double(double)> scale = size) {
  const auto draw = [=](double x) {
    return x < 0.5 ? -between(low, high, 2 * x) : between(low, high, 2 * x - 1);
  };
  return {std::move(text), std::move(corners), draw, std::move(scale)};
}

/// A number instead of a series.
Domain constant(Domain domain) {
  domain.scale = [](double) { return 0.0; };
  return domain;
}

const Domain reals = both_signs(1e-100, 1e100, "±[1e-100, 1e100]", {0, 1, -1, 1.0 + ulp, 3e-5});
const Domain not_zero = both_signs(1e-100, 1e100, "±[1e-100, 1e100]", {1, -1, 1.0 + ulp, 3e-5});
const Domain other = both_signs(1e-100, 1e100, "±[1e-100, 1e100]", {2, -3, 1e-8});  // no tie with the above
const Domain above_zero =
    positive(1e-200, 1e200, "[1e-200, 1e200]", {1, 1 + ulp, 1 - ulp / 2, 0.5, 2, 10, 1e-200, 1e200});
const Domain angles = both_signs(1e-20, 1e22, "±[1e-20, 1e22]", {0, pi / 2, pi, 1e-8, 355, 1e22}, one);
const Domain exponents = from(-700, 700, "[-700, 700]", {0, 1e-20, -1e-8, 1, -1, 700, -700}, one);
const Domain inside_one =
    from(-1, 1, "(-1, 1)", {0, 1e-20, -1e-8, 0.5, -0.5, 0.999, 1 - ulp / 2, -1 + ulp / 2},
         [](double x) { return 1 - std::abs(x); });
const Domain wide = both_signs(1e-20, 1e20, "±[1e-20, 1e20]", {0, 1e-8, 0.5, 1, -1, 10},
                               [](double x) { return std::hypot(1, x); });
const Domain level = both_signs(1e-10, 1e10, "±[1e-10, 1e10]", {0, 1, -1, 3, -4, 1e-8, 1e8});
const Domain upright =
    both_signs(1e-10, 1e10, "±[1e-10, 1e10]", {1, -1, 3, -4, 1e-8, 1e8});  // no jump at -pi
const Domain plane = both_signs(1e-100, 1e100, "±[1e-100, 1e100]", {0, 1, -1, 3, -4, 1e-8, 1e8});
const Domain plane_without_origin =  // as the second of two, so that they do not vanish together
    both_signs(1e-100, 1e100, "±[1e-100, 1e100]", {1, -1, 3, -4, 1e-8, 1e8});

// ---- functions -----------------------------------------------------------------------------------------------

constexpr bool single = false, composed = true;

/// A function of one series.
template <class F>
Function unary(std::string name, bool kind, std::vector<std::string> rules, const Domain& domain, F f) {
  return {std::move(name),
          kind,
          std::move(rules),
          {domain},
          [f](const Operands& u) { return Computed(f(u[0])); },
          [f](const Operands& u) { return True(f(exact(u[0]))); },
          [f](const std::vector<Wide>& u) { return Wide(f(u[0])); },
          [f](const Operands& u) { return terms_of_function(f, u[0]); }};
}

/// A function of two series (or a number and a series) with its own S.
template <class F, class S>
Function binary(std::string name, bool kind, std::vector<std::string> rules, const Domain& first,
                const Domain& second, F f, S terms) {
  return {std::move(name),
          kind,
          std::move(rules),
          {first, second},
          [f](const Operands& u) { return Computed(f(u[0], u[1])); },
          [f](const Operands& u) { return True(f(exact(u[0]), exact(u[1]))); },
          [f](const std::vector<Wide>& u) { return Wide(f(u[0], u[1])); },
          [terms](const Operands& u) { return Terms(terms(u[0], u[1])); }};
}

const auto nothing = [](const auto&...) { return no_terms(); };

/// A fused sum: the rule on u, v, u, v, ...; S is the same sum of absolute values.
template <class R, class S>
Function sum(std::string name, std::vector<std::string> rules, S written_out) {
  return binary(
      std::move(name), false, std::move(rules), reals, reals,
      [](const auto& u, const auto& v) {
        using J = std::decay_t<decltype(u)>;
        return [&]<std::size_t... I>(std::index_sequence<I...>) {
          return lift<R, J>((I % 2 == 0 ? u : v)...);
        }(std::make_index_sequence<arity<R>>{});
      },
      [written_out](const Computed& u, const Computed& v) {
        const True all = written_out(sizes(exact(u)), sizes(exact(v)));
        return Terms{all, all};
      });
}

/// The same of one operand that is scaled: u + c u + ...
template <class R>
Function scaled(std::string name, std::vector<std::string> rules) {
  constexpr int n = arity<R> / 2;
  return binary(
      std::move(name), false, std::move(rules), constant(reals), reals,
      [](const auto& c, const auto& u) {
        using J = std::decay_t<decltype(u)>;
        return [&]<std::size_t... I>(std::index_sequence<I...>) {
          const auto operand = [&](auto i) -> const auto& {
            if constexpr (i % 2 == 0)
              return u;
            else
              return c[0];
          };
          return lift<R, J>(operand(std::integral_constant<std::size_t, I>{})...);
        }(std::make_index_sequence<arity<R>>{});
      },
      [](const Computed& c, const Computed& u) {
        True all = sizes(exact(u));
        for (int i = 0; i < n; ++i) all = all + sizes(exact(c)) * sizes(exact(u));
        return Terms{all, all};
      });
}

std::vector<Function> list() {
  return {
      // arithmetic
      unary("u_0 (a number as a series)", single, {"embed"}, constant(reals),
            [](const auto& u) { return lift<Embed, std::decay_t<decltype(u)>>(u[0]); }),
      binary(
          "u + v", single, {"add"}, reals, reals, [](const auto& u, const auto& v) { return u + v; },
          nothing),
      binary(
          "u - v", single, {"subtract"}, reals, reals, [](const auto& u, const auto& v) { return u - v; },
          nothing),
      unary("-u", single, {"negate"}, reals, [](const auto& u) { return -u; }),
      binary(
          "c + u", single, {"offset"}, constant(reals), reals,
          [](const auto& c, const auto& u) { return c[0] + u; }, nothing),
      binary(
          "c u", single, {"scale"}, constant(reals), reals,
          [](const auto& c, const auto& u) { return c[0] * u; }, nothing),
      binary(
          "u v", single, {"multiply"}, reals, reals, [](const auto& u, const auto& v) { return u * v; },
          terms_of_product),
      unary("square(u)", single, {"square"}, reals, [](const auto& u) { return square(u); }),
      sum<Sum<3>>("u + v + u", {"sum of 3"}, [](const auto& u, const auto& v) { return u + v + u; }),
      sum<Sum<4>>("u + v + u + v", {"sum of 4"}, [](const auto& u, const auto& v) { return u + v + u + v; }),
      sum<SquaredNorm<2>>("u u + v v", {"squared norm of 2"},
                          [](const auto& u, const auto& v) { return u * u + v * v; }),
      sum<SquaredNorm<3>>("u u + v v + u u", {"squared norm of 3"},
                          [](const auto& u, const auto& v) { return u * u + v * v + u * u; }),
      sum<Dot<2>>("u v + u v", {"dot of 2"}, [](const auto& u, const auto& v) { return u * v + u * v; }),
      sum<Dot<3>>("u v + u v + u v", {"dot of 3"},
                  [](const auto& u, const auto& v) { return u * v + u * v + u * v; }),
      binary(
          "u u - v v", false, {"difference of products"}, reals, reals,
          [](const auto& u, const auto& v) {
            return lift<DifferenceOfProducts, std::decay_t<decltype(u)>>(u, u, v, v);
          },
          [](const Computed& u, const Computed& v) {
            const True a = sizes(exact(u)), b = sizes(exact(v)), all = a * a + b * b;
            return Terms{all, all};
          }),
      scaled<LinearCombination<1>>("u + c u", {"linear combination of 1"}),
      scaled<LinearCombination<2>>("u + c u + c u", {"linear combination of 2"}),
      scaled<LinearCombination<3>>("u + c u + .. (3)", {"linear combination of 3"}),
      scaled<LinearCombination<5>>("u + c u + .. (5)", {"linear combination of 5"}),
      binary(
          "u / v", single, {"divide"}, reals, not_zero, [](const auto& u, const auto& v) { return u / v; },
          terms_of_quotient),
      binary(
          "u / c", single, {"divide by constant"}, reals, constant(not_zero),
          [](const auto& u, const auto& c) { return u / c[0]; }, nothing),
      binary(
          "c / v", single, {"reciprocal"}, constant(reals), not_zero,
          [](const auto& c, const auto& v) { return c[0] / v; }, terms_of_quotient),
      // roots and powers
      unary("sqrt(u)", single, {"sqrt"}, above_zero, [](const auto& u) { return sqrt(u); }),
      unary("cbrt(u)", single, {"cbrt"},
            both_signs(1e-150, 1e200, "±[1e-150, 1e200]", {1, -8, 1e-150, -1e200}),
            [](const auto& u) { return cbrt(u); }),
      binary(
          "pow(u, a)", single, {"power"}, positive(1e-50, 1e50, "[1e-50, 1e50]", {1, 1 + ulp, 0.5, 3}),
          constant(from(-5, 5, "[-5, 5]", {0.5, -0.5, -1.5, 1.0 / 3, 3.2, -4.999}, one)),
          [](const auto& u, const auto& a) { return pow(u, static_cast<double>(a[0])); },
          [](const auto& u, const auto& a) {
            return terms_of_function([&](const auto& x) { return pow(x, a[0]); }, u);
          }),
      binary(
          "pow(u, n)", composed, {"multiply", "square", "reciprocal"},
          both_signs(1e-15, 1e15, "±[1e-15, 1e15]", {0, 1, -1, 1 + ulp, -2, 3}),
          constant(
              {"-16, ..., 16", {-3, -1, 2, 3, 7, 16}, [](double x) { return std::floor(33 * x) - 16; }, one}),
          [](const auto& u, const auto& n) { return pow(u, static_cast<int>(n[0])); },
          [](const auto& u, const auto& n) {
            return terms_of_function([&](const auto& x) { return pow(x, static_cast<int>(n[0])); }, u);
          }),
      binary(
          "pow(u, v)", composed, {"power of series"},
          positive(1e-5, 1e5, "[1e-5, 1e5]", {1, 1 + ulp, 0.5, 3}),
          from(-20, 20, "[-20, 20]", {0, 1, -1.5, 1e-10, 20}, one),
          [](const auto& u, const auto& v) { return pow(u, v); }, terms_of_power),
      binary(
          "pow(c, v)", composed, {"power of series"},
          constant(positive(1e-5, 1e5, "[1e-5, 1e5]", {1, 1 + ulp, 0.5, 3})),
          from(-20, 20, "[-20, 20]", {0, 1, -1.5, 1e-10, 20}, one),
          [](const auto& c, const auto& v) { return pow(c[0], v); }, terms_of_power),
      // exponentials and logarithms
      unary("exp(u)", single, {"exp"}, exponents, [](const auto& u) { return exp(u); }),
      unary("expm1(u)", single, {"expm1"}, exponents, [](const auto& u) { return expm1(u); }),
      unary("log(u)", single, {"log"}, above_zero, [](const auto& u) { return log(u); }),
      unary("log1p(u)", single, {"log1p"},
            {"(-1, 1e300]",
             {0, 1e-20, -1e-8, -0.5, -1 + ulp / 2, 1, 1e300},
             [](double x) { return x < 0.5 ? 2 * x - 1 : between(1e-20, 1e300, 2 * x - 1); },
             [](double x) { return 1 + x; }},
            [](const auto& u) { return log1p(u); }),
      unary("log2(u)", single, {"log2"}, above_zero, [](const auto& u) { return log2(u); }),
      unary("log10(u)", single, {"log10"}, above_zero, [](const auto& u) { return log10(u); }),
      // trigonometric functions and their inverses
      unary("sin(u)", single, {"sin"}, angles, [](const auto& u) { return sin(u); }),
      unary("cos(u)", single, {"cos"}, angles, [](const auto& u) { return cos(u); }),
      unary("tan(u)", composed, {"tan", "secant squared"},
            both_signs(1e-20, 1e22, "±[1e-20, 1e22]", {0, pi / 2, pi, 1e-8, 355, 1e22},
                       [](double x) { return std::abs(std::cos(x)); }),
            [](const auto& u) { return tan(u); }),
      unary("asin(u)", composed, {"asin", "one minus square", "sqrt"}, inside_one,
            [](const auto& u) { return asin(u); }),
      unary("acos(u)", composed, {"acos", "one minus square", "sqrt"}, inside_one,
            [](const auto& u) { return acos(u); }),
      unary("atan(u)", composed, {"atan", "square", "offset"}, wide, [](const auto& u) { return atan(u); }),
      // hyperbolic functions and their inverses
      unary("sinh(u)", single, {"sinh"}, exponents, [](const auto& u) { return sinh(u); }),
      unary("cosh(u)", single, {"cosh"}, exponents, [](const auto& u) { return cosh(u); }),
      unary("tanh(u)", composed, {"tanh", "hyperbolic secant squared"},
            from(-300, 300, "[-300, 300]", {0, 1e-20, -1e-8, 0.5, 1, 5, -20, 40, 300}, one),
            [](const auto& u) { return tanh(u); }),
      unary("asinh(u)", composed, {"asinh", "length", "scaled square", "root of scaled"}, wide,
            [](const auto& u) { return asinh(u); }),
      unary("acosh(u)", composed, {"acosh", "sqrt", "multiply"},
            {"(1, 1e100]",
             {1 + ulp, 1 + 1e-8, 1.5, 3, 1e100},
             [](double x) { return 1 + between(1e-15, 1e100, x); },
             [](double x) { return x - 1; }},
            [](const auto& u) { return acosh(u); }),
      unary("atanh(u)", composed, {"atanh", "one minus square"}, inside_one,
            [](const auto& u) { return atanh(u); }),
      // error functions
      unary("erf(u)", composed, {"erf", "gaussian", "square"},
            from(-20, 20, "[-20, 20]", {0, 1e-20, -1e-8, 0.5, 1, -3, 20},
                 [](double x) { return 1 / (1 + std::abs(x)); }),
            [](const auto& u) { return erf(u); }),
      unary("erfc(u)", composed, {"erfc", "gaussian", "square"},
            from(-20, 20, "[-20, 20]", {0, 1e-20, -1e-8, 0.5, 1, -3, 20},
                 [](double x) { return 1 / (1 + std::abs(x)); }),
            [](const auto& u) { return erfc(u); }),
      // polar coordinates
      binary(
          "hypot(x, y)", composed, {"length", "scaled sum of squares", "root of scaled"}, plane,
          plane_without_origin, [](const auto& x, const auto& y) { return hypot(x, y); }, terms_of_hypot),
      binary(
          "hypot(c, x)", composed, {"length", "scaled square", "root of scaled"}, constant(plane),
          plane_without_origin, [](const auto& c, const auto& x) { return hypot(c[0], x); }, terms_of_hypot),
      binary(
          "atan2(y, x)", composed, {"atan2", "length", "scaled sum of squares"}, upright, level,
          [](const auto& y, const auto& x) { return atan2(y, x); }, terms_of_atan2),
      binary(
          "atan2(c, x)", composed, {"atan2 of constant", "length", "scaled square"}, constant(upright), level,
          [](const auto& c, const auto& x) { return atan2(c[0], x); }, terms_of_atan2),
      binary(
          "atan2(y, c)", composed, {"atan2 over constant", "length", "scaled square"}, upright,
          constant(level), [](const auto& y, const auto& c) { return atan2(y, c[0]); }, terms_of_atan2),
      // stretches; beyond u = 3 and u = 1, all stretches 1, these are no invariants of a matrix
      unary("stretch_invariants(u, u, 1).first", composed,
            {"first stretch invariant", "second stretch invariant"},
            positive(3.5, 1e3, "[3.5, 1e3]", {3.5, 4, 1e3}),
            [](const auto& u) { return stretch_invariants(u, u, std::decay_t<decltype(u)>(1.0)).first; }),
      unary("stretch_invariants(3, 3, u).second", composed,
            {"first stretch invariant", "second stretch invariant"},
            from(-0.5, 0.9, "[-0.5, 0.9]", {0, 0.9, 0.5, -0.5, 1e-20}, one),
            [](const auto& u) {
              using S = std::decay_t<decltype(u)>;
              return stretch_invariants(S(3.0), S(3.0), u).second;
            }),
      // choices
      unary("abs(u)", single, {"sign", "abs"}, not_zero, [](const auto& u) { return abs(u); }),
      binary(
          "min(u, v)", single, {"by sign"}, plane, reals,
          [](const auto& u, const auto& v) { return min(u, v); }, nothing),
      binary(
          "max(u, v)", single, {"by sign"}, plane, reals,
          [](const auto& u, const auto& v) { return max(u, v); }, nothing),
      binary(
          "select(u < v, u, v)", single, {"less", "select"}, reals, other,
          [](const auto& u, const auto& v) {
            using S = std::decay_t<decltype(u)>;
            return lift<Select, S>(lift<Less, S>(u, v), u, v);
          },
          nothing),
      binary(
          "select(u <= 0 or not v <= 0, u, v)", single, {"less or equal", "and", "or", "not", "select"},
          not_zero, other,
          [](const auto& u, const auto& v) {
            using S = std::decay_t<decltype(u)>;
            const S below = lift<LessOrEqual, S>(u, S(0.0)),
                    above = lift<Not, S>(lift<LessOrEqual, S>(v, S(0.0)));
            return lift<Select, S>(lift<Or, S>(below, lift<And, S>(above, above)), u, v);
          },
          nothing),
  };
}

}  // namespace

const std::vector<Function>& functions() {
  static const std::vector<Function> all = list();
  return all;
}

}  // namespace jetlag::accuracy
