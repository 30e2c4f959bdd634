// SPDX-License-Identifier: MIT
#pragma once
// The series of a block of members, one in each lane, each stopped at degrees that it draws. What StoppedSeries is for one
// motion (integrators/stopped_series.hpp), with another layout: the draws and weights are the same.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "ensembles/system_lanes.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/truncation/stops.hpp"

namespace jetlag {

/// The power of two next to a step, as unit of time: coefficient n of the series is then of the size of the term, x_n
/// h^n, and neither over- nor underflows where the sum does not, however fast or slow the motion. Its square is a
/// double.
double unit_for(double step);

class StoppedLanes {
 public:
  /// Keeps a reference to the system. The law is known beforehand.
  StoppedLanes(const SystemLanes& system, const Truncation& law, const RandomTaylor::Options& options,
               const KernelTable<double>& table);

  /// Degrees and weights of an update of the members that move, `seeds` of their draws. Returns the largest degree.
  int draw(std::span<const std::uint64_t> seeds, const std::vector<char>& moves, std::uint64_t update);
  /// Of the last draw, for a lane that moves: the sum of the degrees over the moving particles, and the largest of them.
  std::uint64_t degrees(int lane) const { return degrees_[lane]; }
  int top(int lane) const { return tops_[lane]; }

  /// The order of the series that a degree needs.
  int order_for(int degree) const { return std::max(order_needed(degree, velocity_), 1); }

  /// The series from a state, for degrees up to `top`; coefficient n comes times unit^n. Shapes (components, lanes).
  void grow(const AlignedVector<double>& position, const AlignedVector<double>& velocity, double time,
            int top, double unit);

  /// Positions and velocities after h; sums over powers of h / unit.
  void sum(int top, double h, double unit);
  /// Shape (components, lanes); those of fixed particles are not written.
  const double* position() const { return next_.data(); }
  const double* velocity() const {
    return position() + static_cast<std::size_t>(system_.components) * lanes_;
  }
  /// Whether a sum of a lane is not finite.
  bool is_finite(int lane) const { return !std::isnan(not_finite_[lane]); }

 private:
  const SystemLanes& system_;
  const EnsembleLanes& of_;
  int lanes_, moving_;
  VelocitySeries velocity_;
  Stops stops_;
  Blocks<double> series_;
  AlignedVector<double> weights_;  // [draw][term][lane]
  AlignedVector<double> next_, time_, not_finite_, largest_;
  std::vector<std::uint64_t> degrees_;
  std::vector<int> tops_;
};

}  // namespace jetlag
