// SPDX-License-Identifier: MIT
#include "jetlag/integrators/hermite.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace jetlag {

Hermite::Hermite(const System<double>& system, const Options& options)
    : OneStep(system, 4), options_(options), fixed_(system.fixed()), d0_(2), d1_(2) {
  if (options.iterations < 1)
    throw std::invalid_argument("hermite: iterations must be >= 1, got " +
                                std::to_string(options.iterations));
  require_positive("accuracy", options.accuracy);
  require_positive("max_step", options.max_step, true);
  if (options.step) require_positive("step", *options.step);
  if (accelerations_.depend_on_velocity()) options_.iterations = std::max(options_.iterations, 2);
}

/// The derivatives s and c at the end of the last step, from a and j at both of its ends: with h its length,
///     s_0 = (-6 (a_0 - a_1) - h (4 j_0 + 2 j_1)) / h^2,   c = (12 (a_0 - a_1) + 6 h (j_0 + j_1)) / h^3,   s_1 = s_0 + h c.
double Hermite::aarseth_length(const State<double>& from, Report& report) {
  std::vector<Coordinates<double>> d(4);  // a, j, s, c at the beginning of this step
  const bool goes_on =
      end_.position.size() > 0 && end_.position == from.position && end_.velocity == from.velocity;
  if (goes_on) {
    const double h = length();
    const Coordinates<double> fall = d0_[0] - d1_[0];
    d[0] = d1_[0];
    d[1] = d1_[1];
    d[3] = (12 * fall + 6 * h * (d0_[1] + d1_[1])) / (h * h * h);
    d[2] = (-6 * fall - h * (4 * d0_[1] + 2 * d1_[1])) / (h * h) + h * d[3];
  } else if (!accelerations_(from, d, report)) {
    return 0.0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fixed_.size(); ++i) {
    if (fixed_[i]) continue;
    const auto norm = [&](int k) { return d[k].row(static_cast<Eigen::Index>(i)).norm(); };
    const double above = norm(0) * norm(2) + norm(1) * norm(1), below = norm(1) * norm(3) + norm(2) * norm(2);
    if (above > 0 && below > 0) least = std::min(least, std::sqrt(options_.accuracy * above / below));
  }
  return std::min({least, options_.max_step, goes_on ? 2 * length() : least});
}

double Hermite::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  double proposal = options_.step ? *options_.step : aarseth_length(from, report);
  if (report.outcome != Outcome::success) return 0.0;
  const double h = fixed_length(from, proposal, limit, report);
  if (h == 0.0) return 0.0;
  std::vector<Coordinates<double>> start(2), end(2);
  if (!accelerations_(from, start, report)) return 0.0;
  to.time = from.time + h;
  to.position = from.position + h * (from.velocity + h * (start[0] / 2 + h / 6 * start[1]));
  to.velocity = from.velocity + h * (start[0] + h / 2 * start[1]);
  for (int i = 0; i < options_.iterations; ++i) {
    if (!all_finite(to.position, to.velocity, from.time, report) || !accelerations_(to, end, report))
      return 0.0;
    const State<double> last = to;
    to.velocity = from.velocity + h / 2 * (start[0] + end[0]) + h * h / 12 * (start[1] - end[1]);
    to.position = from.position + h / 2 * (from.velocity + to.velocity) + h * h / 12 * (start[0] - end[0]);
    if (to.position == last.position && to.velocity == last.velocity) break;
  }
  d0_ = std::move(start);
  d1_ = std::move(end);
  end_ = to;
  return h;
}

Piece Hermite::piece() const {
  const std::array left{before().position, before().velocity, d0_[0]},
      right{after().position, after().velocity, d1_[0]};
  return hermite_piece(before().time, length(), left, right);
}

}  // namespace jetlag
