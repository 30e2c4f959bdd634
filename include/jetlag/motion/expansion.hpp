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
// Coefficients k and k+1 of a force that does not depend on velocities need coefficients 0 .. k+1 of x, no more. So
// such laws go two orders at a time, which halves what must be read from memory; the others follow order by order.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "jetlag/motion/element_blocks.hpp"
#include "jetlag/motion/particle_order.hpp"
#include "jetlag/motion/system.hpp"
#include "jetlag/tape/workers.hpp"

namespace jetlag {

/// Coefficient k of all positions or velocities. Shape (particles, dimension).
template <class T>
using CoefficientView = Eigen::Map<const Coordinates<T>, Eigen::Unaligned, Eigen::OuterStride<>>;

template <class T = double>
class Expansion {
 public:
  /// Keeps no reference to the system. expected_degree: storage is made for it; growing beyond it costs a copy.
  /// The number of workers does not change a bit of the result.
  explicit Expansion(const System<T>& system, int expected_degree = 8,
                     const KernelTable<T>& table = kernels<T>(), Workers workers = Workers(1))
      : particles_(system.particles()),
        dimension_(system.dimension()),
        stride_(padded(dimension_)),
        workers_(std::move(workers)) {
    for (int i = 0; i < particles_; ++i)
      inverse_mass_.insert(inverse_mass_.end(), stride_, system.fixed()[i] ? T(0) : T(1) / system.mass()[i]);
    const auto rank = particle_order(system);
    for (const Elements<T>& elements : system.elements()) {
      if (elements.count() == 0) continue;
      ElementBlocks<T> blocks(system, elements, elements.law.force, table, rank);
      (blocks.reads_velocity() ? with_velocity_ : without_velocity_).push_back(std::move(blocks));
    }
    for (const auto* laws : {&without_velocity_, &with_velocity_})
      for (const auto& blocks : *laws) apart_ = apart_ || blocks.chunks() > 1;
    if (apart_)
      for (auto* laws : {&without_velocity_, &with_velocity_})
        for (auto& blocks : *laws) blocks.push_apart(particles_);
    reserve(std::max(expected_degree, 2));
  }

  /// Starts anew from a state: coefficients 0 and 1 of x are known. Shapes (particles, dimension).
  /// Throws std::invalid_argument for a state of another shape and for a fixed particle that is not at rest.
  void start(const State<T>& state) {
    require_shape(state, particles_, dimension_);
    for (int i = 0; i < particles_; ++i)
      if (inverse_mass_[i * stride_] == T(0) && !(state.velocity.row(i).array() == T(0)).all())
        throw std::invalid_argument("Expansion: particle " + std::to_string(i) +
                                    " is fixed and must be at rest");
    time_ = state.time;
    for (int i = 0; i < particles_; ++i)
      for (int c = 0; c < dimension_; ++c) {
        at(x_, 0)[i * stride_ + c] = state.position(i, c);
        at(x_, 1)[i * stride_ + c] = state.velocity(i, c);
      }
    std::copy_n(at(x_, 1), row_size(), at(v_, 0));
    order_ = 1;
  }

  /// The highest order of x that is known, >= 1.
  int order() const { return order_; }
  const T& time() const { return time_; }
  int particles() const { return particles_; }
  int dimension() const { return dimension_; }

  /// One more order.
  void grow() { grow_by(1); }

  void grow_to(int order) {
    while (order_ < order) grow_by(order_ + 1 < order ? 2 : 1);
  }

  /// Coefficient k of the positions, k <= order().
  CoefficientView<T> position(int k) const { return view(x_, k); }
  /// Coefficient k of the velocities, k <= order() - 1.
  CoefficientView<T> velocity(int k) const { return view(v_, k); }

  /// (element, order) pairs computed since construction: the honest unit of cost.
  std::size_t element_coefficients() const { return element_coefficients_; }

  /// Memory held for series, in bytes.
  std::size_t bytes() const {
    std::size_t total = sizeof(T) * (x_.size() + v_.size() + inverse_mass_.size());
    for (const auto* laws : {&without_velocity_, &with_velocity_})
      for (const auto& blocks : *laws) total += blocks.bytes();
    return total;
  }

 private:
  static constexpr int particles_of_a_task = 1024;

  std::size_t row_size() const { return static_cast<std::size_t>(particles_) * stride_; }
  T* at(AlignedVector<T>& series, int k) { return series.data() + k * row_size(); }
  CoefficientView<T> view(const AlignedVector<T>& series, int k) const {
    assert(0 <= k && k <= order_);
    return {series.data() + k * row_size(), particles_, dimension_, Eigen::OuterStride<>(stride_)};
  }

