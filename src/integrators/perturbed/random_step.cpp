// SPDX-License-Identifier: MIT
#include "jetlag/integrators/perturbed/random_step.hpp"

#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "jetlag/truncation/draws.hpp"

namespace jetlag {

RandomStep::RandomStep(std::unique_ptr<Integrator> inner, const Options& options)
    : inner_(std::move(inner)), options_(options) {
  require_positive("step", options.step);
  if (!(options.order > 0.5) || !std::isfinite(options.order))
    throw std::invalid_argument("random_step: order must be > 1/2, got " + shown(options.order));
  if (options.distribution == StepDistribution::uniform && options.step >= 1)
    throw std::invalid_argument("random_step: a uniform step must be < 1 s, so that h - h^(p+1/2) > 0, got " +
                                shown(options.step) + " s; take another unit of time, or lognormal");
}

double RandomStep::length(double h, std::uint64_t update) const {
  const double p = options_.order;
  if (options_.distribution == StepDistribution::uniform)
    return h + std::pow(h, p + 0.5) * (2 * uniform(options_.seed, shared_by_all, update) - 1);
  const double s = std::log1p(std::pow(h, 2 * p - 1));
  return h * std::exp(std::sqrt(s) * standard_normal(options_.seed, shared_by_all, update) - s / 2);
}

double RandomStep::step(State<double>& state, double limit, Report& report) {
  const double h = cropped(options_.step, limit);
  if (inner_->step(state, advances(state.time, h) ? length(h, update_) : h, report) == 0.0) return 0.0;
  last_step_ = h;
  ++update_;
  return h;
}

Piece RandomStep::piece() const {
  Piece piece = inner_->piece();
  const double stretch = (piece.end - piece.begin) / last_step_;
  piece.end = piece.begin + last_step_;
  for (auto* series : {&piece.position, &piece.velocity}) {
    double power = 1;
    for (std::size_t k = 0; k < series->size(); ++k) {
      (*series)[k] *= power;
      power *= stretch;
    }
  }
  return piece;
}

}  // namespace jetlag
