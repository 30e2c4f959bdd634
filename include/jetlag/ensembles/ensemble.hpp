// SPDX-License-Identifier: MIT
#pragma once
// Ensembles: many trajectories of one system from different initial states, one in each lane of the processor.
//
//   Ensemble ensemble(system, 20, states);
//   ensemble.advance_to(10.0);
//   ensemble.state(7).position;
//
// The whole system is one tape (model/system_tape.hpp), a trajectory is an element of it, and every trajectory has a
// time and a step of its own. Trajectories are taken through all their steps block by block, so that their series stay
// in the cache; different blocks may run at the same time.

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/base/workers.hpp"
#include "jetlag/integrators/steps_to_changes.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag {

struct SystemLanes;

/// Taylor's method of a fixed degree with the step of Jorba and Zou (control/jorba_zou.hpp), as `taylor` with `JorbaZou`,
/// to rounding. A trajectory has the same bits in any company and for any number of workers, as long as the blocks
/// have the same width. Time is counted in seconds: of motions of less than 1e-15 radians a second coefficient 20 is below
/// doubles, and their trajectories are stepped by what is left.
///
/// A trajectory takes a step by itself, as RandomTaylor does, where its series is not finite, where a choice in a force may
/// change (forces/force.hpp), or where the forces at the end of its step do not plainly agree with the series, whose step is
/// then taken anew:
///
///     h^2 |a - x''|  <=  2^16 eps max(|x|, m) + 16 N e^(-2(N-1)) m,   m = max(h |v|, h^2 |a|) at the beginning.
///
/// Hand-written kinks of forces are not looked for: springs may be stepped over where their ends meet exactly, floors are
/// refused.
class Ensemble {
 public:
  /// Keeps no reference to the system. degree: >= 1. states: one for each trajectory; their rests are dropped, their
  /// times may differ. max_step [s]: > 0, may be infinite.
  /// Throws std::invalid_argument for what is out of range, for a state of another shape, for a fixed particle that is
  /// not at rest, and for forces whose kinks are more than points, such as floors (model/kinks.hpp).
  Ensemble(const System<double>& system, int degree, const std::vector<State<double>>& states,
           double max_step = std::numeric_limits<double>::infinity(), Workers workers = Workers(1))
      : Ensemble(system, degree, states, max_step, std::move(workers),
                 kernels<double>().fitting(states.size())) {}
  /// The same on blocks of a chosen width.
  Ensemble(const System<double>& system, int degree, const std::vector<State<double>>& states,
           double max_step, Workers workers, const KernelTable<double>& table);

  /// Every trajectory that is before `until` [s] goes there, its last step shortened to end there. One that fails keeps
  /// the state before the step that failed, says so in `outcome`, and goes no further; the others do not notice.
  /// Throws std::invalid_argument for a time that is not finite.
  void advance_to(double until);

  std::size_t size() const { return count_; }
  int lanes() const { return table_->lanes; }
  State<double> state(std::size_t i) const;
  /// success, step_underflow or non_finite.
  Outcome outcome(std::size_t i) const { return outcome_[i]; }
  std::uint64_t steps(std::size_t i) const { return steps_[i]; }
  /// Those of the steps that a trajectory has taken by itself.
  std::uint64_t lone_steps(std::size_t i) const { return lone_steps_[i]; }

  /// The steps of all trajectories.
  std::uint64_t steps() const;
  /// (element, order) pairs of these steps: elements x degree for each, idle lanes not counted.
  std::uint64_t element_coefficients() const;

 private:
  struct Workspace;

  struct Workspaces;

  std::size_t blocks() const;
  double* rows(AlignedVector<double>& of, std::size_t block) const;
  void advance(std::size_t block, double until, Workspace& work);
  void choose_steps(Workspace& work) const;
  void load(std::size_t block, Workspace& work) const;
  bool check_ends(std::size_t block, double until, Workspace& work);
  void find_choices(std::size_t block, double until, Workspace& work);
  void step_alone(std::size_t block, int lane, double until, Workspace& work);

  std::shared_ptr<const SystemLanes> system_;
  std::shared_ptr<const System<double>> alone_;  // the same, for steps that are not taken in lanes
  int degree_;
  std::size_t count_;
  double max_step_;
  Workers workers_;
  std::shared_ptr<Workspaces> workspaces_;
  const KernelTable<double>* table_;
  AlignedVector<double> position_, velocity_, time_;  // [block][component][lane], time [block][lane]
  std::vector<Outcome> outcome_;
  std::vector<std::uint64_t> steps_, lone_steps_;
  std::vector<StepsToChanges<double>> changes_;
};

}  // namespace jetlag
