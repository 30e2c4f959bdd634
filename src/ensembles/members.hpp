// SPDX-License-Identifier: MIT
#pragma once
// The two ways of a random ensemble.

#include "jetlag/ensembles/random_ensemble.hpp"

namespace jetlag {

class RandomEnsemble::Members {
 public:
  explicit Members(std::size_t count) : reports(count) {}
  virtual ~Members() = default;
  virtual bool in_lanes() const = 0;
  /// Those of different tasks may advance at the same time.
  virtual std::size_t tasks() const = 0;
  /// Returns early, with members on their way, once go_on (may be empty) says so.
  virtual void advance(std::size_t task, double until, const std::function<bool()>& go_on) = 0;
  virtual State<double> state(std::size_t i) const = 0;
  virtual Work work() const = 0;
  /// The sum over members and steps of what RandomEnsemble::mean_orders is the mean of.
  virtual std::uint64_t orders() const = 0;

  std::vector<Report> reports;
};

std::unique_ptr<RandomEnsemble::Members> members_in_lanes(const System<double>& system,
                                                          const SeriesMethod& method, std::size_t count,
                                                          const RandomEnsemble::Start& start,
                                                          const RandomEnsemble::Options& options);

/// Whether a system is small enough for lanes to be faster.
bool fits_lanes(const System<double>& system);

}  // namespace jetlag
