// SPDX-License-Identifier: MIT
#pragma once
// What an ensemble amounts to, frame by frame: a table and a summary.

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/base/work.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/sample.hpp"

namespace jetlag {

/// A component of a position [m] or a velocity [m/s] of a particle, or the energy of the whole [J].
struct Quantity {
  int particle = -1;  // -1: the energy
  int component = 0;
  bool of_velocity = false;
};

/// x, y, z, vx, vy, vz or energy.
std::string name_of(const Quantity& quantity);

/// Root mean squares over all components of the positions of moving particles [m]; NaN where one is not known.
struct Calibration {
  static constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  double spread = not_known;               // of the members about their mean
  double member_error = not_known;         // members - reference, over the members too
  double mean_error = not_known;           // mean of the members - reference
  double deterministic_error = not_known;  // run of a fixed degree, its steps at the same cost - reference
};

struct EnsembleFrame {
  double time = 0;                // [s]
  std::size_t members = 0;        // that have come so far
  std::vector<Sample> samples;    // of each quantity
  std::vector<double> reference;  // of each quantity; NaN: not known
  Calibration calibration;
};

struct EnsembleResult {
  struct Failure {
    std::size_t member;
    double time;  // [s], of its last good state
    Report report;
  };

  Outcome outcome = Outcome::success;  // of the ensemble: it fails where all members do
  std::string message;
  std::vector<Quantity> quantities;
  std::vector<EnsembleFrame> frames;
  std::size_t members = 0;
  std::vector<Failure> failures;
  double perturbation = 0;       // [m]
  Work work;                     // of all members
  double mean_orders = 0;        // of the forces, that a step of a member computes by itself
  int deterministic_degree = 0;  // of the run at the same cost; 0: no member has taken a step
  Work deterministic_work;
  std::string reference_message,
      deterministic_message;  // why there is none from some frame on; empty: there is
  std::string
      warning;  // what the deterministic run makes of steps that are given and too long; empty: nothing
  bool in_lanes = false;
  double wall_seconds = 0;  // of the members
  int threads = 1;
  std::uint64_t seed = 0;
  std::string version, instruction_set;
};

/// The root mean square of each over all frames but the first where it is known.
Calibration over_time(const EnsembleResult& result);

/// Columns: time,particle,quantity,mean,spread,q05,q25,q50,q75,q95,mean_low,mean_high,reference. One row for each frame
/// and quantity; the energy has no particle. A field is empty where its number is not known or not finite.
/// Throws std::runtime_error as write_file.
void write_ensemble_csv(const std::filesystem::path& path, const EnsembleResult& result,
                        Until until = Until::on_disk);

/// The content of ensemble.json: all but the samples, with the definitions in words. null: not known or not finite.
std::string to_json(const EnsembleResult& result);

}  // namespace jetlag
