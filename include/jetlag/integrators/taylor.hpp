// SPDX-License-Identifier: MIT
#pragma once
// Taylor's method: fixed degree, or a degree drawn anew at every step.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "jetlag/control/to_kinks.hpp"
#include "jetlag/integrators/integrator.hpp"
#include "jetlag/integrators/short_step.hpp"
#include "jetlag/integrators/step_check.hpp"
#include "jetlag/integrators/steps_to_changes.hpp"
#include "jetlag/integrators/stopped_series.hpp"
#include "jetlag/model/changing_elements.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/sequential.hpp"
#include "jetlag/truncation/truncation.hpp"
#include "jetlag/truncation/velocity_series.hpp"

namespace jetlag {

/// The paper's method: the series is stopped at a random degree K and weighted so that it stays unbiased,
///     y(t + h) = sum_{n=0..K} w_n y_n h^n,   w_n = 1 / P(K >= n).
/// Mean-square order min(N, m + 1/2), weak order min(N, 2m + 1), for y = (x, v) with `own_series`.
/// With a fixed degree all weights are 1: Taylor's method of order N.   Source: [MX], with its weights corrected.
///
/// A sequential law sees the sizes of the terms of the positions, the largest component [m] of all particles or, with a
/// draw for each, of its particle; it is asked after each order, and no order is computed that is not needed. Where the
/// control reads the series, all are. What a control learns of a sequential law is its lower bound.
///
/// Steps that a control chooses end at kinks of forces (control/to_kinks.hpp), and all steps where a choice in a force changes
/// (forces/force.hpp); 100 of these in a row of next to no length, as of a motion that slides along a jump of the force, or
/// 10000 that end without a change before 2^-40 of the step that is asked for, end the run as step_underflow.
///
/// The forces at the end of a step, with which the next one begins, must be those to which its series leads (step_check.hpp):
/// steps that a control chooses are halved until they are; where none is short enough the report is step_underflow. Of steps
/// that are given `warning` says what it makes of them. Velocities from the derivative of a position that may have degree 1
/// are not checked.
///
/// Elements that come and go (model/changing_elements.hpp): steps that a control chooses end where they change, seen from the
/// series up to the largest degree of the law; steps that are given have those of their beginning. Where a step, as it is drawn,
/// would lead something through something, it is halved; one that is given is `contradicted`.
///
/// Where the series of some particles have no more than their first coefficients, 2 at least, as those of a force |v| v have at
/// rest, a step uses what there is, with weights 1 whatever the law, and is so short that the forces within it and at its end
/// are those to which this leads (short_step.hpp). At its end there must be whole series again, of all particles but those
/// that stay at rest; otherwise the report is non_finite. Steps that are given, or chosen without a look at the series, do so
/// for a fixed degree only.
class RandomTaylor final : public Integrator {
 public:
  struct Options {
    std::uint64_t seed = 1;

    /// One K for all particles at each step: conserves momentum exactly, and orders above K are not computed.
    /// Otherwise one K for each particle, and all orders up to the largest of them are computed.
    bool shared_draw = true;

    VelocitySeries velocity = VelocitySeries::own_series;

    /// Adds the increments of a step to positions and velocities in compensated sums, whose rests the state carries
    /// along: over many steps that are accurate to rounding, the error becomes some six times smaller.
    bool compensated = false;

    /// Threads that expand a large scene, >= 1; the result does not depend on their number.
    int threads = 1;

    /// How the draws of different steps (and particles, for `stratified`) go together.
    Draw draws = Draw::independent;
  };

  RandomTaylor(const System<double>& system, Truncation law, std::unique_ptr<Control> control)
      : RandomTaylor(system, std::move(law), std::move(control), Options{}) {}
  /// Throws std::invalid_argument for compensated sums of a velocity whose first coefficient is random: a law with
  /// min_degree 0 and `derivative`; for draws that do not go with the law, see Draws; for a draw for each particle where
  /// elements come and go.
  RandomTaylor(const System<double>& system, Truncation law, std::unique_ptr<Control> control,
               Options options);

