// SPDX-License-Identifier: MIT
#pragma once
// What the members of an ensemble amount to at a frame.

#include <functional>
#include <vector>

#include "base/pool.hpp"
#include "jetlag/base/workers.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/output/ensemble_table.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {

/// The components of the positions of moving particles, of their velocities where asked for, and the energy where the
/// scene asks for it.
std::vector<Quantity> quantities_of(const Scene& scene, bool velocities);

class EnsembleStatistics {
 public:
  using StateOf = std::function<State<double>(std::size_t member)>;

  /// Keeps a reference to the system.
  EnsembleStatistics(const System<double>& system, std::vector<Quantity> quantities, Workers workers)
      : system_(system), quantities_(std::move(quantities)), workers_(std::move(workers)) {}

  const std::vector<Quantity>& quantities() const { return quantities_; }

  /// Of some members. reference: null where it is not known.
  EnsembleFrame at(double time, const std::vector<std::size_t>& members, const StateOf& state_of,
                   const State<double>* reference);

  /// Root mean square of a state - the reference of a frame over the positions [m].
  double error(const EnsembleFrame& frame, const State<double>& state) const;

 private:
  bool is_position(std::size_t q) const {
    return quantities_[q].particle >= 0 && !quantities_[q].of_velocity;
  }
  template <class Put>
  void values(const State<double>& state, const Put& put);
  Calibration calibration(const EnsembleFrame& frame) const;

  const System<double>& system_;
  std::vector<Quantity> quantities_;
  Workers workers_;
  std::vector<double> values_;  // [quantity][member]
  Pool<EnergyMeter> meters_;
};

}  // namespace jetlag
