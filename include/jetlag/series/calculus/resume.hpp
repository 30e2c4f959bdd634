// SPDX-License-Identifier: MIT
#pragma once
// One more order for a function that is already known: O(K) operations instead of the O(K^2) of all orders.
//
//   auto x = Jet<double, Dynamic>::from({1, 2, 3}), v = exp(x);
//   x.append(4);
//   resume<Exp>(v, x);                 // v.degree() == 3, with the bits of exp(x)
//
// For whole expressions see growing_series.hpp.

#include <tuple>

#include "jetlag/series/lift.hpp"

namespace jetlag {

template <class S>
concept DynamicJet = is_jet<S> && S::degree_at_compile_time == Dynamic;

/// v = R(u...) where v is that already as far as it goes, and u... have been extended since.
template <Rule R, DynamicJet J, class... U>
void resume(J& v, const U&... u) {
  const int degree = detail::common_degree<R, J>(u...), known = v.degree();
  bool anew = v.is_constant();
  if constexpr (detail::Homogeneity<R>::holds) anew = anew || detail::common_power<R, J>(u...) > 0;
  if (anew) {  // a constant, or a power of t that may have become common only now
    v = lift<R, J>(u...);
  } else if (degree != detail::unlimited && degree > known) {
    v.resize(degree);
    detail::apply<R>(v, known + 1, degree, u...);
    detail::check<R>(v, known + 1, degree, u...);
  }
}

/// v = A(u, w), w = B(u, v) where they are that already as far as they go, and u has been extended since.
template <Rule A, Rule B, DynamicJet J>
void resume_coupled(J& v, J& w, const J& u) {
  if (v.is_constant()) {
    std::tie(v, w) = lift_coupled<A, B, J>(u);
    return;
  }
  const int known = v.degree(), degree = u.degree();
  if (u.is_constant() || degree <= known) return;
  v.resize(degree);
  w.resize(degree);
  detail::apply_coupled<A, B>(v, w, known + 1, degree, u);
  detail::check<A>(v, known + 1, degree, u);
  detail::check<B>(w, known + 1, degree, u);
}

}  // namespace jetlag
