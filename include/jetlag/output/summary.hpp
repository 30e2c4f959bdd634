// SPDX-License-Identifier: MIT
#pragma once
// What a run amounts to: the content of summary.json.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/base/courant_frequency.hpp"
#include "jetlag/base/outcome.hpp"
#include "jetlag/base/work.hpp"
#include "jetlag/contact/contact_record.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/output/deformation.hpp"

namespace jetlag {

struct Summary {
  Outcome outcome = Outcome::success;
  std::string message;                     // for all but success: when, which particle, what to do
  std::vector<std::string> warnings;       // what a run that reached its end may have got wrong
  double time = 0;                         // [s], of the last good state
  Coordinates<double> position, velocity;  // [m], [m/s]
  bool has_energy = false;
  Energy initial_energy, final_energy;               // [J]
  double max_relative_energy_error = 0;              // [1]
  Eigen::VectorXd initial_momentum, final_momentum;  // [kg m/s]
  Work work;
  std::vector<Deformation> elements;          // of solids
  std::optional<CourantFrequency> frequency;  // of a Courant limit, where one is in use
  std::optional<ContactRecord> contact;       // of all contacts, where there are any
  double wall_seconds = 0;
  std::string version;
  std::uint64_t seed = 0;
  std::string instruction_set;
  int threads = 1;
};

/// All keys are always there, "message" when the outcome is not success. Numbers read back to the same
/// double; null stands for a number that is not finite, and for the energies of a run that did not measure
/// them.
std::string to_json(const Summary& summary);

}  // namespace jetlag
