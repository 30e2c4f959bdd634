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
//
// Of a single element the law itself may be the kernel, for all orders at once (motion/unrolled_motion.hpp).
//
// Time may be counted in a unit u of its own: coefficients are then those of powers of (t - t_0) / u, that is x_k u^k,
// and with a power of two their digits are the same. Fast and slow motions need it: of q'' = -w^2 q coefficient 20 is
// some w^20, beyond the range of a double for w = 1e16 and 1e-16.

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "jetlag/base/accelerate.hpp"
#include "jetlag/base/workers.hpp"
#include "jetlag/model/model.hpp"
#include "jetlag/motion/coefficient_view.hpp"
#include "jetlag/motion/coefficients.hpp"
#include "jetlag/motion/unrolled_motion.hpp"
#include "jetlag/motion/wavefront.hpp"
#include "jetlag/series/calculus/row_sums.hpp"

namespace jetlag {

template <class T>
class Expansion {
 public:
  using Number = T;

  /// expected_degree: storage is made for it; growing beyond it costs a copy. The number of workers does not change a bit
  /// of the result.
  explicit Expansion(const Model<T>& model, int expected_degree = 8,
                     const KernelTable<T>& table = kernels<T>(), Workers workers = Workers(1));

  /// Goes on with another epoch of the model; a start comes next. Laws whose elements are the same keep what they have.
  void move_to(const Model<T>& model);

  /// Starts anew from a state: coefficients 0 and 1 of x are known. Shapes (particles, dimension).
  /// time_unit [s]: finite and not 0. A negative one leads backwards: choices are those of the time before.
  /// Throws std::invalid_argument for a state of another shape and for a fixed particle that is not at rest.
  void start(const State<T>& state, const T& time_unit = T(1));

  /// Starts anew from the same state, in another unit of time. Throws std::invalid_argument as start.
  void restart(const T& time_unit);

  /// The highest order of x that is known, >= 1.
  int order() const { return order_; }
  const T& time() const { return time_; }
  const T& time_unit() const { return time_unit_; }
  int particles() const { return particles_; }
  int dimension() const { return dimension_; }

  /// One more order.
  void grow() { grow_to(order_ + 1); }

  void grow_to(int order);

  /// Coefficient k of the positions, times time_unit^k, k <= order().
  CoefficientView<T> position(int k) const { return view(x_, k); }
  /// Coefficient k of the velocities [m/s], times time_unit^k, k <= order() - 1.
  CoefficientView<T> velocity(int k) const { return view(v_, k); }

  /// The largest absolute component of coefficient k of the positions, and of the velocities; not finite if one is not.
  T position_norm(int k) const { return norm(x_, k); }
  T velocity_norm(int k) const { return norm(v_, k); }
  T norm(int k) const { return position_norm(k); }
  /// The largest absolute component of coefficient k of the position of a particle.
  T norm_of(std::size_t particle, int k) const {
    return position(k).row(static_cast<Eigen::Index>(particle)).cwiseAbs().maxCoeff();
  }

  /// sum_{n=first..last} w_n c_n s^(n-first), by Horner's rule, c_n the coefficients of the positions or the velocities.
  /// w: the weights of the terms 0 .. last. into: shape (particles, dimension).
  void position_sum(int first, int last, const T* w, const T& s, Coordinates<T>& into) const;
  void velocity_sum(int first, int last, const T* w, const T& s, Coordinates<T>& into) const;

  /// Both from order 0, and the accelerations to which the positions lead,
  /// time_unit^2 a = sum_{n=2..last} n (n-1) w_n x_n s^(n-2), in padded rows; all with the bits of each alone, in a third of the
  /// time. Returns whether positions and velocities are finite.
  bool motion_sum(int last, const T* w, const T& s, Coordinates<T>& position, Coordinates<T>& velocity,
                  AlignedVector<T>& leads_to) const;

  /// Terms w_n c_n of the positions and the velocities up to order last < order().
  void weighted_series(int last, const T* w, Coefficients& position, Coefficients& velocity) const
    requires std::same_as<T, double>;

