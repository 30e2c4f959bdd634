// SPDX-License-Identifier: MIT
#include "jetlag/contact/contact_meter.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "jetlag/contact/stencil.hpp"

namespace jetlag {

namespace {

/// Of the laws of barriers; elements of nearly parallel edges have all four vertices, whatever carries their distance.
bool is_barrier(const std::string& law) { return law.starts_with("barrier_"); }
StencilKind kind_of(const RecordedLaw& law) {
  if (law.participants == 2) return StencilKind::vertex_vertex;
  if (law.participants == 3) return StencilKind::vertex_edge;
  return law.name.ends_with("vertex_face") ? StencilKind::vertex_face : StencilKind::edge_edge;
}

}  // namespace

ContactMeter::ContactMeter(const System<double>& system) : along_(system) {}

void ContactMeter::measure(const State<double>& state) {
  const int n = along_.model().particles(), d = along_.model().dimension(), stride = padded(d);
  require_shape(state, n, d);
  along_.begin(state);
  for (auto* rows : {&position_, &velocity_, &sum_}) rows->assign(static_cast<std::size_t>(n) * stride, 0.0);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < d; ++c) {
      position_[i * stride + c] = state.position(i, c);
      velocity_[i * stride + c] = state.velocity(i, c);
    }
  gap_.assign(n, std::numeric_limits<double>::infinity());
  for (const auto& law : along_.model().laws())
    if (is_barrier(law->elements().law.name) && law->count() > 0) add(*law, state);
  force_.resize(n, d);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < d; ++c) force_(i, c) = sum_[i * stride + c];
}

void ContactMeter::add(const Model<double>::Law& law, const State<double>& state) {
  const auto& [recorded, particles, parameters] = law.elements();
  auto blocks = law.blocks(recorded.force, kernels<double>(), law.all());
  blocks.reserve(1);
  const MotionRows<double> motion{position_.data(), velocity_.data(), 0, state.time, 1.0};
  blocks.push_all(0, 1, motion, sum_.data());

  const auto members = static_cast<std::size_t>(recorded.participants);
  const auto xi =
      static_cast<std::size_t>(std::ranges::find(recorded.parameters, "gap") - recorded.parameters.begin());
  for (std::size_t e = 0; e < law.count(); ++e) {
    std::array<Eigen::Vector3d, 4> x;
    x.fill(Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < members; ++i)
      x[i].head(state.position.cols()) = state.position.row(particles[e * members + i]);
    const double gap = closest(kind_of(recorded), std::span(x).first(members)).distance -
                       parameters[e * recorded.parameters.size() + xi];
    for (std::size_t i = 0; i < members; ++i) {
      double& of_particle = gap_[particles[e * members + i]];
      of_particle = std::min(of_particle, gap);
    }
  }
}

}  // namespace jetlag