  /// One or two orders more. The rows of the new positions hold the forces until they are complete.
  void grow_by(int orders) {
    if (order_ + orders > capacity_) reserve(std::max(2 * capacity_, order_ + orders));
    const int k = order_ - 1;
    push(without_velocity_, k, orders);
    if (with_velocity_.empty()) {
      each_range([&](int first, int last) {
        collect(without_velocity_, first, last, k, orders);
        for (int n = 0; n < orders; ++n) accelerate(first, last, k + n);
      });
    } else {
      each_range([&](int first, int last) { collect(without_velocity_, first, last, k, orders); });
      for (int n = 0; n < orders; ++n) {
        push(with_velocity_, k + n, 1);
        each_range([&](int first, int last) {
          if (apart_) collect(with_velocity_, first, last, k + n, 1);
          accelerate(first, last, k + n);
        });
      }
    }
    order_ += orders;
  }

  /// f(first, last) for ranges of particles, all together all particles.
  template <class F>
  void each_range(const F& f) {
    const std::size_t tasks = (particles_ + particles_of_a_task - 1) / particles_of_a_task;
    workers_.each(tasks, [&](std::size_t i) {
      const int first = static_cast<int>(i) * particles_of_a_task;
      f(first, std::min(first + particles_of_a_task, particles_));
    });
  }

  /// Coefficients k .. k + orders - 1 of the forces of some laws: into the rows of the new positions, or apart.
  void push(std::vector<ElementBlocks<T>>& laws, int k, int orders) {
    const MotionRows<T> motion{at(x_, k), at(v_, k), row_size(), time_,
                               rest_.empty() ? nullptr : rest_.data()};
    if (!apart_ && &laws == &without_velocity_) std::fill_n(at(x_, k + 2), orders * row_size(), T(0));
    std::size_t tasks = 0;
    for (const auto& blocks : laws) {
      if (apart_ && blocks.running(k, orders) > 0) tasks += blocks.chunks();
      element_coefficients_ += blocks.count() * blocks.running(k, orders);
    }
    if (!apart_) {
      for (auto& blocks : laws)
        if (blocks.running(k, orders) > 0) blocks.push(0, k, orders, motion, at(x_, k + 2));
      return;
    }
    workers_.each(tasks, [&](std::size_t chunk) {
      for (auto& blocks : laws) {
        if (blocks.running(k, orders) == 0) continue;
        if (chunk < blocks.chunks()) return blocks.push(chunk, k, orders, motion, nullptr);
        chunk -= blocks.chunks();
      }
    });
  }

  /// Adds up what was pushed apart onto a range of particles; the first laws begin from zero.
  void collect(const std::vector<ElementBlocks<T>>& laws, int first, int last, int k, int orders) {
    if (!apart_) return;
    if (&laws == &without_velocity_)
      for (int n = 0; n < orders; ++n)
        std::fill(at(x_, k + 2 + n) + first * stride_, at(x_, k + 2 + n) + last * stride_, T(0));
    for (const auto& blocks : laws) blocks.collect(first, last, k, orders, at(x_, k + 2), row_size());
  }

  /// From coefficient k of the forces, in the rows of the new positions, to x_{k+2} and v_{k+1}.
  void accelerate(int first, int last, int k) {
    T *x = at(x_, k + 2), *v = at(v_, k + 1);
    const T of_velocity = T(1) / T(k + 1), of_position = T(1) / T((k + 1) * (k + 2));
    for (int i = first * stride_; i < last * stride_; ++i) {
      const T acceleration = x[i] * inverse_mass_[i];
      v[i] = acceleration * of_velocity;
      x[i] = acceleration * of_position;
    }
  }

  void reserve(int degree) {
    capacity_ = degree;
    x_.resize((degree + 1) * row_size(), T(0));
    v_.resize((degree + 1) * row_size(), T(0));
    for (auto* laws : {&without_velocity_, &with_velocity_})
      for (auto& blocks : *laws) blocks.reserve(degree - 1);  // x_degree needs order degree - 2 of the forces
  }

  int particles_, dimension_, stride_;
  Workers workers_;
  std::vector<T> inverse_mass_;  // one a padded component; 0 for fixed particles
  std::vector<ElementBlocks<T>> without_velocity_, with_velocity_;
  bool apart_ = false;  // chunks push rows of their own
  T time_{};
  int order_ = 1, capacity_ = 0;
  AlignedVector<T> x_, v_;  // [order][particle][padded component]
  AlignedVector<T> rest_;   // what the positions of order 0 have beyond the number; empty if nothing
  std::size_t element_coefficients_ = 0;
};

extern template class Expansion<double>;

}  // namespace jetlag