  /// Coefficients 0 .. last of the positions, last <= order(), and of the velocities, last < order(), where they stand: until the
  /// series starts anew or grows.
  CoefficientsView position_series(int last) const
    requires std::same_as<T, double>
  {
    return {x_.data(), static_cast<std::size_t>(last + 1), particles_, dimension_, stride_};
  }
  CoefficientsView velocity_series(int last) const
    requires std::same_as<T, double>
  {
    return {v_.data(), static_cast<std::size_t>(last + 1), particles_, dimension_, stride_};
  }

  /// A bound of how far each particle goes from a straight line: sum_{n=2..last} |c_n| s^n, |.| the sum of the components
  /// of the positions' coefficients.   into: shape (particles).
  void curve(int last, const T& s, std::vector<T>& into) const;

  /// Begins the series from another state, up to an order of 2 or 3, and counts its work as that of a start from this state,
  /// which then goes on from here. The series that is there can still be read, but it grows no more.
  void look_ahead(const State<T>& state, int order);

  /// Goes on elsewhere: what has been seen ahead is not used, nor counted.
  void forget_ahead();

  /// How the forces ahead depart from those to which the series leads at its sum
  /// sum_{n<=last} w_n x_n s^n, the state ahead. All are largest components, in the unit of time of the series.
  using Departure = RowDeparture<T>;
  /// w: weights of the terms 0 .. last of the positions. Of the particles from first to before end.
  void take_departure(int last, const T* w, const T& s, int first, int end, Departure& departure) const;
  /// leads_to: of motion_sum.
  void take_departure(const AlignedVector<T>& leads_to, int first, int end, Departure& departure) const;

  /// Whether a force makes choices that may change; see forces/force.hpp.
  bool has_conditions() const;
  /// The first s in (0, h], in units of time, at which a choice that was made at the start would be made otherwise; nothing if
  /// there is none. h becomes shorter where the series of a condition does not reach so far.
  /// of_known: as far as the coefficients say that are known where others are not finite.
  std::optional<T> first_change(T& h, bool of_known = false);

  /// The same for each element on its own, see ElementBlocks::find_changes; rows are the numbers of particles.
  template <class Horizon, class Found>
  void find_changes(const Horizon& horizon, const Found& found) {
    for (auto& law : laws_)
      if (law.count() > 0 && law.has_conditions()) law.find_changes(order_ - 1, horizon, found);
  }

  /// (element, order) pairs known since construction, each counted once: the honest unit of cost. Those of a state ahead count when a
  /// start has gone on from there, or elsewhere.
  std::size_t element_coefficients() const { return element_coefficients_ - ahead_.element_coefficients; }

  /// Memory held for series, in bytes.
  std::size_t bytes() const;

 private:
  std::size_t row_size() const { return static_cast<std::size_t>(particles_) * stride_; }
  T* at(AlignedVector<T>& series, int k) { return series.data() + k * row_size(); }
  CoefficientView<T> view(const AlignedVector<T>& series, int k) const;
  T norm(const AlignedVector<T>& series, int k) const;
  /// Rows of coordinates in padded rows, and back: `count` rows from the first one on.
  void unpad(const T* padded, std::size_t first, std::size_t count, Coordinates<T>& rows) const;
  void pad(const Coordinates<T>& rows, T* to) const;
  bool pads(const Coordinates<T>& rows, const T* padded) const;
  void begin(const State<T>& state, const T& time_unit);
  bool is_ahead(const State<T>& state, const T& time_unit) const;
  void go_ahead(const T& time);
  void swap_ahead();

  /// Eight numbers at a time go through all orders.
  void sum(const AlignedVector<T>& series, int first, int last, const T* w, const T& s,
           Coordinates<T>& into) const;

  MotionRows<T> motion(int k) {
    return {at(x_, k), at(v_, k), row_size(), time_, time_unit_, rest_.empty() ? nullptr : rest_.data()};
  }
  void count(const std::vector<ElementBlocks<T>*>& laws, int k, int orders);

  /// From coefficient k of the forces, in the rows of the new positions, to x_{k+2} and v_{k+1}.
  void accelerate(std::size_t first, std::size_t last, int k);

