// SPDX-License-Identifier: MIT
#pragma once
// The elements of one law, ready to run: blocks of lanes, and the rows of the particles they read and push.
//
// Large scenes run in chunks of blocks, which may run at the same time. Each chunk then pushes rows of its own, one
// for each particle that it touches; they are added up particle by particle, in the order of the chunks, so that the
// sum does not depend on who was first.

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "jetlag/model/motion_rows.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/series/calculus/row_sums.hpp"
#include "jetlag/tape/program.hpp"
#include "jetlag/tape/watched.hpp"

namespace jetlag {

template <class T>
class ElementBlocks {
 public:
  /// One tape of a law (its force or its energy) over some of its elements, given by their numbers in the order in which
  /// they run.   mass: of all particles [kg].
  ElementBlocks(int dimension, const std::vector<T>& mass, const Elements<T>& elements, const Tape& tape,
                const KernelTable<T>& table, std::span<const int> chosen);

  /// The tape of `all`, over none of its elements yet: `take` chooses them. Room for so many orders.
  static ElementBlocks none_of(const ElementBlocks& all, int capacity);

  /// Runs some elements of `all` from now on, in the order given; `all` has all elements of the law in their order.
  /// particles: of all elements, shape (elements of all, participants). read(particle), pushed(particle): the row
  /// that is read, and the row onto which the force is added.
  template <class Read, class Pushed>
  void take(const ElementBlocks& all, std::span<const int> particles, std::span<const int> elements,
            const KernelTable<T>& table, const Read& read, const Pushed& pushed);

  int participants() const { return participants_; }
  Blocks<T>& storage() { return blocks_; }
  const Blocks<T>& storage() const { return blocks_; }

  /// Each chunk pushes rows of its own from now on; `collect` adds them up. For all laws of a system, or for none.
  /// Returns the particles that each chunk touches.
  std::vector<std::vector<int>> push_apart(int particles);

  /// All push the same rows again.
  void push_together();

  void reserve(int capacity) { blocks_.reserve(capacity); }
  std::size_t count() const { return blocks_.count(); }
  std::size_t chunks() const { return blocks_.chunks(); }
  std::size_t bytes() const {
    return blocks_.bytes() + (row_.size() + pushed_row_.size() + own_rows_.size()) * sizeof(int) +
           pushed_.size() * sizeof(T);
  }

  /// Whether orders above 0 are zero, so that there is nothing to run.
  bool is_static() const { return blocks_.program().is_static; }
  bool reads_velocity() const {
    return std::ranges::any_of(inputs_,
                               [](const auto& input) { return input.kind == Input::Kind::velocity; });
  }
  bool reads_time() const { return time_.has_value(); }
  /// Of `orders` orders from k on, those that are not zero for certain.
  int running(int k, int orders) const { return !is_static() ? orders : k == 0 ? 1 : 0; }

  /// Coefficients k .. k + orders - 1 of the forces of the elements in a chunk, added to the participants: + on those whose
  /// force the law gives, - on the last one where it is not among them. force: rows of order k; those of order k + 1
  /// follow at the distance next_order. Not used when the chunks push rows of their own.
  void push(std::size_t chunk, int k, int orders, const MotionRows<T>& motion, T* force);

  /// Of all chunks, one after another.
  void push_all(int k, int orders, const MotionRows<T>& motion, T* force) {
    for (std::size_t chunk = 0; chunk < chunks(); ++chunk) push(chunk, k, orders, motion, force);
  }

  /// Computes the histories of a chunk once more, orders k .. k + orders - 1 as in `push`, and pushes nothing.
  void replay(std::size_t chunk, int k, int orders, const MotionRows<T>& motion) {
    orders = running(k, orders);
    for (std::size_t b = first_block(chunk); b < first_block(chunk + 1); ++b) run(b, k, orders, motion);
  }

  /// Adds what the chunks have pushed onto a particle: orders k .. k + orders - 1, as in `push`.
  void collect(int particle, int k, int orders, T* force, std::size_t next_order) const;

  /// Whether the law makes choices that may change.
  bool has_conditions() const { return !blocks_.program().conditions.empty(); }

  /// The first s in (0, most], in units of time, at which a choice of one of the elements would be made otherwise than at the
  /// beginning, becomes `most` and `first`. most becomes shorter, and `first` nothing, where the series of a condition, known
  /// up to `orders`, does not reach so far. of_known: coefficients from the first one on that is not finite say nothing of that.
  void find_change(int orders, T& most, std::optional<T>& first, bool of_known = false);

  /// The same for each element on its own: horizon(rows) is how far it is of interest, found(rows, s, is_change) where that is
  /// farther than s, up to which its choices are known. rows: those that are read of its participants.
  template <class Horizon, class Found>
  void find_changes(int orders, const Horizon& horizon, const Found& found);

