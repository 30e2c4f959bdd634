// SPDX-License-Identifier: MIT
#include "jetlag/model/energy.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace jetlag {

namespace {
std::optional<ElementBlocks<double>> potential_of(const Model<double>::Law& law) {
  const std::optional<Tape>& tape = law.elements().law.energy;
  if (!tape || law.count() == 0) return {};
  auto blocks = law.blocks(*tape, kernels<double>(), law.all());
  blocks.reserve(1);
  return blocks;
}
}  // namespace

EnergyMeter::EnergyMeter(const Model<double>& model) : model_(model) {
  for (const auto& law : model.laws()) potentials_.push_back(potential_of(*law));
}

EnergyMeter::EnergyMeter(const System<double>& system) : EnergyMeter(ModelAlong(system)) {}

EnergyMeter::EnergyMeter(ModelAlong along) : EnergyMeter(along.model()) {
  if (!along.none()) along_.emplace(std::move(along));
}

void EnergyMeter::move_to(const Model<double>& model) {
  model.require_epoch_of(model_);
  const Model<double> before = std::exchange(model_, model);
  for (std::size_t l = 0; l < potentials_.size(); ++l)
    if (before.laws()[l] != model.laws()[l]) potentials_[l] = potential_of(model.law(l));
}

Energy EnergyMeter::operator()(const State<double>& state) {
  const int n = model_.particles(), d = model_.dimension();
  require_shape(state, n, d);
  if (along_ && along_->begin(state)) move_to(along_->model());
  const int stride = padded(d);
  position_.resize(static_cast<std::size_t>(n) * stride);
  velocity_.resize(static_cast<std::size_t>(n) * stride);
  Energy energy;
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < d; ++c) {
      position_[i * stride + c] = state.position(i, c);
      velocity_[i * stride + c] = state.velocity(i, c);
    }
    energy.kinetic += 0.5 * model_.mass()[i] * state.velocity.row(i).squaredNorm();
  }
  const MotionRows<double> motion{position_.data(), velocity_.data(), 0, state.time, 1.0};
  for (auto& blocks : potentials_)
    if (blocks) energy.potential += blocks->sum(motion);
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
