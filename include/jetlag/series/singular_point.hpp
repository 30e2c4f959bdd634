// SPDX-License-Identifier: MIT
#pragma once
// What a jet does where a function has no Taylor series (1/t, sqrt(t), log(t) at t = 0). The caller chooses:
//
//   Jet<double, 4>            quiet: the coefficients before the first that does not exist are right, that one
//                             and those after it are not finite
//   CheckedJet<double, 4>     checked: SingularPoint is thrown, "log: coefficient 0 does not exist at u_0 = 0"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "jetlag/base/text.hpp"
#include "jetlag/series/coefficients.hpp"
#include "jetlag/series/complex.hpp"

namespace jetlag {

/// Thrown by a checked jet where a function of finite operands has no finite coefficient of some order.
class SingularPoint : public std::domain_error {
 public:
  /// at: the operands there, such as "u_0 = 0".
  SingularPoint(const char* function, int order, const std::string& at)
      : std::domain_error(std::string(function) + ": coefficient " + std::to_string(order) +
                          " does not exist at " + at),
        function_(function),
        order_(order) {}

  const char* function() const { return function_; }  // the name of the rule
  int order() const { return order_; }                // of the first coefficient that does not exist

 private:
  const char* function_;
  int order_;
};

namespace detail {

/// Whether x, or every coefficient of it, is finite. A number type without isfinite has finite numbers only.
template <class T>
bool is_finite(const T& x) {
  using std::isfinite;
  using Limits = std::numeric_limits<T>;
  if constexpr (is_complex<T>)
    return isfinite(x.real()) && isfinite(x.imag());
  else if constexpr (Limits::is_specialized && !Limits::has_infinity && !Limits::has_quiet_NaN)
    return true;
  else if constexpr (requires { isfinite(x); })
    return isfinite(x);
  else
    return true;
}

/// Whether x, or coefficient 0 of it, is finite.
template <class T>
bool has_value(const T& x) {
  if constexpr (is_jet<T>)
    return has_value(x[0]);
  else
    return is_finite(x);
}

/// What stands for a coefficient that the known ones do not determine.
/// Throws std::domain_error for a type without such a number (rationals).
template <class T>
T not_a_number() {
  if constexpr (is_jet<T>) {
    T x = T::from({not_a_number<typename T::value_type>()});
    for (int k = 1; k <= x.degree(); ++k) x[k] = x[0];
    return x;
  } else if constexpr (std::numeric_limits<T>::has_quiet_NaN) {
    return std::numeric_limits<T>::quiet_NaN();
  } else if constexpr (std::numeric_limits<T>::is_specialized) {
    throw std::domain_error("Jet: a coefficient is not determined, and numbers of this type are never NaN");
  } else {
    return T(std::numeric_limits<double>::quiet_NaN());
  }
}

/// x in a message; of a jet its coefficient 0.
template <class T>
std::string text(const T& x) {
  if constexpr (is_jet<T>)
    return text(x[0]);
  else
    return shown(x);
}

}  // namespace detail
}  // namespace jetlag