  /// The sum of output 0 at order 0 over all elements.
  T sum(const MotionRows<T>& motion);

 private:
  /// The change of one condition in one lane of block b.
  void find_change_of(std::size_t b, std::size_t lane, const Program::Watched& condition, int orders,
                      bool of_known, T& most, std::optional<T>& first);
  explicit ElementBlocks(const ElementBlocks* all);

  /// The positions, velocities or separations of one participant; components that no rule reads go to waste.
  struct InputRows {
    Input::Kind kind;
    int participant, minus;
    std::array<std::optional<Place>, 3> component;
  };

  std::size_t first_block(std::size_t chunk) const {
    return std::min(chunk * Blocks<T>::blocks_of_a_chunk, blocks_.blocks());
  }
  const int* rows(std::size_t b, int participant) const {
    return &row_[(b * participants_ + participant) * blocks_.lanes()];
  }
  const int* pushed_rows(std::size_t b, int participant) const {
    return &pushed_row_[(b * participants_ + participant) * blocks_.lanes()];
  }
  template <class Read, class Pushed>
  void find_rows(std::span<const int> particles, std::span<const int> elements, const Read& read,
                 const Pushed& pushed);
  void run(std::size_t b, int k, int orders, const MotionRows<T>& motion);
  void gather(std::size_t b, int k, int n, const MotionRows<T>& motion);
  void add_rests(std::size_t b, const InputRows& input, const T* rest);

