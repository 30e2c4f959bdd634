// SPDX-License-Identifier: MIT
#pragma once
// The barriers of a surface along a motion.

#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "contact/region.hpp"
#include "jetlag/contact/approach.hpp"
#include "jetlag/contact/candidates.hpp"
#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/model/changing_elements.hpp"

namespace jetlag {

class BarrierAlong final : public ElementsAlong {
 public:
  BarrierAlong(std::shared_ptr<const ContactBarrier> contact, const Model<double>& model,
               std::size_t first_law);

  bool begin(const State<double>& state, Model<double>& model) override;
  double up_to_change(const PositionSeries& position, double h, Report& report) override;
  bool is_safe(const PositionSeries& position, double h, bool is_given, Report& report) override;
  void take(double h, const Coordinates<double>& position) override;
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
  };

  void start(const State<double>& state);
  void require_apart(const State<double>& state) const;
  void take_candidates();
  bool make_elements(Model<double>& model) const;
  void update(Pair& pair, const Coordinates<double>& position, Change change) const;
  double up_to_change(Pair& pair, const PositionSeries& position, double h);
  double up_to_other_region(Pair& pair, const PositionSeries& position, double h) const;
  double gap_of(double distance) const { return distance - contact_->gap; }
  double distance_at_start(const Stencil& stencil, const PositionSeries& position) const;
  std::optional<double> first_approach(const Pair& pair, const PositionSeries& position, double h,
                                       double reach);
  double stray(const Pair& pair, const PositionSeries& position, double h) const;
  double parallel_below(const Stencil& stencil) const;
  std::string names(const Stencil& stencil) const;
  void foresee(const PositionSeries& position, double h);
  void record_step(double h, const Coordinates<double>& position);

  std::shared_ptr<const ContactBarrier> contact_;
  int dimension_;
  std::size_t first_law_;
  Candidates candidates_;
  std::uint64_t looks_ = 0;  // of the candidates, when the pairs were made
  std::vector<Pair> pairs_;  // ascending
  Approach approach_;
  Coordinates<double> left_at_;
  bool is_changed_ = true;  // whether pairs act otherwise than in the model

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
