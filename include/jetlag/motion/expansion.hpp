// SPDX-License-Identifier: MIT
#pragma once
// Expansion: the Taylor series of the motion of a whole system, grown one coefficient at a time.
//
// From  M x'' = F(t, x, x')  and coefficients 0 .. k+1 of x, coefficient k of F follows by running every tape
// for one more order, and with it
//
//     x_{k+2} = F_k / (m (k+1) (k+2)).
//
// Each operation pays O(k) for its next coefficient, so K coefficients cost O(K^2). A grown expansion can be
// grown further at any time, with the same bits as one that was grown at once.
//
// Time may be counted in a unit u of its own: coefficients are then those of powers of (t - t_0) / u, that is x_k u^k,
// and with a power of two their digits are the same. Fast and slow motions need it: of q'' = -w^2 q coefficient 20 is
// some w^20, beyond the range of a double for w = 1e16 and 1e-16.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "jetlag/motion/element_blocks.hpp"
#include "jetlag/motion/system.hpp"

namespace jetlag {

/// Coefficient k of all positions or velocities. Shape (particles, dimension).
template <class T>
using CoefficientView = Eigen::Map<const Coordinates<T>, Eigen::Unaligned, Eigen::OuterStride<>>;

template <class T = double>
class Expansion {
 public:
  /// Keeps no reference to the system. expected_degree: storage is made for it; growing beyond it costs a copy.
  explicit Expansion(const System<T>& system, int expected_degree = 8,
                     const KernelTable<T>& table = kernels<T>())
      : particles_(system.particles()), dimension_(system.dimension()), stride_(padded(dimension_)) {
    for (int i = 0; i < particles_; ++i)
      inverse_mass_.push_back(system.fixed()[i] ? T(0) : T(1) / system.mass()[i]);
    for (const Elements<T>& elements : system.elements())
      if (elements.count() > 0) forces_.emplace_back(system, elements, elements.law.force, table);
    reserve(std::max(expected_degree, 2));
  }

  /// Starts anew from a state: coefficients 0 and 1 of x are known. Shapes (particles, dimension).
  /// time_unit [s]: positive and finite.
  /// Throws std::invalid_argument for a state of another shape and for a fixed particle that is not at rest.
  void start(const State<T>& state, const T& time_unit = T(1)) {
    using std::isfinite;
    require_shape(state, particles_, dimension_);
    if (!(time_unit > T(0)) || !isfinite(time_unit))
      throw std::invalid_argument("Expansion: the unit of time must be > 0 and finite");
    for (int i = 0; i < particles_; ++i)
      if (inverse_mass_[i] == T(0) && !(state.velocity.row(i).array() == T(0)).all())
        throw std::invalid_argument("Expansion: particle " + std::to_string(i) +
                                    " is fixed and must be at rest");
    time_ = state.time;
    time_unit_ = time_unit;
    for (int i = 0; i < particles_; ++i)
      for (int c = 0; c < dimension_; ++c) {
        at(x_, 0)[i * stride_ + c] = state.position(i, c);
        at(v_, 0)[i * stride_ + c] = state.velocity(i, c);
        at(x_, 1)[i * stride_ + c] = state.velocity(i, c) * time_unit;
      }
    order_ = 1;
  }

  /// The highest order of x that is known, >= 1.
  int order() const { return order_; }
  const T& time() const { return time_; }
  const T& time_unit() const { return time_unit_; }
  int particles() const { return particles_; }
  int dimension() const { return dimension_; }

  /// One more order.
  void grow() {
    if (order_ + 1 > capacity_) reserve(2 * capacity_);
    const int k = order_ - 1;
    const T time = k == 0 ? time_ : k == 1 ? time_unit_ : T(0);
    std::fill(force_.begin(), force_.end(), T(0));
    for (auto& blocks : forces_) {
      if (k > 0 && blocks.is_static()) continue;
      blocks.run(k, at(x_, k), at(v_, k), time, [&](std::size_t b) { blocks.scatter(b, k, force_.data()); });
      element_coefficients_ += blocks.count();
    }
    T* next = at(x_, k + 2);
    T* next_velocity = at(v_, k + 1);
    for (int i = 0; i < particles_; ++i) {
      for (int c = 0; c < stride_; ++c) {
        const T change = force_[i * stride_ + c] * inverse_mass_[i] * time_unit_;
        next_velocity[i * stride_ + c] = change / T(k + 1);
        next[i * stride_ + c] = change * time_unit_ / T((k + 1) * (k + 2));
      }
    }
    ++order_;
  }

  void grow_to(int order) {
    while (order_ < order) grow();
  }

  /// Coefficient k of the positions, times time_unit^k, k <= order().
  CoefficientView<T> position(int k) const { return view(x_, k); }
  /// Coefficient k of the velocities [m/s], times time_unit^k, k <= order() - 1.
  CoefficientView<T> velocity(int k) const { return view(v_, k); }

  /// (element, order) pairs computed since construction: the honest unit of cost.
  std::size_t element_coefficients() const { return element_coefficients_; }

  /// Memory held for series, in bytes.
  std::size_t bytes() const {
    std::size_t total = sizeof(T) * (x_.size() + v_.size() + force_.size());
    for (const auto& blocks : forces_) total += blocks.bytes();
    return total;
  }

 private:
  std::size_t row_size() const { return static_cast<std::size_t>(particles_) * stride_; }
  T* at(AlignedVector<T>& series, int k) { return series.data() + k * row_size(); }
  CoefficientView<T> view(const AlignedVector<T>& series, int k) const {
    assert(0 <= k && k <= order_);
    return {series.data() + k * row_size(), particles_, dimension_, Eigen::OuterStride<>(stride_)};
  }

  void reserve(int degree) {
    capacity_ = degree;
    x_.resize((degree + 1) * row_size(), T(0));
    v_.resize((degree + 1) * row_size(), T(0));
    force_.resize(row_size(), T(0));
    for (auto& blocks : forces_) blocks.reserve(degree);
  }

  int particles_, dimension_, stride_;
  std::vector<T> inverse_mass_;  // 0 for fixed particles
  std::vector<ElementBlocks<T>> forces_;
  T time_{}, time_unit_{1};
  int order_ = 1, capacity_ = 0;
  AlignedVector<T> x_, v_, force_;  // [order][particle][padded component]
  std::size_t element_coefficients_ = 0;
};

extern template class Expansion<double>;

}  // namespace jetlag
