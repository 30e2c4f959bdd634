// SPDX-License-Identifier: MIT
#pragma once
// The coefficients of a jet: N + 1 of them in place, or as many as there are at run time.

#include <array>
#include <cassert>
#include <type_traits>
#include <vector>

namespace jetlag {

/// For the degree of a jet: not known before run time. The same value as Eigen::Dynamic.
inline constexpr int Dynamic = -1;

/// What a jet does where a function has no Taylor series; see singular_point.hpp.
enum class Singularities { quiet, checked };

template <class T, int N, Singularities P = Singularities::quiet>
class Jet;

template <class S>
inline constexpr bool is_jet = false;
template <class T, int N, Singularities P>
inline constexpr bool is_jet<Jet<T, N, P>> = true;

namespace detail {

template <class T, int N>
class Coefficients {
  static_assert(N >= 0, "the degree of a jet is 0, 1, 2, ... or Dynamic");

 public:
  static constexpr std::integral_constant<int, N>
      degree{};                                          // a number, J::degree, and a function, u.degree()
  static constexpr bool is_constant() { return false; }  // it has N + 1 coefficients, whatever they are

  T& operator[](int k) {
    assert(0 <= k && k <= N);
    return c_[k];
  }
  const T& operator[](int k) const {
    assert(0 <= k && k <= N);
    return c_[k];
  }
  const std::array<T, N + 1>& coefficients() const { return c_; }

 protected:
  Coefficients() : c_{} { c_.fill(T(0)); }
  std::array<T, N + 1> c_;
};

template <class T>
class Coefficients<T, Dynamic> {
 public:
  /// The order of the last known coefficient; 0 for a constant.
  int degree() const { return static_cast<int>(c_.size()) - 1; }

  /// Made from a plain number: all further coefficients are known to be 0, and can be read.
  bool is_constant() const { return is_constant_; }

  T& operator[](int k) {
    assert(0 <= k && k <= degree());
    return c_[k];
  }
  const T& operator[](int k) const {
    if (k < static_cast<int>(c_.size())) return c_[k];
    assert(is_constant_);
    static const T zero(0);
    return zero;
  }
  const std::vector<T>& coefficients() const { return c_; }

  /// One more coefficient becomes known. Not for a constant, of which all are.
  void append(const T& c) {
    assert(!is_constant_);
    c_.push_back(c);
  }

  /// A series of degree K >= 0: coefficients above it are dropped, missing ones are 0.
  void resize(int K) {
    assert(K >= 0);
    c_.resize(K + 1, T(0));
    is_constant_ = false;
  }

 protected:
  Coefficients() : c_(1, T(0)) {}
  std::vector<T> c_;
  bool is_constant_ = true;
};

}  // namespace detail
}  // namespace jetlag
