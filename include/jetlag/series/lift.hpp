// SPDX-License-Identifier: MIT
#pragma once
// From a rule to a function of jets: coefficients 0, 1, 2, ... one after the other.

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "jetlag/series/coefficients.hpp"
#include "jetlag/series/rule.hpp"
#include "jetlag/series/singular_point.hpp"
#include "jetlag/series/valuation.hpp"

namespace jetlag {

/// A number x read as a series without terms beyond the first: the `constant` operand of a rule.
template <class T>
struct ConstantSeries {
  T value;
  const T& operator[](int) const { return value; }
};

namespace detail {

template <class J, class X>
decltype(auto) as_operand(const X& x) {
  if constexpr (std::is_same_v<X, J>)
    return (x);
  else
    return ConstantSeries<typename J::value_type>{typename J::value_type(x)};
}

/// f(u, reads) for each operand of R that is a series.
template <Rule R, class J, class F, class... U>
void for_each_series(F f, const U&... u) {
  [[maybe_unused]] std::size_t a = 0;
  const auto visit = [&]<class X>(const X& x) {
    [[maybe_unused]] const Reads reads = R::reads[a++];
    if constexpr (std::is_same_v<X, J>)
      if (reads == Reads::history || reads == Reads::newest) f(x);
  };
  (visit(u), ...);
}

/// A constant is known to any degree.
inline constexpr int unlimited = std::numeric_limits<int>::max();

template <class J>
int degree_of(const J& u) {
  return u.is_constant() ? unlimited : u.degree();
}

/// The power of t that can be taken out of u: any, if u is the constant 0.
template <class J>
int order_of_zero(const J& u) {
  int l = valuation(u);
  if (l > 0 && l == u.degree() && u[l] == beyond_what_is_known<typename J::value_type>()) ++l;
  return u.is_constant() && l > 0 ? unlimited : l;
}

/// The degree to which R(u...) can be computed: the smallest of the operands.
template <Rule R, class J, class... U>
int common_degree(const U&... u) {
  if constexpr (J::degree_at_compile_time != Dynamic) return J::degree;
  int degree = unlimited;
  for_each_series<R, J>([&](const J& x) { degree = std::min(degree, degree_of(x)); }, u...);
  return degree;
}

/// The zero series of a degree.
template <class J>
J zeros(int degree) {
  J v;
  if constexpr (J::degree_at_compile_time == Dynamic)
    if (degree != unlimited) v.resize(degree);
  return v;
}

/// Coefficients k, k + 1, ... do not exist.
template <class J>
void miss(J& v, int k) {
  for (; k <= v.degree(); ++k) v[k] = not_a_number<typename J::value_type>();
}

/// Coefficients first .. last of v = R(u...). Without a value there are no derivatives either: the rule for log(u)
/// would give u_1 / u_0 also below 0.
template <Rule R, class J, class... U>
void apply(J& v, int first, int last, const U&... u) {
  for (int k = first; k <= last; ++k) v[k] = R::coefficient(k, as_operand<J>(u)..., v);
  if (!has_value(v[0])) miss(v, std::max(first, 1));
}

/// Coefficients first .. last of v = A(u..., w), w = B(u..., v).
template <Rule A, Rule B, class J, class... U>
void apply_coupled(J& v, J& w, int first, int last, const U&... u) {
  for (int k = first; k <= last; ++k) {
    v[k] = A::coefficient(k, as_operand<J>(u)..., w, v);
    w[k] = B::coefficient(k, as_operand<J>(u)..., v, w);
  }
}

/// Coefficients k, k + 1, ... cannot be known: v loses them, or if its degree is fixed they are NaN.
template <class J>
void lose(J& v, int k) {
  if (k > v.degree()) return;
  if constexpr (J::degree_at_compile_time == Dynamic)
    v.resize(k - 1);
  else
    miss(v, k);
}

/// The power of t that all series among the operands of R have in common.
template <Rule R, class J, class... U>
int common_power(const U&... u) {
  int l = unlimited;
  for_each_series<R, J>([&](const J& x) { l = std::min(l, order_of_zero(x)); }, u...);
  return l;
}

/// u / t^l for a series, which is then known to l coefficients less; a number stays as it is.
template <class J, class X>
X divided(const X& u, int l) {
  if constexpr (std::is_same_v<X, J>) {
    if (u.is_constant()) return u;
    X g = zeros<X>(u.degree() - l);
    for (int k = 0; k + l <= u.degree(); ++k) g[k] = u[k + l];
    return g;
  } else {
    return u;
  }
}

/// v = t^order g, of which coefficients 0 .. known of g are known. v: zeros.
template <class J>
void put(J& v, int order, const J& g, int known) {
  for (int k = 0; k <= known && order + k <= v.degree(); ++k) v[order + k] = g[k];
  lose(v, order + known + 1);
}

/// v = R(u...) where t^l, l > 0, is common to u... (see valuation.hpp); as compute() below.
template <Rule R, class J, class... U>
int apply_to_common_power(J& v, int l, const U&... u) {
  const int degree = v.degree();
  const bool all_zero = l > degree;  // as far as is known
  const auto t = Homogeneity<R>::power(all_zero ? degree + 1 : l, u...);
  if (!t) {
    apply<R>(v, 0, degree, u...);
    return degree;
  }
  if (all_zero) {
    if (t->order == 0)
      miss(v, 0);
    else if (!v.is_constant())
      lose(v, t->order);
    return t->order == 0 ? degree : t->order - 1;
  }
  const int order = t->order;
  if (!t->whole) {
    miss(v, order);
    return degree;
  }
  J reduced = zeros<J>(degree - l);
  apply<R>(reduced, 0, degree - l, divided<J>(u, l)...);
  if (!is_finite(reduced[0])) {  // sqrt(-t^2) has a value at 0 and nowhere else
    miss(v, std::min(order, 1));
    return degree;
  }
  put(v, order, reduced, degree - l);
  return order + degree - l;
}

/// v = R(u...). v: zeros of the common degree. Returns the degree up to which a coefficient that is not finite does
/// not exist, rather than cannot be known.
template <Rule R, class J, class... U>
int compute(J& v, const U&... u) {
  if constexpr (Homogeneity<R>::holds)
    if (const int l = common_power<R, J>(u...); l > 0) return apply_to_common_power<R>(v, l, u...);
  apply<R>(v, 0, v.degree(), u...);
  return v.degree();
}

/// f(u, v) for a function f(s u, s v) = |s|^a f(u, v), a = 1 for a length and 0 for an angle, where s^2 alone would not
/// do: a power of t is taken out. With an odd one a length is that for t >= 0, and an angle jumps at t = 0. Series that
/// are no jets are not looked at.
template <int a, class S, class F>
S without_common_power(F f, const S& u, const S& v) {
  if constexpr (is_jet<S>) {
    const int l = std::min(order_of_zero(u), order_of_zero(v)), degree = std::min(degree_of(u), degree_of(v));
    if (l > 0 && (a == 1 || l % 2 == 0 || l > degree)) {
      S w = zeros<S>(degree);
      if (l <= w.degree())
        put(w, a * l, f(divided<S>(u, l), divided<S>(v, l)), w.degree() - l);
      else if (a == 0)
        miss(w, 0);
      return w;
    }
  }
  return f(u, v);
}

/// "u_0 = 0, c = 1.5"
template <class J, class... U>
std::string describe(const U&... u) {
  std::string all;
  char name = 'u';
  const auto add = [&]<class X>(const X& x) {
    if (!all.empty()) all += ", ";
    if constexpr (std::is_same_v<X, J>)
      all += std::string(1, name++) + "_0 = " + text(x[0]);
    else
      all += "c = " + text(typename J::value_type(x));
  };
  (add(u), ...);
  return all;
}

/// The policy of checked jets, for coefficients first .. last of v = R(u...).
template <Rule R, class J, class... U>
void check(const J& v, int first, int last, const U&... u) {
  if constexpr (J::singularities == Singularities::checked) {
    const auto known = [](const auto& x, int k) {
      for (int j = 0; j <= k; ++j)
        if (!is_finite(x[j])) return false;
      return true;
    };
    for (int k = first; k <= std::min(last, v.degree()); ++k)
      if (!is_finite(v[k])) {
        if ((known(as_operand<J>(u), k) && ...)) throw SingularPoint(R::name, k, describe<J>(u...));
        return;
      }
  }
}

}  // namespace detail

/// v = R(u...): the rule applied for k = 0, 1, ... to the smallest degree among u.... Operands that are not jets of
/// type J are constants. Where the operands have a power of t in common it is cancelled if the rule allows.
/// Throws SingularPoint if J is checked and a coefficient does not exist.
template <Rule R, class J, class... U>
  requires is_jet<J>
J lift(const U&... u) {
  J v = detail::zeros<J>(detail::common_degree<R, J>(u...));
  const int determined = detail::compute<R>(v, u...);
  detail::check<R>(v, 0, determined, u...);
  return v;
}

/// v = A(u..., w), w = B(u..., v): two rules that read each other's older coefficients.
template <Rule A, Rule B, class J, class... U>
  requires is_jet<J>
std::pair<J, J> lift_coupled(const U&... u) {
  const int degree = detail::common_degree<A, J>(u...);
  std::pair<J, J> both(detail::zeros<J>(degree), detail::zeros<J>(degree));
  auto& [v, w] = both;
  detail::apply_coupled<A, B>(v, w, 0, v.degree(), u...);
  detail::check<A>(v, 0, v.degree(), u...);
  detail::check<B>(w, 0, w.degree(), u...);
  return both;
}

}  // namespace jetlag
