// SPDX-License-Identifier: MIT
#include "jetlag/motion/partial_expansion.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "jetlag/base/accelerate.hpp"
#include "jetlag/base/wide.hpp"

namespace jetlag {

namespace {

/// Passes first .. first + passes - 1 of taylor_shift (series/calculus/polynomial.hpp),
///
///     pass p:   c_{k-1} += s c_k,   k = order .. p + 1,
///
/// for `width` polynomials side by side: c[k][i], s[i]. They go together, each one coefficient behind the one before,
/// whose results it takes over; what is computed is the same.
template <int width, int passes>
[[gnu::always_inline]] inline void shift_passes(int order, int first, const double* s, double* c,
                                                std::size_t next_order) {
  constexpr int eights = width / 8;
  Eight step[eights], sum[passes][eights];  // what each pass has computed last
  std::memcpy(step, s, sizeof step);
  for (auto& of_pass : sum) std::memcpy(of_pass, c + order * next_order, sizeof of_pass);
  const auto advance = [&](int begun, int t) {
    for (int p = begun - 1; p > 0; --p)
      for (int i = 0; i < eights; ++i) sum[p][i] = sum[p - 1][i] + step[i] * sum[p][i];
    Eight next[eights];
    std::memcpy(next, c + (order - t - 1) * next_order, sizeof next);
    for (int i = 0; i < eights; ++i) sum[0][i] = next[i] + step[i] * sum[0][i];
  };
  for (int t = 0; t < passes - 1; ++t) advance(t + 1, t);
  for (int t = passes - 1; t < order - first; ++t) {
    advance(passes, t);
    std::memcpy(c + (order - t + passes - 2) * next_order, sum[passes - 1], sizeof sum[0]);
  }
  for (int p = 0; p < passes - 1; ++p) std::memcpy(c + (first + p) * next_order, sum[p], sizeof sum[0]);
}

template <int width>
[[gnu::always_inline]] inline void shift(int order, const double* s, double* c, std::size_t next_order) {
  int first = 0;
  for (; first + 4 <= order; first += 4) shift_passes<width, 4>(order, first, s, c, next_order);
  if (order - first == 3) shift_passes<width, 3>(order, first, s, c, next_order);
  if (order - first == 2) shift_passes<width, 2>(order, first, s, c, next_order);
  if (order - first == 1) shift_passes<width, 1>(order, first, s, c, next_order);
}

constexpr int wide = 32, narrow = 8;
JETLAG_WIDE void shift_wide(int order, const double* s, double* c, std::size_t next_order) {
  shift<wide>(order, s, c, next_order);
}
JETLAG_WIDE void shift_narrow(int order, const double* s, double* c, std::size_t next_order) {
  shift<narrow>(order, s, c, next_order);
}

}  // namespace

PartialExpansion::PartialExpansion(const Model<double>& model, int order)
    : model_(model), order_(std::max(order, 2)), stride_(padded(model.dimension())) {
  for (const auto& law : model.laws())
    laws_.push_back(ElementBlocks<double>::none_of(law->forces(), order_ - 1));
  find_velocities();
}

void PartialExpansion::move_to(const Model<double>& model) {
  model.require_epoch_of(model_);
  model_ = model;
  find_velocities();
}

void PartialExpansion::find_velocities() {
  reads_velocity_ = false;
  for (std::size_t law = 0; law < laws_.size(); ++law)
    if (model_.law(law).count() > 0) reads_velocity_ = reads_velocity_ || laws_[law].reads_velocity();
}

/// The elements of a law that touch an active particle, ascending. Known particles are given their places.
std::vector<int> PartialExpansion::touched_elements(std::size_t law, std::vector<int>& places) {
  const auto& elements = model_.law(law);
  const int active = static_cast<int>(active_.size());
  std::vector<int> touched;
  for (int a : active_)
    for (int e : elements.of(a)) {
      const auto members = elements.particles_of(e);
      const int first =
          *std::ranges::find_if(members, [&](int i) { return 0 <= places[i] && places[i] < active; });
      if (first != a) continue;  // another participant is active too, and brings it
      for (const int other : members)
        if (places[other] < 0) {
          places[other] = active + 1 + static_cast<int>(known_.size());
          known_.push_back(other);
        }
      touched.push_back(e);
    }
  sort(touched, elements.count());
  return touched;
}

/// Distinct numbers below `end`, ascending; where they are many in a table of bits.
void PartialExpansion::sort(std::vector<int>& numbers, std::size_t end) {
  const std::size_t words = end / 64 + 1;
  if (numbers.size() < words / 4 + 16) {
    if (!std::ranges::is_sorted(numbers)) std::ranges::sort(numbers);
    return;
  }
  bits_.assign(words, 0);
  for (int n : numbers) bits_[n / 64] |= std::uint64_t{1} << n % 64;
  auto next = numbers.begin();
  for (std::size_t word = 0; word < words; ++word)
    for (std::uint64_t left = bits_[word]; left != 0; left &= left - 1)
      *next++ = static_cast<int>(64 * word) + std::countr_zero(left);
}

void PartialExpansion::choose(std::span<const int> active, std::vector<int>& places) {
  active_.assign(active.begin(), active.end());
  known_.clear();
  for (std::size_t i = 0; i < active_.size(); ++i) places[active_[i]] = static_cast<int>(i);
  const int waste = static_cast<int>(active_.size());
  for (std::size_t law = 0; law < laws_.size(); ++law)
    laws_[law].take(
        model_.law(law).forces(), model_.law(law).elements().particles, touched_elements(law, places),
        kernels<double>(), [&](int i) { return places[i]; },
        [&](int i) { return std::min(places[i], waste); });
  for (const auto* set : {&active_, &known_})
    for (int i : *set) places[i] = -1;

  rows_ = active_.size() + 1 + known_.size();
  const std::size_t size = (order_ + 1) * rows_ * stride_;
  if (x_.size() < size) x_.resize(size);
  if (reads_velocity_ && v_.size() < size) v_.resize(size);
  push_.clear();
  for (int i : active_) push_.insert(push_.end(), stride_, model_.inverse_mass(i));
}

void PartialExpansion::shift_known(int order, const std::vector<double>& s) {
  shift_.clear();
  for (double of_row : s) shift_.insert(shift_.end(), stride_, of_row);
  const std::size_t size = shift_.size(), next_order = rows_ * stride_;
  shift_.resize((size + narrow - 1) / narrow * narrow, 0.0);
  double* known = known_row(0, 0);
  std::size_t i = 0;
  for (; i + wide <= size; i += wide) shift_wide(order, shift_.data() + i, known + i, next_order);
  for (; i + narrow <= size; i += narrow) shift_narrow(order, shift_.data() + i, known + i, next_order);
  if (i == size) return;
  // What is left goes through a copy of full width.
  copy_.resize((order + 1) * static_cast<std::size_t>(narrow));
  const int left = static_cast<int>(size - i);
  for (int k = 0; k <= order; ++k)
    for (int j = 0; j < narrow; ++j) copy_[k * narrow + j] = j < left ? known[k * next_order + i + j] : 0.0;
  shift_narrow(order, shift_.data() + i, copy_.data(), narrow);
  for (int k = 0; k <= order; ++k)
    for (int j = 0; j < left; ++j) known[k * next_order + i + j] = copy_[k * narrow + j];
}

void PartialExpansion::push(std::size_t law, int k, int orders, double time) {
  ElementBlocks<double>& blocks = laws_[law];
  if (blocks.running(k, orders) == 0) return;
  blocks.push_all(k, orders, motion(k, time), active_row(k + 2, 0));
  element_coefficients_ += blocks.count() * blocks.running(k, orders);
}

/// From coefficient k of the forces, in the rows of the new positions.
void PartialExpansion::accelerate(int k) {
  double* x = active_row(k + 2, 0);
  double* v = reads_velocity_ ? v_.data() + (k + 1) * rows_ * stride_ : nullptr;
  jetlag::accelerate(push_.size(), k, 1.0, push_.data(), x, v);
}

void PartialExpansion::grow_to(int order, double time) {
  assert(order <= order_);
  const std::size_t row = rows_ * stride_, pushed = (active_.size() + 1) * stride_;
  if (reads_velocity_) {
    std::copy_n(active_row(1, 0), active_.size() * stride_, v_.data());
    for (int k = 0; k + 2 <= order; ++k)  // v_k = (k + 1) x_{k+1} of the known
      for (std::size_t i = pushed; i < row; ++i) v_[k * row + i] = (k + 1) * x_[(k + 1) * row + i];
  }
  for (int k = 0; k + 2 <= order;) {
    const int orders = k + 3 <= order ? 2 : 1;
    for (int n = k; n < k + orders; ++n) std::fill_n(active_row(n + 2, 0), pushed, 0.0);
    for (std::size_t law = 0; law < laws_.size(); ++law)
      if (!laws_[law].reads_velocity()) push(law, k, orders, time);
    for (const int end = k + orders; k < end; ++k) {
      for (std::size_t law = 0; law < laws_.size(); ++law)
        if (laws_[law].reads_velocity()) push(law, k, 1, time);
      accelerate(k);
    }
  }
}

}  // namespace jetlag
