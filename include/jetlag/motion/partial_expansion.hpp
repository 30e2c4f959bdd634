// SPDX-License-Identifier: MIT
#pragma once
// PartialExpansion: the Taylor series of the motion of a few particles of a system.
//
// The chosen ("active") particles are expanded together, exactly coupled to each other. Whoever else shares an element
// with one of them is "known": its series about the same time is given, as many orders as are wanted.
//
//        o---o---o===*===*===*===o---o---o        * active   o others    === elements that are run
//                known         known
//
// Cost: that of the elements that touch an active particle, whatever the size of the system. Choosing costs some 30 ns
// for each of them; a choice can be kept and used again.
//
// Rows, for each order:     active 0 .. A-1 | one for forces on known particles, never read | known 0 .. B-1

#include <cstdint>
#include <span>
#include <vector>

#include "jetlag/model/model.hpp"

namespace jetlag {

class PartialExpansion {
 public:
  /// order: the highest that will be asked for, at least 2.
  PartialExpansion(const Model<double>& model, int order);

  /// Goes on with another epoch of the model; a choice comes next.
  void move_to(const Model<double>& model);

  /// Chooses the active particles: distinct, none fixed. places: room for one number a particle, all -1; it is again
  /// when this returns.
  void choose(std::span<const int> active, std::vector<int>& places);

  const std::vector<int>& active() const { return active_; }
  const std::vector<int>& known() const { return known_; }

  /// Coefficient k of the position of an active particle by its place in active(): `stride` numbers, padding zero.
  /// The caller fills in orders 0 and 1.
  double* active_row(int k, std::size_t place) { return x_.data() + (k * rows_ + place) * stride_; }
  const double* active_row(int k, std::size_t place) const {
    return x_.data() + (k * rows_ + place) * stride_;
  }
  /// Coefficient k of the position of a known particle by its place in known(). The caller fills in orders 0 to
  /// order() - 2 of what it will grow to before it grows.
  double* known_row(int k, std::size_t place) { return active_row(k, active_.size() + 1 + place); }
  int stride() const { return stride_; }
  /// The distance between a row of one order and that of the next.
  std::size_t next_order() const { return rows_ * stride_; }

  /// Re-expands the known rows, given about times that lie s[place] before the present one, orders 0 .. order.
  void shift_known(int order, const std::vector<double>& s);

  /// Grows the active series from orders 0 and 1 to `order`. time [s]: of laws that depend on it.
  void grow_to(int order, double time);

  /// When choices in the forces change, on the series up to `order`, to which it has grown: see ElementBlocks::find_changes,
  /// of numbers of particles.
  template <class Horizon, class Found>
  void find_changes(int order, const Horizon& horizon, const Found& found) {
    const auto particles = [&](std::vector<int>& rows) {
      for (int& row : rows) {
        const auto place = static_cast<std::size_t>(row);
        row = place < active_.size() ? active_[place] : known_[place - active_.size() - 1];
      }
    };
    for (auto& law : laws_)
      if (law.count() > 0 && law.has_conditions())
        law.find_changes(
            order - 1, [&](std::vector<int>& rows) { return particles(rows), horizon(rows); }, found);
  }

  /// (element, order) pairs computed since construction.
  std::uint64_t element_coefficients() const { return element_coefficients_; }

 private:
  void find_velocities();
  std::vector<int> touched_elements(std::size_t law, std::vector<int>& places);
  void sort(std::vector<int>& numbers, std::size_t end);
  MotionRows<double> motion(int k, double time) {
    return {x_.data() + k * rows_ * stride_, !reads_velocity_ ? nullptr : v_.data() + k * rows_ * stride_,
            rows_ * stride_, time, 1.0};
  }
  void push(std::size_t law, int k, int orders, double time);
  void accelerate(int k);

  Model<double> model_;
  int order_, stride_;
  std::vector<ElementBlocks<double>> laws_;
  bool reads_velocity_ = false;
  std::vector<int> active_, known_;
  std::size_t rows_ = 1;
  std::vector<std::uint64_t> bits_;
  std::vector<double> push_;          // 1/m of the active particles, one a padded component
  AlignedVector<double> x_, v_;       // [order][row][padded component]; v_ only where a law reads velocities
  std::vector<double> shift_, copy_;  // of each component of the known rows; of the last of them
  std::uint64_t element_coefficients_ = 0;
};

}  // namespace jetlag
