// SPDX-License-Identifier: MIT
#pragma once
// How an expansion grows: the definitions of expansion.hpp, which includes them. What runs for every particle is inline.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/motion/expansion.hpp"

namespace jetlag {

namespace detail {

/// Calls f(i, c) for the components of all rows, with as many loops as there are dimensions.
template <class F>
void for_components(int rows, int dimension, const F& f) {
  const auto all = [&](auto d) {
    for (int i = 0; i < rows; ++i)
      for (int c = 0; c < d; ++c) f(static_cast<std::size_t>(i), c);
  };
  if (dimension == 3) return all(std::integral_constant<int, 3>{});
  if (dimension == 2) return all(std::integral_constant<int, 2>{});
  all(std::integral_constant<int, 1>{});
}

}  // namespace detail

template <class T>
Expansion<T>::Expansion(const Model<T>& model, int expected_degree, const KernelTable<T>& table,
                        Workers workers)
    : model_(model),
      table_(&table),
      particles_(model.particles()),
      dimension_(model.dimension()),
      stride_(padded(dimension_)),
      workers_(std::move(workers)),
      expected_degree_(expected_degree) {
  for (int i = 0; i < particles_; ++i)
    inverse_mass_.insert(inverse_mass_.end(), stride_, model.inverse_mass(i));
  for (const auto& law : model.laws()) {
    laws_.push_back(ElementBlocks<T>::none_of(law->forces(), 0));
    take(*law, laws_.back());
  }
  arrange();
  reserve(std::max(expected_degree, 2));
}

template <class T>
void Expansion<T>::take(const typename Model<T>::Law& law, ElementBlocks<T>& blocks) {
  blocks.take(law.forces(), law.elements().particles, model_.running_order(law), *table_, std::identity(),
              std::identity());
}

template <class T>
void Expansion<T>::move_to(const Model<T>& model) {
  model.require_epoch_of(model_);
  const Model<T> before = std::exchange(model_, model);
  for (std::size_t l = 0; l < laws_.size(); ++l)
    if (before.laws()[l] != model.laws()[l]) take(model.law(l), laws_[l]);
  arrange();
  order_ = 1;
  forget_ahead();
}

template <class T>
void Expansion<T>::start(const State<T>& state, const T& time_unit) {
  require_shape(state, particles_, dimension_);
  const bool ahead = is_ahead(state, time_unit);
  ahead_.is_known = false;
  ahead_.element_coefficients = 0;
  if (ahead) return go_ahead(state.time);
  for (int i = 0; i < particles_; ++i)
    if (inverse_mass_[i * stride_] == T(0) && !(state.velocity.row(i).array() == T(0)).all())
      throw std::invalid_argument("Expansion: particle " + std::to_string(i) +
                                  " is fixed and must be at rest");
  begin(state, time_unit);
}

template <class T>
void Expansion<T>::begin(const State<T>& state, const T& time_unit) {
  time_ = state.time;
  pad(state.position, at(x_, 0));
  pad(state.velocity, at(v_, 0));
  rest_.assign(state.position_rest.size() == 0 ? 0 : row_size(), T(0));
  if (!rest_.empty()) pad(state.position_rest, rest_.data());
  restart(time_unit);
}

template <class T>
void Expansion<T>::pad(const Coordinates<T>& rows, T* to) const {
  if (stride_ == dimension_) {
    std::copy_n(rows.data(), row_size(), to);
    return;
  }
  detail::for_components(particles_, dimension_,
                         [=, from = rows.data(), d = dimension_, stride = stride_](std::size_t i, int c) {
                           to[i * stride + c] = from[i * d + c];
                         });
}

template <class T>
void Expansion<T>::restart(const T& time_unit) {
  using std::isfinite;
  if (time_unit == T(0) || !isfinite(time_unit))
    throw std::invalid_argument("Expansion: the unit of time must be finite and not 0");
  ahead_.is_known = false;
  if (push_.empty() || time_unit_ != time_unit) {
    push_.resize(inverse_mass_.size());
    for (std::size_t i = 0; i < push_.size(); ++i) push_[i] = inverse_mass_[i] * time_unit;
  }
  const T unit = time_unit_ = time_unit;
  const T* v = at(v_, 0);
  T* x = at(x_, 1);
  for (std::size_t i = 0, size = row_size(); i < size; ++i) x[i] = v[i] * unit;
  order_ = 1;
  is_rolled_up_ = false;
  elements_are_ahead_ = false;
}

template <class T>
void Expansion<T>::grow_to(int order) {
  if (elements_are_ahead_ && order > order_)
    throw std::logic_error("Expansion: a series that has looked ahead grows no more");
  if (order > capacity_) reserve(std::max(2 * capacity_, order));
  if (is_unrolled() && order > unrolled_.highest_order()) roll_up();
  if (is_unrolled()) return unroll_to(order);
  if (wavefront_) return sweep_to(order);
  while (order_ < order) grow_by(order_ + 1 < order ? 2 : 1);
}

template <class T>
bool Expansion<T>::has_conditions() const {
  return std::ranges::any_of(laws_, [](const auto& law) { return law.count() > 0 && law.has_conditions(); });
}

template <class T>
std::optional<T> Expansion<T>::first_change(T& h, bool of_known) {
  std::optional<T> first;
  T most = h;
  for (auto& law : laws_)
    if (law.count() > 0 && law.has_conditions()) law.find_change(order_ - 1, most, first, of_known);
  if (!first) h = most;
  return first;
}

template <class T>
std::size_t Expansion<T>::bytes() const {
  std::size_t total =
      sizeof(T) * (x_.size() + v_.size() + ahead_.x.size() + ahead_.v.size() + 2 * inverse_mass_.size());
  for (const auto& blocks : laws_) total += blocks.bytes();
  return total + unrolled_.bytes();
}

template <class T>
CoefficientView<T> Expansion<T>::view(const AlignedVector<T>& series, int k) const {
  assert(0 <= k && k <= order_);
  return {series.data() + k * row_size(), particles_, dimension_, Eigen::OuterStride<>(stride_)};
}

template <class T>
void Expansion<T>::count(const std::vector<ElementBlocks<T>*>& laws, int k, int orders) {
  for (const auto* blocks : laws) element_coefficients_ += blocks->count() * blocks->running(k, orders);
}

template <class T>
inline void Expansion<T>::accelerate(std::size_t first, std::size_t last, int k) {
  jetlag::accelerate(last - first, k, time_unit_, push_.data() + first, at(x_, k + 2) + first,
                     at(v_, k + 1) + first);
}

template <class T>
void Expansion<T>::grow_by(int orders) {
  const int k = order_ - 1;
  std::fill_n(at(x_, k + 2), orders * row_size(), T(0));
  for (auto* blocks : without_velocity_)
    if (blocks->running(k, orders) > 0) blocks->push_all(k, orders, motion(k), at(x_, k + 2));
  for (int n = k; n < k + orders; ++n) {
    for (auto* blocks : with_velocity_)
      if (blocks->running(n, 1) > 0) blocks->push_all(n, 1, motion(n), at(x_, n + 2));
    accelerate(0, row_size(), n);
  }
  count(without_velocity_, k, orders);
  count(with_velocity_, k, orders);
  order_ += orders;
}

template <class T>
void Expansion<T>::unroll_to(int order) {
  if (order <= order_) return;
  unrolled_.grow(at(x_, 0), at(v_, 0), push_.data(), time_, time_unit_, order_ - 1, order - 1);
  for (const auto& law : laws_)
    element_coefficients_ += law.count() * law.running(order_ - 1, order - order_);
  order_ = order;
}

template <class T>
void Expansion<T>::roll_up() {
  is_rolled_up_ = true;
  const std::size_t counted = element_coefficients_;
  const int known = std::exchange(order_, 1);
  while (order_ < known) grow_by(order_ + 1 < known ? 2 : 1);
  element_coefficients_ = counted;
}

template <class T>
void Expansion<T>::arrange() {
  without_velocity_.clear();
  with_velocity_.clear();
  chunks_.clear();
  bool large = false;
  unrolled_ = UnrolledMotion<T>(model_, *table_);
  if (expected_degree_ > unrolled_.highest_order()) unrolled_ = {};
  for (auto& blocks : laws_) {
    if (blocks.count() == 0) continue;
    (blocks.reads_velocity() ? with_velocity_ : without_velocity_).push_back(&blocks);
    large = large || blocks.chunks() > chunks_of_a_small_scene;
  }
  if (large) return push_apart();
  if (!wavefront_) return;
  for (auto& blocks : laws_) blocks.push_together();
  wavefront_.reset();
  keep_histories(true);
}

template <class T>
void Expansion<T>::push_apart() {
  std::vector<std::pair<Chunk, std::vector<int>>> all;
  for (auto* laws : {&without_velocity_, &with_velocity_})
    for (auto* blocks : *laws) {
      auto touched = blocks->push_apart(particles_);
      for (std::size_t c = 0; c < touched.size(); ++c)
        all.push_back({{blocks, c, {}}, std::move(touched[c])});
    }
  std::vector<std::pair<int, std::size_t>> order;  // by the highest particle, then as they came
  for (std::size_t c = 0; c < all.size(); ++c)
    order.emplace_back(*std::ranges::max_element(all[c].second), c);
  std::ranges::sort(order);
  std::vector<std::size_t> last(particles_, 0), needed;
  for (std::size_t c = 0; c < all.size(); ++c)
    for (int particle : all[order[c].second].second) last[particle] = c;
  for (int i = 0; i < particles_; ++i) all[order[last[i]].second].first.last_of.push_back(i);
  for (const auto& [highest, c] : order) {
    std::size_t latest = 0;
    for (int particle : all[c].second) latest = std::max(latest, last[particle]);
    needed.push_back(latest);
    chunks_.push_back(std::move(all[c].first));
  }
  chunks_between_passes_ = 0;
  for (std::size_t c = 0; c < needed.size(); ++c)
    chunks_between_passes_ = std::max(chunks_between_passes_, needed[c] - c + 1);
  wavefront_ = std::make_unique<Wavefront>(std::move(needed));
  keep_histories(false);
}

template <class T>
void Expansion<T>::keep_histories(bool keep) {
  for (auto& blocks : laws_) blocks.storage().keep_histories(keep || blocks.has_conditions());
}

template <class T>
void Expansion<T>::find_lost_histories() {
  for (Chunk& chunk : chunks_) chunk.is_replayed = order_ > 1 && !chunk.blocks->storage().keeps_histories();
}

template <class T>
void Expansion<T>::begin_chunk(const Chunk& chunk, int first) {
  chunk.blocks->storage().begin_chunk(chunk.number);
  if (!chunk.is_replayed) return;
  for (int k = 0; k < first; k += 2) chunk.blocks->replay(chunk.number, k, std::min(2, first - k), motion(k));
}

template <class T>
void Expansion<T>::sweep_to(int order) {
  if (order <= order_) return;
  find_lost_histories();
  if (order_ > orders_ahead) {
    keep_histories(true);
  } else if (const int passes = (order - order_ + orders_of_a_pass() - 1) / orders_of_a_pass();
             passes > 1 && bytes_under_way(passes) > bytes_in_cache) {
    sweep(order_ + passes / 2 * orders_of_a_pass());
    find_lost_histories();
  }
  sweep(order);
}

template <class T>
std::size_t Expansion<T>::bytes_under_way(int passes) const {
  std::size_t most = 0;
  for (const auto& blocks : laws_)
    if (blocks.count() > 0 && !blocks.storage().keeps_histories())
      most = std::max(most, blocks.storage().history_bytes_of_a_chunk());
  return most * std::min(chunks_between_passes_ * static_cast<std::size_t>(passes), chunks_.size());
}

template <class T>
void Expansion<T>::sweep(int order) {
  const int step = orders_of_a_pass(), first = order_ - 1, orders = order - order_;
  const auto passes = static_cast<std::size_t>((orders + step - 1) / step);
  const auto of_pass = [&](std::size_t pass) {
    const int done = static_cast<int>(pass) * step;
    return std::pair(first + done, std::min(step, orders - done));
  };
  (*wavefront_)(
      passes, workers_,
      [&](std::size_t c, std::size_t pass) {
        const Chunk& chunk = chunks_[c];
        const auto [k, n] = of_pass(pass);
        if (pass == 0) begin_chunk(chunk, first);
        if (chunk.blocks->running(k, n) > 0) chunk.blocks->push(chunk.number, k, n, motion(k), nullptr);
        if (pass + 1 == passes) chunk.blocks->storage().end_chunk(chunk.number);
      },
      [&](std::size_t c, std::size_t pass) {
        const auto [k, n] = of_pass(pass);
        for (int particle : chunks_[c].last_of) complete(particle, k, n);
      });
  count(without_velocity_, first, orders);
  count(with_velocity_, first, orders);
  order_ = order;
}

template <class T>
inline void Expansion<T>::complete(int particle, int k, int orders) {
  const std::size_t row = static_cast<std::size_t>(particle) * stride_;
  for (int n = k; n < k + orders; ++n) std::fill_n(at(x_, n + 2) + row, stride_, T(0));
  for (const auto* laws : {&without_velocity_, &with_velocity_})
    for (const auto* blocks : *laws) blocks->collect(particle, k, orders, at(x_, k + 2), row_size());
  for (int n = k; n < k + orders; ++n) accelerate(row, row + stride_, n);
}

template <class T>
void Expansion<T>::reserve(int degree) {
  capacity_ = degree;
  x_.resize((degree + 1) * row_size(), T(0));
  v_.resize((degree + 1) * row_size(), T(0));
  if (!ahead_.x.empty()) {
    ahead_.x.resize(x_.size(), T(0));
    ahead_.v.resize(v_.size(), T(0));
  }
  for (auto& blocks : laws_) blocks.reserve(degree - 1);  // x_degree needs order degree - 2 of the forces
}

}  // namespace jetlag

#include "jetlag/motion/expansion_ahead.hpp"
#include "jetlag/motion/expansion_sums.hpp"
