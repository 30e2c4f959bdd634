// SPDX-License-Identifier: MIT
#pragma once
// Complex coefficients: what std::complex lacks for the rules.

#include <complex>

namespace jetlag {

template <class T>
inline constexpr bool is_complex = false;
template <class T>
inline constexpr bool is_complex<std::complex<T>> = true;

// The rules multiply and divide by whole numbers; std::complex takes no int.
template <class T>
std::complex<T> operator*(int n, const std::complex<T>& z) {
  return T(n) * z;
}
template <class T>
std::complex<T> operator/(const std::complex<T>& z, int n) {
  return z / T(n);
}

}  // namespace jetlag
