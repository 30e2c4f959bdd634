// SPDX-License-Identifier: MIT
#include "ensembles/stopped_lanes.hpp"

#include <algorithm>
#include <cmath>

namespace jetlag {

/// The power of two next to a step, as unit of time: coefficient n of the series is then of the size of the term, x_n
/// h^n, and neither over- nor underflows where the sum does not, however fast or slow the motion. Its square is a
/// double.
double unit_for(double step) {
  return std::ldexp(1.0, std::clamp(static_cast<int>(std::lround(std::log2(step))), -500, 500));
}

StoppedLanes::StoppedLanes(const SystemLanes& system, const Truncation& law,
                           const RandomTaylor::Options& options, const KernelTable<double>& table)
    : system_(system),
      of_(ensemble_lanes(table.instruction_set)),
      lanes_(table.lanes),
      moving_(static_cast<int>(std::ranges::count(system.fixed, false))),
      velocity_(options.velocity),
      stops_(options.shared_draw ? Stops(law, options.draws, options.seed)
                                 : Stops(law, options.draws, options.seed, system.fixed)),
      series_(system.program, lanes_, {}, table),
      weights_(stops_.draws() * stops_.terms() * lanes_, 0.0),
      next_(2 * static_cast<std::size_t>(system.components) * lanes_),
      time_(lanes_),
      not_finite_(lanes_),
      largest_(lanes_),
      degrees_(lanes_),
      tops_(lanes_) {
  series_.reserve(stops_.law().max_degree() + 2);
}

/// The weights of this step, 1 / P(K >= n) for n <= K and 0 beyond, K as RandomTaylor draws it.
int StoppedLanes::draw(std::span<const std::uint64_t> seeds, const std::vector<char>& moves,
                       std::uint64_t update) {
  int top = stops_.law().min_degree();
  for (int lane = 0; lane < lanes_; ++lane) {
    if (!moves[lane]) continue;
    stops_.reseed(seeds[lane]);
    stops_.draw(update);
    degrees_[lane] = 0;
    tops_[lane] = stops_.largest_degree();
    top = std::max(top, tops_[lane]);
    for (std::size_t d = 0; d < stops_.draws(); ++d) {
      if (!stops_.shared() && system_.fixed[d]) continue;
      const int degree = stops_.degree(d);
      degrees_[lane] += stops_.shared() ? static_cast<std::uint64_t>(degree) * moving_ : degree;
      double* weights = weights_.data() + d * stops_.terms() * lanes_ + lane;
      for (int n = 0; n <= stops_.law().max_degree(); ++n)
        weights[n * lanes_] = n <= degree ? stops_.weights(d)[n] : 0.0;
    }
  }
  return top;
}

void StoppedLanes::grow(const AlignedVector<double>& position, const AlignedVector<double>& velocity,
                        double time, int top, double unit) {
  for (int c = 0; c < system_.components; ++c) {
    double* x = series_.at(0, system_.series[c], 0);
    std::copy_n(position.data() + c * lanes_, lanes_, x);
    of_.scale(lanes_, unit, velocity.data() + c * lanes_, x + lanes_);
  }
  std::ranges::fill(time_, time);
  system_.grow(series_, of_, time_.data(), order_for(top), unit);
}

void StoppedLanes::sum(int top, double h, double unit) {
  std::ranges::fill(not_finite_, 0.0);
  const bool derivative = velocity_ == VelocitySeries::derivative;
  const double s = h / unit;
  double* position = next_.data();
  double* velocity = position + static_cast<std::size_t>(system_.components) * lanes_;
  for (int c = 0; c < system_.components; ++c, position += lanes_, velocity += lanes_) {
    if (system_.inverse_mass[c] == 0.0) continue;
    const int draw = stops_.shared() ? 0 : c / system_.dimension;
    const double* weights = weights_.data() + static_cast<std::size_t>(draw) * stops_.terms() * lanes_;
    const double* x = series_.at(0, system_.series[c], 0);
    of_.weighted(lanes_, false, top, x, weights, s, position);
    // With `derivative`, coefficient n of the velocity carries the weight of coefficient n + 1 of the position.
    of_.weighted(lanes_, true, derivative ? top - 1 : top, x, derivative ? weights + lanes_ : weights, s,
                 velocity);
    of_.multiply(lanes_, 1 / unit, velocity);
    for (const double* next : {position, velocity})
      of_.largest(lanes_, next, largest_.data(), not_finite_.data());
  }
}

}  // namespace jetlag
