// SPDX-License-Identifier: MIT
#pragma once
// GrowingSeries<T>: a Taylor series whose coefficients are computed when they are asked for, and kept.
//
// An expression of growing series remembers its operations. Coefficient K+1 costs O(K) operations and has the bits
// that a Jet of any higher degree would have. The series of an initial value problem is grown along itself:
//
//   auto x = GrowingSeries<double>::given({1.0});       // x(0) = 1;  x' = x^2
//   const auto f = x * x;
//   for (int k = 0; k < 20; ++k) x.append(f[k] / (k + 1));
//
// All functions of elementary.hpp take it. A copy is the same series, not another one. No common powers of t are
// cancelled: where a function has a singular point, removable or not, the coefficients are not finite. Whole systems
// of particles have motion/expansion.hpp instead. Not for use by several threads at once.

#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "jetlag/series/elementary.hpp"
#include "jetlag/series/operators.hpp"

namespace jetlag {

template <class T>
class GrowingSeries;

template <class S>
inline constexpr bool is_growing_series = false;
template <class T>
inline constexpr bool is_growing_series<GrowingSeries<T>> = true;

template <class T>
inline constexpr bool is_series<GrowingSeries<T>> = true;

namespace detail {

/// An operation and what is known of its result.
template <class T>
struct Growing {
  virtual ~Growing() = default;
  virtual T next() = 0;  // coefficient c.size()
  const T& at(int k) {
    while (static_cast<int>(c.size()) <= k) c.push_back(next());
    return c[k];
  }
  std::vector<T> c;
};

/// A polynomial: c_0, c_1, 0, 0, ...
template <class T>
struct GrowingPolynomial : Growing<T> {
  T next() override { return T(0); }
};

/// Coefficients that come from outside.
template <class T>
struct Given : Growing<T> {
  T next() override {
    throw std::out_of_range("GrowingSeries: coefficient " + std::to_string(this->c.size()) +
                            " has not been given");
  }
};

/// An operand; what a rule reads of it is computed before, so that no coefficient moves while it is read.
template <class T>
struct GrowingOperand {
  std::shared_ptr<Growing<T>> series;
  const T& operator[](int k) const { return series->c[k]; }
};
template <class T>
void prepare(const GrowingOperand<T>& u, int k) {
  u.series->at(k);
}
template <class T>
void prepare(const ConstantSeries<T>&, int) {}

template <Rule R, class T, class... U>
struct RuleNode : Growing<T> {
  explicit RuleNode(const U&... u) : operands(u...) {}
  T next() override {
    const int k = static_cast<int>(this->c.size());
    return std::apply(
        [&](const auto&... u) {
          (prepare(u, k), ...);
          if (k > 0 && !has_value(this->c[0])) return not_a_number<T>();  // as for jets
          return T(R::coefficient(k, u..., this->c));
        },
        operands);
  }
  std::tuple<U...> operands;
};

/// v = A(u, w), w = B(u, v).
template <Rule A, Rule B, class T>
struct CoupledNodes {
  struct V : Growing<T> {
    T next() override {
      const int k = static_cast<int>(this->c.size());
      prepare(both->u, k);
      if (k > 0) both->w.at(k - 1);
      return T(A::coefficient(k, both->u, both->w.c, this->c));
    }
    CoupledNodes* both;
  };
  struct W : Growing<T> {
    T next() override {
      const int k = static_cast<int>(this->c.size());
      both->v.at(k);
      return T(B::coefficient(k, both->u, both->v.c, this->c));
    }
    CoupledNodes* both;
  };
  explicit CoupledNodes(const GrowingOperand<T>& operand) : u(operand) { v.both = w.both = this; }
  CoupledNodes(const CoupledNodes&) = delete;  // its two series point here
  CoupledNodes& operator=(const CoupledNodes&) = delete;
  GrowingOperand<T> u;
  V v;
  W w;
};

}  // namespace detail

template <class T>
class GrowingSeries : SeriesOperators<GrowingSeries<T>> {
 public:
  using value_type = T;

  /// The constant series x.
  template <class X>
    requires std::convertible_to<X, T>
  GrowingSeries(const X& x) : GrowingSeries(polynomial({T(x)})) {}  // implicit: numbers are series

  /// c_0 + c_1 t + ...: all further coefficients are 0.
  static GrowingSeries polynomial(std::vector<T> coefficients) {
    auto node = std::make_shared<detail::GrowingPolynomial<T>>();
    node->c = std::move(coefficients);
    return GrowingSeries(std::shared_ptr<detail::Growing<T>>(std::move(node)));
  }
  /// x + t.
  static GrowingSeries variable(const T& x) { return polynomial({x, T(1)}); }

  /// The caller gives the coefficients: some now, the others by append().
  static GrowingSeries given(std::vector<T> coefficients) {
    auto node = std::make_shared<detail::Given<T>>();
    node->c = std::move(coefficients);
    return GrowingSeries(std::shared_ptr<detail::Growing<T>>(std::move(node)));
  }
  /// Throws std::logic_error for a series that is not given.
  void append(const T& c) {
    if (!dynamic_cast<detail::Given<T>*>(node_.get()))
      throw std::logic_error("GrowingSeries: append() is for a series made by given()");
    node_->c.push_back(c);
  }

  /// Coefficient k >= 0, computed now if it is new. Valid until the next coefficient is computed.
  /// Throws std::out_of_range if it depends on one that has not been given.
  const T& operator[](int k) const { return node_->at(k); }

  /// How many coefficients have been computed or given.
  int size() const { return static_cast<int>(node_->c.size()); }

  explicit GrowingSeries(std::shared_ptr<detail::Growing<T>> node) : node_(std::move(node)) {}
  const std::shared_ptr<detail::Growing<T>>& node() const { return node_; }

 private:
  std::shared_ptr<detail::Growing<T>> node_;
};

namespace detail {
template <class S, class X>
auto growing_operand(const X& x) {
  using T = typename S::value_type;
  if constexpr (std::is_same_v<X, S>)
    return GrowingOperand<T>{x.node()};
  else
    return ConstantSeries<T>{T(x)};
}
}  // namespace detail

/// v = R(u...), to be computed later.
template <Rule R, class S, class... U>
  requires is_growing_series<S>
S lift(const U&... u) {
  using T = typename S::value_type;
  using Node = detail::RuleNode<R, T, decltype(detail::growing_operand<S>(u))...>;
  return S(std::make_shared<Node>(detail::growing_operand<S>(u)...));
}

/// v = A(u, w), w = B(u, v), to be computed later.
template <Rule A, Rule B, class S>
  requires is_growing_series<S>
std::pair<S, S> lift_coupled(const S& u) {
  using T = typename S::value_type;
  const auto both = std::make_shared<detail::CoupledNodes<A, B, T>>(detail::growing_operand<S>(u));
  const auto part = [&](detail::Growing<T>& node) {
    return S(std::shared_ptr<detail::Growing<T>>(both, &node));
  };
  return {part(both->v), part(both->w)};
}

}  // namespace jetlag
