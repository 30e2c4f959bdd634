// SPDX-License-Identifier: MIT
#include "jetlag/integrators/perturbed/exponential_step.hpp"

#include <cmath>

#include "jetlag/truncation/draws.hpp"

namespace jetlag {

namespace {
constexpr double any_length = 1e300;
}

ExponentialStep::ExponentialStep(const System<double>& system, double step, std::uint64_t seed)
    : euler_(system, euler(), any_length), step_(step), seed_(seed) {
  require_positive("step", step);
}

/// A step that is too short to change the time is passed over, unless all are.
double ExponentialStep::step(State<double>& state, double limit, Report& report) {
  State<double> before = state;
  const std::uint64_t first = draw_;
  double h;
  do {
    const double u =
        uniform(seed_, shared_by_all, draw_++) - 0x1p-54;  // in the middle of its interval: in (0, 1)
    h = cropped(-step_ * std::log(u), limit);
  } while (!advances(state.time, h) && advances(state.time, cropped(step_, limit)));
  if (euler_.step(state, h, report) == 0.0) {
    draw_ = first;
    return 0.0;
  }
  before_ = std::move(before);
  after_ = state;
  last_step_ = h;
  return h;
}

Piece ExponentialStep::piece() const {
  return {before_.time,
          before_.time + last_step_,
          {before_.position, before_.velocity},
          {before_.velocity, (after_.velocity - before_.velocity) / last_step_}};
}

}  // namespace jetlag
