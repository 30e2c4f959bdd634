// SPDX-License-Identifier: MIT
#include "jetlag/integrators/force_rounding.hpp"

#include <cmath>
#include <limits>

namespace jetlag {

ForceRounding::ForceRounding(const System<double>& system) : fixed_(system.fixed()), accelerations_(system) {}

std::vector<Coordinates<double>> ForceRounding::operator()(const State<double>& state, double h, double n,
                                                           std::span<const Coordinates<double>> known) {
  const double unit = n * std::numeric_limits<double>::epsilon();
  const double least = n * std::numeric_limits<double>::denorm_min();
  constexpr double golden = 0.6180339887498949;
  State<double> moved{state.time, state.position, state.velocity};
  double number = 0;
  const auto move = [&](double& y, double size) {
    const double w = std::fmod(++number * golden, 1.0);
    y += (unit * size + least) * (w < 0.5 ? w - 1 : w);
  };
  for (Eigen::Index i = 0; i < moved.position.rows(); ++i) {
    if (fixed_[static_cast<std::size_t>(i)]) continue;
    for (Eigen::Index c = 0; c < moved.position.cols(); ++c) {
      const double speed = std::abs(state.velocity(i, c));
      move(moved.position(i, c), std::abs(state.position(i, c)) + h * speed);
      move(moved.velocity(i, c), speed + h * std::abs(known[0](i, c)));
    }
  }
  move(moved.time, std::abs(state.time) + h);

  std::vector<Coordinates<double>> difference(known.size());
  Report report;
  const bool finite = accelerations_(moved, difference, report);
  for (std::size_t k = 0; k < known.size(); ++k)
    difference[k] = finite ? Coordinates<double>((difference[k] - known[k]).cwiseAbs())
                           : Coordinates<double>::Zero(known[k].rows(), known[k].cols());
  return difference;
}

}  // namespace jetlag
