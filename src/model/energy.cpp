// SPDX-License-Identifier: MIT
#include "jetlag/model/energy.hpp"

#include <Eigen/Geometry>

namespace jetlag {

EnergyMeter::EnergyMeter(const System<double>& system)
    : dimension_(system.dimension()), mass_(system.mass()) {
  for (const auto& elements : system.elements())
    if (elements.count() > 0 && elements.law.energy) {
      potentials_.emplace_back(system, elements, *elements.law.energy, kernels<double>());
      potentials_.back().reserve(1);
    }
}

Energy EnergyMeter::operator()(const State<double>& state) {
  const int n = static_cast<int>(mass_.size()), d = dimension_;
  require_shape(state, n, d);
  const int stride = padded(d);
  position_.resize(static_cast<std::size_t>(n) * stride);
  velocity_.resize(static_cast<std::size_t>(n) * stride);
  Energy energy;
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < d; ++c) {
      position_[i * stride + c] = state.position(i, c);
      velocity_[i * stride + c] = state.velocity(i, c);
    }
    energy.kinetic += 0.5 * mass_[i] * state.velocity.row(i).squaredNorm();
  }
  const MotionRows<double> motion{position_.data(), velocity_.data(), 0, state.time, 1.0};
  for (auto& blocks : potentials_) energy.potential += blocks.sum(motion);
  return energy;
}

Eigen::VectorXd momentum(const System<double>& system, const State<double>& state) {
  return state.velocity.transpose() * Eigen::VectorXd::Map(system.mass().data(), system.particles());
}

Eigen::VectorXd angular_momentum(const System<double>& system, const State<double>& state) {
  if (system.dimension() == 1) return {};
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (int i = 0; i < system.particles(); ++i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
    x.head(system.dimension()) = state.position.row(i);
    v.head(system.dimension()) = state.velocity.row(i);
    total += system.mass()[i] * x.cross(v);
  }
  if (system.dimension() == 2) return total.tail<1>();
  return total;
}

}  // namespace jetlag
