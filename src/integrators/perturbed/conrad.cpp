// SPDX-License-Identifier: MIT
#include "jetlag/integrators/perturbed/conrad.hpp"

#include <cmath>
#include <stdexcept>

#include "jetlag/truncation/draws.hpp"

namespace jetlag {

Conrad::Conrad(const System<double>& system, std::unique_ptr<Integrator> inner, const Options& options)
    : inner_(std::move(inner)), options_(options), fixed_(system.fixed()) {
  require_positive("step", options.step);
  require_positive("order", options.order);
  require_positive("sigma", options.sigma);
}

double Conrad::step(State<double>& state, double limit, Report& report) {
  const State<double> from = state;
  const double h = inner_->step(state, cropped(options_.step, limit), report);
  if (h == 0.0) return 0.0;
  const double deviation = options_.sigma * std::pow(h, options_.order + 0.5);
  const Eigen::Index n = state.position.rows(), d = state.position.cols();
  noise_of_position_.setZero(n, d);
  noise_of_velocity_.setZero(n, d);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (fixed_[i]) continue;
    for (Eigen::Index c = 0; c < d; ++c) {
      const auto key = static_cast<std::uint32_t>(i * d + c);
      noise_of_position_(i, c) = deviation * standard_normal(options_.seed, key, 2 * update_);
      noise_of_velocity_(i, c) = deviation * standard_normal(options_.seed, key, 2 * update_ + 1);
    }
  }
  state.position += noise_of_position_;
  state.velocity += noise_of_velocity_;
  state.drop_rests();
  if (!all_finite(state.position, state.velocity, from.time, report)) {
    state = from;
    return 0.0;
  }
  last_step_ = h;
  ++update_;
  return h;
}

Piece Conrad::piece() const {
  Piece piece = inner_->piece();
  const double rate = piece.unit / last_step_;
  const auto add = [rate](Coefficients& series, const Coordinates<double>& noise) {
    if (series.size() < 2)
      series.push_back(rate * noise);
    else
      series[1] += rate * noise;
  };
  add(piece.position, noise_of_position_);
  add(piece.velocity, noise_of_velocity_);
  return piece;
}

}  // namespace jetlag
