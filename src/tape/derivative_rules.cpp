// SPDX-License-Identifier: MIT
// The derivatives of the rules of the register, in its order: of v = R(u...), what each operand gets.
//
// Operands that are functions of others get nothing: c of v = asin(u), c = sqrt(1 - u^2) is a function of u.

#include <cstddef>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "tape/adjoints.hpp"

namespace jetlag {

namespace {

/// A number, for values computed in the precision of the tape's numbers.
Recorded number(Adjoints& at, double x) { return {&at.recording(), at.recording().node_of(x)}; }

// ---- arithmetic -------------------------------------------------------------------------------------------

/// v = u + w + ...:   1 for each.
void of_sum(Adjoints& at, int n) {
  for (int i = 0; i < n; ++i) at.give(at.operand(i), 1.0);
}

/// v = u - w:   1, -1.
void of_difference(Adjoints& at) {
  at.give(at.operand(0), 1.0);
  at.give(at.operand(1), -1.0);
}

/// v = u w + ...:   the other factor of each.
void of_products(Adjoints& at, int n) {
  for (int i = 0; i < 2 * n; ++i) at.give(at.operand(i), at.value(at.operand(i ^ 1)));
}

/// v = u_0 u_1 - u_2 u_3:   the other factor of each, with the sign of the product.
void of_difference_of_products(Adjoints& at) {
  for (int i = 0; i < 4; ++i) {
    const Product other = at.value(at.operand(i ^ 1));
    at.give(at.operand(i), i < 2 ? other : -other);
  }
}

/// v = u_0 + c_1 u_1 + ...:   1,  and of each product the other factor.
void of_linear_combination(Adjoints& at, int n) {
  at.give(at.operand(0), 1.0);
  for (int i = 1; i <= n; ++i) {
    at.give(at.operand(2 * i), at.value(at.operand(2 * i - 1)));
    at.give(at.operand(2 * i - 1), at.value(at.operand(2 * i)));
  }
}

/// v = u^2 + ...:   2 u.
void of_squares(Adjoints& at, int n) {
  for (int i = 0; i < n; ++i) at.give(at.operand(i), 2.0 * at.value(at.operand(i)));
}

/// v = f / g:   1/g,  -v/g.
void of_quotient(Adjoints& at) {
  const Product over = at.one_over(at.operand(1));
  at.give(at.operand(0), over);
  at.give(at.operand(1), -(at.value(at.result()) * over));
}

// ---- powers -----------------------------------------------------------------------------------------------

/// v = u^1/2:   u^-1/2 / 2.
void of_sqrt(Adjoints& at) { at.give(at.operand(0), 0.5 * at.power(at.operand(0), -0.5)); }

/// v = u^1/3:   1 / (3 v^2).
void of_cbrt(Adjoints& at) {
  const Product v = at.value(at.result()), three{.constant = number(at, 3.0)};
  at.give(at.operand(0), reciprocal(at.recording(), three * squared(v)));
}

/// v = u^a:   a u^(a-1) where the exponents are known, else a v / u;  v log u for a.
void of_power(Adjoints& at) {
  const Recorded a = at.operand(0), u = at.operand(1);
  const Product v = at.value(at.result());
  const auto known = u.is_number() ? v.powers.end() : v.powers.find(u.node());
  at.give(u, at.value(a) * (known != v.powers.end() ? at.power(u, known->second - 1.0) : v * at.one_over(u)));
  if (at.depends_on_inputs(a)) at.give(a, at.value(at.result()) * at.value(log(u)));
}

/// v = u^g:   g v / u,  v log u.
void of_power_of_series(Adjoints& at) {
  const Recorded u = at.operand(0), g = at.operand(1);
  const Product v = at.value(at.result());
  if (at.depends_on_inputs(u)) at.give(u, at.value(g) * v * at.one_over(u));
  if (at.depends_on_inputs(g)) at.give(g, v * at.value(log(u)));
}

// ---- functions that are coupled with their derivative, or have it for an operand -------------------------

/// v = f(u, w):   c w.
void by_second(Adjoints& at, double c) { at.give(at.operand(0), c * at.value(at.operand(1))); }

/// v = f(u, t), 1 + t^2 or 1 - t^2:   +-2 t v.
void of_one_and_square(Adjoints& at, double c) {
  at.give(at.operand(0), c * (at.value(at.operand(1)) * at.value(at.result())));
}

/// v = f(u, w):   +-1 / w.
void over_second(Adjoints& at, double c) { at.give(at.operand(0), c * at.one_over(at.operand(1))); }

/// v = erf(u), g = exp(-u^2):   2/sqrt(pi) g;  pi = 4 atan(1).
void of_erf(Adjoints& at, double c) {
  const Product factor{.constant = Recorded(1.0) / sqrt(atan(number(at, 1.0)))};
  at.give(at.operand(0), c * (factor * at.value(at.operand(1))));
}

// ---- logarithms -------------------------------------------------------------------------------------------

/// v = log(u) / log(base):   1 / (u log(base)).
void of_logarithm(Adjoints& at, double base) {
  const Product scale{.constant = log(number(at, base))};
  at.give(at.operand(0), reciprocal(at.recording(), scale) * at.one_over(at.operand(0)));
}

// ---- polar coordinates ------------------------------------------------------------------------------------

/// l = hypot(x, y) of values without a series:   x / l,  y / l.
void of_length(Adjoints& at) {
  for (int i = 0; i < 2; ++i) at.give(at.operand(i), at.value(at.operand(i)) * at.one_over(at.result()));
}

/// s = hypot(x, y), w = (x^2 + y^2) / h_0:   x / s,  y / s.   The operands of w are h_0, x and, where it has a series, y.
void of_root_of_scaled(Adjoints& at) {
  const std::vector<int> parts = at.node(at.operand(0)).operands;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const Recorded x(&at.recording(), parts[i]);
    at.give(x, at.value(x) * at.one_over(at.result()));
  }
}

/// v = atan2(y, x):   x / (x^2 + y^2),  -y / (x^2 + y^2).   Range: the squares neither overflow nor vanish.
void of_atan2(Adjoints& at, int y_at, int x_at) {
  const Recorded y = at.operand(y_at), x = at.operand(x_at);
  const Product over = at.one_over(x * x + y * y);
  at.give(y, at.value(x) * over);
  at.give(x, -(at.value(y) * over));
}

// ---- stretches --------------------------------------------------------------------------------------------

/// a^2 = I + 2 b, b^2 = II + 2 J a:   b/(2 q), 1/(2 q), a/q,  q = a b - J.   The operands of a are I, II, J, b.
void of_first_stretch_invariant(Adjoints& at) {
  const Recorded a = at.result(), b = at.operand(3);
  const Product over = at.one_over(a * b - at.operand(2));
  at.give(at.operand(0), 0.5 * (at.value(b) * over));
  at.give(at.operand(1), 0.5 * over);
  at.give(at.operand(2), at.value(a) * over);
}

/// b = (a^2 - I) / 2:   a for a, -1/2 for I.   The operands of b are I, II, J, a.
void of_second_stretch_invariant(Adjoints& at) {
  at.give(at.operand(3), at.value(at.operand(3)));
  at.give(at.operand(0), -0.5);
}

// ---- choices ----------------------------------------------------------------------------------------------

/// v = one of two, by the operand before them:   1 where it is chosen.
void of_choice(Adjoints& at) {
  at.give_where(at.operand(1), false);
  at.give_where(at.operand(2), true);
}

/// Constant but for jumps:   0.
void of_steps(Adjoints&) {}

// ---- the table --------------------------------------------------------------------------------------------

struct Entry {
  int rule;
  Derivative derivative;
};
using At = Adjoints;

const Entry entries[] = {
    {rule_id<Embed>, [](At& at) { of_sum(at, 1); }},
    {rule_id<Add>, [](At& at) { of_sum(at, 2); }},
    {rule_id<Subtract>, of_difference},
    {rule_id<Negate>, [](At& at) { at.give(at.operand(0), -1.0); }},
    {rule_id<Offset>, [](At& at) { of_sum(at, 2); }},
    {rule_id<Scale>, [](At& at) { of_products(at, 1); }},
    {rule_id<Multiply>, [](At& at) { of_products(at, 1); }},
    {rule_id<Square>, [](At& at) { of_squares(at, 1); }},
    {rule_id<Divide>, of_quotient},
    {rule_id<DivideByConstant>, of_quotient},
    {rule_id<Reciprocal>, of_quotient},
    {rule_id<Sum<3>>, [](At& at) { of_sum(at, 3); }},
    {rule_id<Sum<4>>, [](At& at) { of_sum(at, 4); }},
    {rule_id<SquaredNorm<2>>, [](At& at) { of_squares(at, 2); }},
    {rule_id<SquaredNorm<3>>, [](At& at) { of_squares(at, 3); }},
    {rule_id<Dot<2>>, [](At& at) { of_products(at, 2); }},
    {rule_id<Dot<3>>, [](At& at) { of_products(at, 3); }},
    {rule_id<DifferenceOfProducts>, of_difference_of_products},
    {rule_id<LinearCombination<1>>, [](At& at) { of_linear_combination(at, 1); }},
    {rule_id<LinearCombination<2>>, [](At& at) { of_linear_combination(at, 2); }},
    {rule_id<LinearCombination<3>>, [](At& at) { of_linear_combination(at, 3); }},
    {rule_id<LinearCombination<5>>, [](At& at) { of_linear_combination(at, 5); }},
    {rule_id<Sqrt>, of_sqrt},
    {rule_id<Cbrt>, of_cbrt},
    {rule_id<Power>, of_power},
    {rule_id<PowerOfSeries>, of_power_of_series},
    {rule_id<Exp>, [](At& at) { at.give(at.operand(0), at.value(at.result())); }},
    {rule_id<Expm1>, [](At& at) { by_second(at, 1.0); }},
    {rule_id<Log>, [](At& at) { at.give(at.operand(0), at.one_over(at.operand(0))); }},
    {rule_id<Log1p>, [](At& at) { at.give(at.operand(0), at.one_over(1.0 + at.operand(0))); }},
    {rule_id<Log2>, [](At& at) { of_logarithm(at, 2.0); }},
    {rule_id<Log10>, [](At& at) { of_logarithm(at, 10.0); }},
    {rule_id<Sin>, [](At& at) { by_second(at, 1.0); }},
    {rule_id<Cos>, [](At& at) { by_second(at, -1.0); }},
    {rule_id<Tan>, [](At& at) { by_second(at, 1.0); }},
    {rule_id<SecantSquared>, [](At& at) { of_one_and_square(at, 2.0); }},
    {rule_id<Sinh>, [](At& at) { by_second(at, 1.0); }},
    {rule_id<Cosh>, [](At& at) { by_second(at, 1.0); }},
    {rule_id<Tanh>, [](At& at) { by_second(at, 1.0); }},
    {rule_id<HyperbolicSecantSquared>, [](At& at) { of_one_and_square(at, -2.0); }},
    {rule_id<OneMinusSquare>, [](At& at) { at.give(at.operand(0), -2.0 * at.value(at.operand(0))); }},
    {rule_id<Asin>, [](At& at) { over_second(at, 1.0); }},
    {rule_id<Acos>, [](At& at) { over_second(at, -1.0); }},
    {rule_id<Atan>, [](At& at) { over_second(at, 1.0); }},
    {rule_id<Asinh>, [](At& at) { over_second(at, 1.0); }},
    {rule_id<Acosh>, [](At& at) { over_second(at, 1.0); }},
    {rule_id<Atanh>, [](At& at) { over_second(at, 1.0); }},
    {rule_id<Length>, of_length},
    // ScaledSumOfSquares, ScaledSquare: parts of hypot and atan2, which are not differentiated by them.
    {rule_id<RootOfScaled>, of_root_of_scaled},
    {rule_id<Atan2>, [](At& at) { of_atan2(at, 0, 1); }},
    {rule_id<Atan2OfConstant>, [](At& at) { of_atan2(at, 0, 1); }},
    {rule_id<Atan2OverConstant>, [](At& at) { of_atan2(at, 1, 0); }},
    {rule_id<FirstStretchInvariant>, of_first_stretch_invariant},
    {rule_id<SecondStretchInvariant>, of_second_stretch_invariant},
    {rule_id<Gaussian>,  // -2 u v
     [](At& at) { at.give(at.operand(0), -2.0 * (at.value(at.operand(0)) * at.value(at.result()))); }},
    {rule_id<Erf>, [](At& at) { of_erf(at, 1.0); }},
    {rule_id<Erfc>, [](At& at) { of_erf(at, -1.0); }},
    {rule_id<Sign>, of_steps},
    {rule_id<Abs>, [](At& at) { at.give_with_sign(at.operand(1), at.operand(0)); }},
    {rule_id<BySign>, of_choice},
    {rule_id<Less>, of_steps},
    {rule_id<LessOrEqual>, of_steps},
    {rule_id<And>, of_steps},
    {rule_id<Or>, of_steps},
    {rule_id<Not>, of_steps},
    {rule_id<Select>, of_choice},
};

}  // namespace

Derivative derivative_of(int rule) {
  for (const Entry& entry : entries)
    if (entry.rule == rule) return entry.derivative;
  return nullptr;
}

}  // namespace jetlag
