// SPDX-License-Identifier: MIT
#pragma once
// What a run keeps of its frames: the energies, the last good state, and what is wrong with the first that is not.

#include <optional>
#include <vector>

#include "jetlag/contact/contact_meter.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/runs/run_scene.hpp"

namespace jetlag {

/// Hands out the frames, and keeps the table of energies, up to the first state that has none.
class Recorder {
 public:
  /// Records the initial state. Keeps references.
  Recorder(const Scene& scene, const RunHooks& hooks, RunResult& result);

  /// The times of all frames but the first [s].
  std::vector<double> times() const;

  /// A frame.
  void record(const State<double>& state);
  /// The state where a run has ended early, unless it is a frame already.
  void last_good(const State<double>& state) {
    if (state.time > last_.time) record(state);
  }

  /// What the energies say against the method becomes a warning of the summary, and elements that were inside out.
  void judge() const;

  /// What is wrong with the first state that was not recorded; success where all were.
  const Report& failure() const { return failure_; }
  /// The last state that was recorded.
  const State<double>& last() const { return last_; }

 private:
  EnergyRow measured(const State<double>& state);
  void keep(const EnergyRow& row);
  void judge_energy() const;
  void judge_deformation() const;

  const Scene& scene_;
  const RunHooks& hooks_;
  RunResult& result_;
  std::optional<EnergyMeter> meter_;
  std::optional<DeformationMeter> deformation_;
  std::optional<ContactMeter> contact_;
  double largest_kinetic_ = 0, largest_change_ = 0;  // [J]
  State<double> last_;
  Report failure_;
};

}  // namespace jetlag