  static constexpr int orders_ahead = 3;  // look_ahead knows at most so many
  static constexpr std::size_t chunks_of_a_small_scene = 4;
  /// What stays in a third-level cache of 32 MiB beside the motion and what else uses it: 200 x 200 particles of a cloth
  /// have 12 MiB under way at degree 16 and took 1.3 times as long a spring as 50 x 50, 300 x 300 twice as long.
  static constexpr std::size_t bytes_in_cache = std::size_t{12} << 20;

  /// One or two orders more. The rows of the new positions hold the forces until they are complete.
  void grow_by(int orders);

  // ---- a single element ----------------------------------------------------------------------------------------

  /// Whether the series grows by the kernel of its law. What positions have beyond a number only tapes know.
  bool is_unrolled() const { return unrolled_.exists() && rest_.empty() && !is_rolled_up_; }
  void unroll_to(int order);
  /// From its tape to the end, for orders that the kernel does not have; the series becomes what it would have been from the tape.
  void roll_up();

  // ---- large scenes: chunk by chunk ------------------------------------------------------------------------

  struct Chunk {
    ElementBlocks<T>* blocks;
    std::size_t number;
    std::vector<int> last_of;  // the particles that no later chunk touches
    bool is_replayed = false;  // whether its histories are lost
  };

  /// The blocks of a law, over the elements that it has now.
  void take(const typename Model<T>::Law& law, ElementBlocks<T>& blocks);

  /// Which laws act. Where one needs more than one chunk, all laws push chunk by chunk, in the order of the particles they
  /// touch.
  void arrange();
  void push_apart();

  /// Histories from here on: all, or only those of chunks under way and of laws with conditions, whose series are read later.
  /// Those that are lost follow from the motion once more, with the same bits. It is done for the orders that were looked at
  /// ahead; a scene whose series is grown further piece by piece keeps all from then on.
  void keep_histories(bool keep);
  void find_lost_histories();

  /// What comes before the first pass of a chunk, from order `first` of its forces on.
  void begin_chunk(const Chunk& chunk, int first);

  /// Grows to an order: in one sweep, or where the histories under way would not stay in the cache in two, of which the second
  /// one, with half as many passes, computes a quarter of the terms once more.
  void sweep_to(int order);

  /// Grows to an order in passes of two orders, or of one where a force depends on velocities.
  void sweep(int order);
  int orders_of_a_pass() const { return with_velocity_.empty() ? 2 : 1; }

  /// The histories of chunks that are under way at the same time, at most.
  std::size_t bytes_under_way(int passes) const;

  /// Adds up what the chunks have pushed onto a particle.
  void complete(int particle, int k, int orders);

  void reserve(int degree);

  Model<T> model_;
  const KernelTable<T>* table_;
  int particles_, dimension_, stride_;
  Workers workers_;
  std::vector<T> inverse_mass_;         // one a padded component; 0 for fixed particles
  std::vector<T> push_;                 // the same times the unit of time
  std::vector<ElementBlocks<T>> laws_;  // of the model
  std::vector<ElementBlocks<T>*> without_velocity_, with_velocity_;  // those that act
  int expected_degree_;
  UnrolledMotion<T> unrolled_;  // of a single element, where its orders are those that are expected
  bool is_rolled_up_ = false;   // whether the series has gone on beyond them
  std::vector<Chunk> chunks_;   // of large scenes
  std::size_t chunks_between_passes_ = 0;  // that a pass is behind the one before, at most
  std::unique_ptr<Wavefront> wavefront_;   // over the chunks; null for small scenes
  T time_{}, time_unit_{1};
  int order_ = 1, capacity_ = 0;
  AlignedVector<T> x_, v_;  // [order][particle][padded component]
  AlignedVector<T> rest_;   // what the positions of order 0 have beyond the number; empty if nothing
  std::size_t element_coefficients_ = 0;

  struct Ahead {
    bool is_known = false;
    AlignedVector<T> x, v, rest;  // as x_, v_, rest_
    T time{};
    int order = 1;
    bool is_rolled_up = false;
    std::size_t element_coefficients = 0;
  };
  Ahead ahead_;
  bool elements_are_ahead_ = false;  // whether their histories are those of a state ahead
};

extern template class Expansion<double>;

}  // namespace jetlag

#include "jetlag/motion/expansion_definitions.hpp"
