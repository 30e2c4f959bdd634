// SPDX-License-Identifier: MIT
#pragma once
// The barriers of a surface along a motion.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contact/region.hpp"
#include "jetlag/contact/approach.hpp"
#include "jetlag/contact/candidates.hpp"
#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/model/changing_elements.hpp"

namespace jetlag {

namespace barrier_switch {

/// Part of the thickness by which a gap must be below it, or above, before the barrier is turned on, or off.
constexpr double hysteresis = 1e-6;
/// Who has come so near to a switch at the end of a step that rounding decides, is beyond it: part of that way.
constexpr double arrived = 0.999;
/// How far beyond its border a region still holds, in parts of the features.
constexpr double band = 1e-8;
/// Of |e1 x e2|^2 / (|E1|^2 |E2|^2), E at rest: below the first, edges are nearly parallel, and their barrier is times a factor that
/// vanishes with the angle; below the second that is 2e-13, and they have none.
constexpr double nearly_parallel_below = 1e-3, parallel_below = 1e-16;

/// By how much times that mean one moment may differ [s].
inline double rounding_of_time(double now) {
  return 8 * std::numeric_limits<double>::epsilon() * std::abs(now);
}

/// |e1 x e2|^2 of two edges.
template <class T>
T squared_sine(std::span<const Vector3<T>> x) {
  const Vector3<T> n = detail::cross<T>(x[1] - x[0], x[3] - x[2]);
  return dot(n, n);
}

}  // namespace barrier_switch

class BarrierAlong final : public ElementsAlong {
 public:
  BarrierAlong(std::shared_ptr<const ContactBarrier> contact, const Model<double>& model,
               std::size_t first_law);

  bool begin(const State<double>& state, Model<double>& model) override;
  double up_to_change(const PositionSeries& position, double h, Report& report) override;
  bool is_safe(const PositionSeries& position, double h, bool is_given, Report& report) override;
  void take(double h, const Coordinates<double>& position) override;
  bool follows_clocks() const override { return true; }
  bool change(const MotionAhead& motion, std::span<const int> due, Model<double>& model) override;
  bool find_changes(const MotionAhead& motion, std::span<const int> updated,
                    std::vector<ShorterStep>& shorter, Report& report) override;
  std::unique_ptr<ElementsAlong> clone() const override { return std::make_unique<BarrierAlong>(*this); }

 private:
  /// How the edges of a pair lie: in general, nearly parallel, or so much so that others carry their load.
  enum class Lie { any, nearly_parallel, parallel };

  /// What a step comes to: a pair turns on or off, or another region is the nearest, or edges lie otherwise.
  enum class Change { none, on, off, region };

  /// A candidate, and whether it acts.
  struct Pair {
    Stencil stencil;
    bool is_on = false;
    Support support = 0;
    Lie lie = Lie::any;
    bool is_near = false;  // whether it was looked at closely in the last step
    Change change = Change::none;
    double time = 0;  // of the change, in the step that was looked at last [s]
    double safe_until =
        -std::numeric_limits<double>::infinity();  // [s]: until then tracks and rooms keep it from turning on
    std::uint64_t look = 0;                        // the last one, where particles have clocks of their own
  };

  using Places = std::array<Vector3<double>, 4>;

  void start(const State<double>& state);
  void take_candidates();
  void list_pairs_of_particles();
  bool make_elements(Model<double>& model) const;
  void update(Pair& pair, const Places& x, Change change) const;
  bool acts_otherwise(Pair pair, const Places& x) const;
  bool update_noting(Pair& pair, const Places& x, Change change);
  Report underflow(const Pair& pair, double time) const;

  double up_to_change(Pair& pair, const MotionAhead& motion, double h);
  double up_to_other_region(Pair& pair, const MotionAhead& motion, double h) const;
  bool is_far(Pair& pair, double now, double h) const;
  void wake_pairs(double end);
  double gap_of(double distance) const { return distance - contact_->gap; }
  std::optional<double> first_approach(const Stencil& stencil, const MotionAhead& motion, double h,
                                       double reach);
  double parallel_below(const Stencil& stencil) const;
  void foresee(const MotionAhead& motion, double h);
  void record_changes();
  void record_gap(const Stencil& stencil, double gap, double time);
  void record_step(double h, const Coordinates<double>& position);

  std::shared_ptr<const ContactBarrier> contact_;
  int dimension_;
  std::size_t first_law_;
  Candidates candidates_;
  std::uint64_t looks_ = 0;  // of the candidates, when the pairs were made
  std::vector<Pair> pairs_;  // ascending
  std::vector<int>
      awake_;  // on one clock, those of the last step that tracks and rooms do not keep apart; ascending
  std::vector<std::pair<double, int>> asleep_;  // the others, a heap: until when [s], the first on top
  Approach approach_;
  Coordinates<double> left_at_;
  double time_ = 0;                       // at which the last step begins [s]
  bool is_changed_ = true;                // whether pairs act otherwise than in the model
  std::vector<int> first_of_, pairs_of_;  // of each particle, the pairs that it is in; empty on one clock
  std::vector<bool> is_due_;              // in `change`
  std::uint64_t look_ = 0;
  double aim_ =
      1;  // how far beyond a switch a search aims; with clocks twice, so that who is beyond it has arrived

  // For the record (barrier_record.cpp).
  struct Foreseen {
    double gap = std::numeric_limits<double>::infinity();  // [m]
    double time = 0, begin = 0;                            // [s]: in the step, and its beginning
    Stencil stencil{};
  };
  Foreseen foreseen_;                        // the smallest gap of the step that was looked at last
  std::uint64_t tested_ = 0, searched_ = 0;  // not yet in the record
  std::uint64_t looks_recorded_ = 0;
  std::vector<Stencil> active_;  // after the last step, ascending
};

}  // namespace jetlag
