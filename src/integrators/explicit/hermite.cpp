// SPDX-License-Identifier: MIT
#include "jetlag/integrators/explicit/hermite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace jetlag {

namespace {

/// |row|, however small.
double size_of(const Coordinates<double>& rows, int row) { return rows.row(row).stableNorm(); }

}  // namespace

Hermite::Hermite(const System<double>& system, const Options& options)
    : OneStep(system, 4), options_(options), fixed_(system.fixed()), d0_(2), d1_(2), rounding_(system) {
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
  for (int i = 0; i < static_cast<int>(fixed_.size()); ++i) {
    if (fixed_[i]) continue;
    const double a = size_of(d[0], i), j = size_of(d[1], i);
    double s = size_of(d[2], i), c = size_of(d[3], i);
    const auto length_of = [&] {
      const double most = std::max({a, j, s, c});
      const int unit = most > 0 ? std::ilogb(most) : 0;  // their squares may not fit a double
      const auto in_unit = [unit](double x) { return std::scalbn(x, -unit); };
      const double above = in_unit(a) * in_unit(s) + in_unit(j) * in_unit(j),
                   below = in_unit(j) * in_unit(c) + in_unit(s) * in_unit(s);
      return above > 0 && below > 0 ? std::sqrt(options_.accuracy * above / below)
                                    : std::numeric_limits<double>::infinity();
    };
    double its_length = length_of();
    if (goes_on && its_length < 2 * length() && may_be_rounding(i)) {
      const auto [noise_s, noise_c] = rounding(i);
      s = std::max(0.0, s - noise_s);
      c = std::max(0.0, c - noise_c);
      its_length = length_of();
    }
    least = std::min(least, its_length);
  }
  return std::min({least, options_.max_step, goes_on ? 2 * length() : least});
}

/// Whether the change of a particle's acceleration over the last step is so small that it may be rounding. With n eps
/// of the largest position that is n eps |da/dx| |x|, and in a stable step h^2 |da/dx| is below (2.5)^2 or so; a
/// hundred where forces depend on velocities or time too.
bool Hermite::may_be_rounding(int particle) const {
  const double h = length();
  const double reach = largest(before().position) / (h * h) + largest(before().velocity) / h +
                       std::abs(before().time) / h * largest(d0_[0]);
  return (d0_[0] - d1_[0]).row(particle).norm() <=
         100 * roundings * std::numeric_limits<double>::epsilon() * reach;
}

/// What of s and c at the end of the last step may be rounding: with da and dj of both of its ends,
///     ds = (12 da + 6 h dj) / h^2 + h dc,   dc = (24 da + 12 h dj) / h^3.
std::pair<double, double> Hermite::rounding(int particle) {
  const double h = length();
  if (noise_.empty()) {
    const auto counted = rounding_.element_coefficients();
    noise_ = rounding_(before(), h, roundings, d0_);
    other_element_coefficients_ += rounding_.element_coefficients() - counted;
  }
  const double da = size_of(noise_[0], particle), dj = size_of(noise_[1], particle);
  const double dc = (24 * da + 12 * h * dj) / (h * h * h);
  return {(12 * da + 6 * h * dj) / (h * h) + h * dc, dc};
}

double Hermite::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  double proposal = options_.step ? *options_.step : aarseth_length(from, report);
  if (report.outcome != Outcome::success) return 0.0;
  const double h = options_.step ? fixed_length(from, proposal, limit, report)
                                 : chosen_length(from, proposal, limit, report);
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
  noise_.clear();
  return h;
}

Piece Hermite::piece() const {
  const std::array left{before().position, before().velocity, d0_[0]},
      right{after().position, after().velocity, d1_[0]};
  return hermite_piece(before().time, length(), left, right);
}

}  // namespace jetlag
