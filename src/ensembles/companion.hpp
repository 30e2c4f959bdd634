// SPDX-License-Identifier: MIT
#pragma once
// A run beside an ensemble, from frame to frame.

#include <cstdint>
#include <functional>

#include "jetlag/ensembles/random_ensemble.hpp"

namespace jetlag {

class Companion {
 public:
  static constexpr std::uint64_t most_steps = 5'000'000;

  /// The last step is shortened to end at `end` [s]. Keeps no reference. Throws as RandomTaylor does.
  Companion(const System<double>& system, const SeriesMethod& method, const State<double>& start, double end,
            std::uint64_t max_steps = most_steps)
      : taylor_(system, method.law, method.control->clone(), method.options),
        state_(start),
        seen_(start),
        end_(end),
        max_steps_(max_steps) {}

  /// Its state is then that at `time` [s], from the polynomial of the last step. Returns whether it has got there. Where it
  /// has not, it goes no further, and the report says why.
  /// go_on (may be empty): asked before every step.
  bool advance_to(double time, const std::function<bool()>& go_on = {});

  const State<double>& state() const { return seen_; }
  const Report& report() const { return report_; }
  /// How far the steps have led [s].
  double time() const { return state_.time; }
  const Work& work() const { return taylor_.work(); }
  std::string warning() const { return taylor_.warning(); }

 private:
  RandomTaylor taylor_;
  State<double> state_, seen_;
  double end_;
  std::uint64_t max_steps_;
  Report report_;
};

}  // namespace jetlag