  int dimension_, participants_, given_;
  Blocks<T> blocks_;
  std::optional<Place> time_;
  std::vector<InputRows> inputs_;
  AlignedVector<T> waste_;
  std::vector<int> row_, pushed_row_;  // [block][participant][lane]: index of the participant's padded row
  AlignedVector<T> pushed_;         // [order][own row of a chunk][padded component]; empty if pushed directly
  std::vector<int> first_own_row_;  // of each chunk
  std::vector<int> own_rows_, first_of_particle_;  // the own rows of all chunks, particle by particle
};

// ---- definitions -----------------------------------------------------------------------------------------

namespace detail {
/// Shape (chosen, parameters of the law, then masses of the participants).
template <class T>
std::vector<T> parameters_with_masses(const std::vector<T>& mass, const Elements<T>& elements,
                                      std::span<const int> chosen) {
  const std::size_t width = elements.law.parameters.size(), p = elements.law.participants;
  std::vector<T> all;
  all.reserve(chosen.size() * (width + p));
  for (const std::size_t e : chosen) {
    for (std::size_t j = 0; j < width; ++j) all.push_back(elements.parameters[e * width + j]);
    for (std::size_t i = 0; i < p; ++i) all.push_back(mass[elements.particles[e * p + i]]);
  }
  return all;
}
}  // namespace detail

template <class T>
ElementBlocks<T>::ElementBlocks(int dimension, const std::vector<T>& mass, const Elements<T>& elements,
                                const Tape& tape, const KernelTable<T>& table, std::span<const int> chosen)
    : dimension_(dimension),
      participants_(elements.law.participants),
      given_(elements.law.given),
      blocks_(Program(tape), chosen.size(), detail::parameters_with_masses(mass, elements, chosen),
              table.fitting(chosen.size())) {
  for (const auto& [place, input] : blocks_.program().inputs) {
    if (input.kind == Input::Kind::time) {
      time_ = place;
      continue;
    }
    auto rows = std::ranges::find_if(inputs_, [&](const InputRows& known) {
      return known.kind == input.kind && known.participant == input.participant && known.minus == input.minus;
    });
    if (rows == inputs_.end()) rows = inputs_.insert(rows, {input.kind, input.participant, input.minus, {}});
    rows->component[input.component] = place;
  }
  find_rows(elements.particles, chosen, std::identity(), std::identity());
}

template <class T>
ElementBlocks<T>::ElementBlocks(const ElementBlocks* all)
    : dimension_(all->dimension_),
      participants_(all->participants_),
      given_(all->given_),
      blocks_(all->blocks_.program(), 0, {}, all->blocks_.table()),
      time_(all->time_),
      inputs_(all->inputs_) {}

template <class T>
ElementBlocks<T> ElementBlocks<T>::none_of(const ElementBlocks& all, int capacity) {
  ElementBlocks none(&all);
  none.reserve(capacity);
  return none;
}

template <class T>
template <class Read, class Pushed>
void ElementBlocks<T>::take(const ElementBlocks& all, std::span<const int> particles,
                            std::span<const int> elements, const KernelTable<T>& table, const Read& read,
                            const Pushed& pushed) {
  blocks_.take(all.blocks_, elements, table.fitting(elements.size()));
  find_rows(particles, elements, read, pushed);
}

template <class T>
template <class Read, class Pushed>
void ElementBlocks<T>::find_rows(std::span<const int> particles, std::span<const int> elements,
                                 const Read& read, const Pushed& pushed) {
  const int lanes = blocks_.lanes(), stride = padded(dimension_);
  if (waste_.size() < blocks_.chunks() * lanes) waste_.resize(blocks_.chunks() * lanes);
  row_.resize(blocks_.blocks() * participants_ * lanes);
  pushed_row_.resize(row_.size());
  for (std::size_t b = 0; b < blocks_.blocks(); ++b)
    for (int i = 0; i < participants_; ++i)
      for (int lane = 0; lane < lanes; ++lane) {
        const int particle = particles[elements[blocks_.element(b, lane)] * participants_ + i];
        const std::size_t r = (b * participants_ + i) * lanes + lane;
        row_[r] = read(particle) * stride;
        pushed_row_[r] = pushed(particle) * stride;
      }
}

template <class T>
std::vector<std::vector<int>> ElementBlocks<T>::push_apart(int particles) {
  const int lanes = blocks_.lanes(), stride = padded(dimension_);
  std::vector<std::vector<int>> touched(blocks_.chunks()), rows_of(particles);
  std::vector<int> own(particles, -1);
  first_own_row_.assign(1, 0);
  own_rows_.clear();
  int rows = 0;
  for (std::size_t chunk = 0; chunk < blocks_.chunks(); ++chunk) {
    const std::size_t begin = first_block(chunk) * participants_ * lanes,
                      end = first_block(chunk + 1) * participants_ * lanes;
    for (std::size_t r = begin; r < end; ++r) {
      const int particle = row_[r] / stride;
      if (own[particle] < 0) {
        touched[chunk].push_back(particle);
        rows_of[particle].push_back(rows);
        own[particle] = rows++;
      }
      pushed_row_[r] = (own[particle] - first_own_row_.back()) * stride;
    }
    for (int particle : touched[chunk]) own[particle] = -1;
    first_own_row_.push_back(rows);
  }
  first_of_particle_.assign(1, 0);
  for (const auto& of_particle : rows_of) {
    own_rows_.insert(own_rows_.end(), of_particle.begin(), of_particle.end());
    first_of_particle_.push_back(static_cast<int>(own_rows_.size()));
  }
  pushed_.resize(2 * static_cast<std::size_t>(rows) * stride);
  return touched;
}

template <class T>
void ElementBlocks<T>::push_together() {
  pushed_row_ = row_;
  pushed_.clear();
}

template <class T>
void ElementBlocks<T>::push(std::size_t chunk, int k, int orders, const MotionRows<T>& motion, T* force) {
  orders = running(k, orders);
  std::size_t next = motion.next_order;
  if (!pushed_.empty()) {
    force = pushed_.data() + static_cast<std::size_t>(first_own_row_[chunk]) * padded(dimension_);
    next = pushed_.size() / 2;
    const std::size_t size =
        static_cast<std::size_t>(first_own_row_[chunk + 1] - first_own_row_[chunk]) * padded(dimension_);
    for (int n = 0; n < orders; ++n) std::fill_n(force + n * next, size, T(0));
  }
  for (std::size_t b = first_block(chunk); b < first_block(chunk + 1); ++b) {
    run(b, k, orders, motion);
    const int* last = given_ < participants_ ? pushed_rows(b, given_) : nullptr;
    for (int n = 0; n < orders; ++n)
      for (int i = 0; i < given_; ++i) {
        std::array<const T*, 3> f{};
        for (int c = 0; c < dimension_; ++c)
          f[c] = blocks_.at(b, blocks_.program().outputs[i * dimension_ + c], k + n);
        blocks_.table().scatter(dimension_, blocks_.active(b), f.data(), pushed_rows(b, i), last,
                                force + n * next);
      }
  }
}

template <class T>
inline void ElementBlocks<T>::collect(int particle, int k, int orders, T* force,
                                      std::size_t next_order) const {
  const int stride = padded(dimension_);
  for (int n = 0; n < running(k, orders); ++n) {
    const T* pushed = pushed_.data() + n * (pushed_.size() / 2);
    T* to = force + n * next_order + static_cast<std::size_t>(particle) * stride;
    for (int e = first_of_particle_[particle]; e < first_of_particle_[particle + 1]; ++e)
      for (int c = 0; c < stride; ++c) to[c] += pushed[static_cast<std::size_t>(own_rows_[e]) * stride + c];
  }
}

/// Most conditions are far from a change: |c_0| > sum_{k>0} |c_k| h^k, and what follows on the last two terms is less than a
/// thousand of them.
template <class T>
void ElementBlocks<T>::find_change(int orders, T& most, std::optional<T>& first, bool of_known) {
  for (std::size_t b = 0; b < blocks_.blocks(); ++b)
    for (const auto& condition : blocks_.program().conditions) {
      const T* series = blocks_.at(b, condition.place, 0);
      const std::size_t next_order = orders > 1 ? blocks_.at(b, condition.place, 1) - series : 0,
                        active = blocks_.active(b);
      if (detail::outweighs_rest(series, next_order, active, orders - 1, most)) continue;
      for (std::size_t lane = 0; lane < active; ++lane) {
        if (detail::outweighs_rest(series + lane, next_order, 1, orders - 1, most)) continue;
        find_change_of(b, lane, condition, orders, of_known, most, first);
      }
    }
}

template <class T>
void ElementBlocks<T>::find_change_of(std::size_t b, std::size_t lane, const Program::Watched& condition,
                                      int orders, bool of_known, T& most, std::optional<T>& first) {
  const auto at = [&](Place place, int k) { return blocks_.at(b, place, k)[lane]; };
  find_first_change<T>(condition, at, orders, of_known, most, first);
}

template <class T>
template <class Horizon, class Found>
void ElementBlocks<T>::find_changes(int orders, const Horizon& horizon, const Found& found) {
  std::vector<int> of_element(participants_);
  for (std::size_t b = 0; b < blocks_.blocks(); ++b)
    for (int lane = 0; lane < blocks_.active(b); ++lane) {
      for (int i = 0; i < participants_; ++i) of_element[i] = rows(b, i)[lane] / padded(dimension_);
      const T all = horizon(of_element);
      if (!(all > T(0))) continue;
      T most = all;
      std::optional<T> first;
      for (const auto& condition : blocks_.program().conditions) {
        const T* series = blocks_.at(b, condition.place, 0);
        const std::size_t next_order = orders > 1 ? blocks_.at(b, condition.place, 1) - series : 0;
        if (detail::outweighs_rest(series + lane, next_order, 1, orders - 1, most)) continue;
        find_change_of(b, lane, condition, orders, false, most, first);
      }
      if (most < all || first) found(of_element, most, first.has_value());
    }
}

template <class T>
T ElementBlocks<T>::sum(const MotionRows<T>& motion) {
  T total(0);
  for (std::size_t b = 0; b < blocks_.blocks(); ++b) {
    run(b, 0, 1, motion);
    const T* e = blocks_.at(b, blocks_.program().outputs[0], 0);
    for (int lane = 0; lane < blocks_.active(b); ++lane) total += e[lane];
  }
  return total;
}

template <class T>
void ElementBlocks<T>::run(std::size_t b, int k, int orders, const MotionRows<T>& motion) {
  for (int n = 0; n < orders; ++n) gather(b, k + n, n, motion);
  blocks_.run(b, k, orders);
}

template <class T>
void ElementBlocks<T>::gather(std::size_t b, int k, int n, const MotionRows<T>& motion) {
  const int lanes = blocks_.lanes();
  T* waste = waste_.data() + b / Blocks<T>::blocks_of_a_chunk * lanes;
  if (time_)
    std::fill_n(blocks_.at(b, *time_, k), lanes, k == 0 ? motion.time : k == 1 ? motion.time_unit : T(0));
  for (const InputRows& input : inputs_) {
    std::array<T*, 3> to{};
    for (int c = 0; c < dimension_; ++c)
      to[c] = input.component[c] ? blocks_.at(b, *input.component[c], k) : waste;
    const T* from =
        (input.kind == Input::Kind::velocity ? motion.velocity : motion.position) + n * motion.next_order;
    const int* minus = input.kind == Input::Kind::separation ? rows(b, input.minus) : nullptr;
    blocks_.table().gather(dimension_, from, rows(b, input.participant), minus, to.data());
    if (k == 0 && motion.position_rest && minus) add_rests(b, input, motion.position_rest);
  }
}

/// A separation of order 0 gains the difference of what the positions have beyond the number.
template <class T>
void ElementBlocks<T>::add_rests(std::size_t b, const InputRows& input, const T* rest) {
  const int *plus = rows(b, input.participant), *minus = rows(b, input.minus);
  for (int c = 0; c < dimension_; ++c)
    if (input.component[c])
      for (int lane = 0; lane < blocks_.lanes(); ++lane)
        blocks_.at(b, *input.component[c], 0)[lane] += rest[plus[lane] + c] - rest[minus[lane] + c];
}

extern template class ElementBlocks<double>;

}  // namespace jetlag