  double step(State<double>& state, double limit, Report& report) override;
  Piece piece() const override;
  PieceView motion() const override;
  const Work& work() const override { return work_; }
  std::string warning() const override { return ledger_.warning(); }
  std::optional<CourantFrequency> courant_frequency() const override { return control_.courant_frequency(); }

  /// What a trajectory has of its own besides its state.
  struct Member : ToKinks::Trajectory {
    std::uint64_t seed = 1, update = 0;  // of the draws
    StepsToChanges<double> changes{};
  };
  /// Goes on as another trajectory of the same system; `member` is then the one so far. The work is that of all.
  void exchange(Member& member);

 private:
  void begin(const State<double>& state);
  bool is_stuck(double time, Report& report);
  double accept(State<double>& state, double h);
  double up_to_change(double h);
  double up_to_other_elements(double h, Report& report);
  bool is_safe(double h, Report& report);
  PositionSeries series_of_positions(int last, const double* weights) const;
  bool end(const State<double>& from, double h, Report& report);
  bool agrees_with_forces(const State<double>& from, double h);
  bool agrees_but_for_kinks(double h) const;
  StepDefect defect_at_end(const State<double>& from, double h);
  StepDefect defect_of(const Expansion<double>::Departure& departure, double h) const;
  void take_departure(double s, int first, int end, Expansion<double>::Departure& departure) const;
  bool is_allowed(const StepDefect& defect) const;
  double left_out(const StepDefect& defect) const;
  double ratio_of_orders(const StepDefect& defect) const;
  bool add_to_ledger(const State<double>& from, const StepDefect& defect);
  int most_departed(double h) const;
  bool sum(const State<double>& from, double h, State<double>& to);
  void add_increments(State<double>& state, double s) const;
  void weighted_sum(bool of_velocity, double s, int first, Coordinates<double>& sum) const;
  void count();

  // Steps from singular points: src/integrators/short_step.cpp.
  double short_step(State<double>& state, double limit, const StepsToChanges<double>& changes,
                    Report& report);
  bool find_known();
  bool agrees_all_along(const State<double>& from, double h, ShortStepBound& bound);
  bool agrees_at(const State<double>& from, double h, ShortStepBound& bound);
  int first_stopped(const State<double>& from, double h);
  std::vector<bool> resting(const Coordinates<double>& velocity) const;
  int least_known() const;
  void sum_of_known(bool of_velocity, double s, int first, Coordinates<double>& sum) const;
  void take_departure_of_known(double s, int first, int end, Expansion<double>::Departure& departure) const;
  Piece piece_of_known() const;

  const Expansion<double>& expansion() const { return series_.series(); }
  const Stops& stops() const { return series_.stops(); }

  RandomTaylor(ModelAlong along, Truncation law, std::unique_ptr<Control> control, Options options);

  Options options_;
  ModelAlong along_;  // the elements that there are
  StoppedSeries<Expansion<double>> series_;
  ToKinks control_;
  std::vector<int> known_;  // the orders of each particle in a step from a singular point; empty in others
  StepsToChanges<double> changes_;
  std::vector<bool> fixed_;
  int moving_;
  State<double> next_;  // room for the state at the end of a step
  struct Foreseen {
    std::optional<double> at;  // the time of the last sum, in units of the series, if they come from it
    AlignedVector<double> accelerations;  // to which the series leads there, see Expansion::motion_sum
  };
  Foreseen foreseen_;
  std::uint64_t update_ = 0;
  double last_step_ = 0, proposed_ = 0;
  int ahead_;  // orders that every step needs
  DefectLedger ledger_;
  struct Explained {
    double force = 0, ratio = 1;  // a defect that the terms explain, and its ratio_of_orders
    int steps = 16;               // ago
  };
  Explained explained_;  // in steps that are given
  Work work_;
};

/// Taylor's method of a fixed degree N >= 1:  y(t + h) = sum_{n=0..N} y_n h^n, of order N.   Source: [JZ05].
/// options: those of a random degree that mean something here, as `compensated` and `threads`. Throws as RandomTaylor.
std::unique_ptr<Integrator> taylor(const System<double>& system, int degree, std::unique_ptr<Control> control,
                                   const RandomTaylor::Options& options = RandomTaylor::Options());

}  // namespace jetlag
