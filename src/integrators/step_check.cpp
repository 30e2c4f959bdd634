// SPDX-License-Identifier: MIT
#include "jetlag/integrators/step_check.hpp"

#include "jetlag/base/text.hpp"

namespace jetlag {

void DefectLedger::take_extent(const Coordinates<double>& position) {
  if (position.rows() == 0) return;
  const Eigen::RowVectorXd low = position.colwise().minCoeff(), high = position.colwise().maxCoeff();
  low_ = low_.size() == 0 ? low : low_.cwiseMin(low).eval();
  high_ = high_.size() == 0 ? high : high_.cwiseMax(high).eval();
}

std::string DefectLedger::warning() const {
  if (steps_ == 0) return {};
  const double extent = (high_ - low_).maxCoeff();
  if (!(position_ > 1e-3 * extent)) return {};
  return "the steps are given and cannot be shortened, but the forces at their ends contradict the series "
         "from their beginnings, most of all at t = " +
         shown(time_) + " at particle " + std::to_string(particle_) + ": positions may be off by " +
         shown(position_) + " m in an extent of " + shown(extent) +
         " m; take shorter steps, a higher degree or a control that chooses them";
}

}  // namespace jetlag
