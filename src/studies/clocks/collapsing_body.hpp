// SPDX-License-Identifier: MIT
#pragma once
// A body in which one spring collapses: its ends meet, all but an offset, in the midst of the others.
//
//         o---o---o             o---o---o
//        / \ / \ / \           / \ /|\ / \           .
//       o---a---b---o         o---ab--'---o          offset: how far apart a and b pass each other
//        \ / \ / \ /           \ / \|/ \ /
//
// While the ends are nearest, u / offset per second apart, their series have a radius of convergence of offset / u,
// and a run that has one step for all must take it for all.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"

namespace jetlag {

struct CollapsingBody {
  System<double> system, cut;    // cut: without the spring that collapses
  State<double> start, nearest;  // at time 0, and when the ends are nearest or where they meet just after
  std::vector<int> distance;     // of each particle from the nearer end [springs]
  std::array<int, 2> ends;
  double length;  // of the spring at rest [m]

  int farthest() const { return *std::ranges::max_element(distance); }
};

/// Unit masses, springs of unit stiffness on the edges of a mesh, at rest in its shape; nothing is held.
inline System<double> springs_on(const Mesh& mesh, int left_out = -1) {
  System<double> system(static_cast<int>(mesh.position.cols()),
                        std::vector<double>(mesh.position.rows(), 1.0));
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (static_cast<int>(e) == left_out) continue;
    const auto& [a, b] = pairs.emplace_back(mesh.edges[e]);
    springs.push_back({1.0, (mesh.position.row(b) - mesh.position.row(a)).norm()});
  }
  system.add<Spring>(pairs, springs);
  return system;
}

/// The number of springs between each particle and the nearer one of two.
inline std::vector<int> distances(const Mesh& mesh, const std::array<int, 2>& from) {
  std::vector<std::vector<int>> neighbours(mesh.position.rows());
  for (const auto& [a, b] : mesh.edges) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  std::vector<int> distance(neighbours.size(), -1), reached(from.begin(), from.end());
  for (int i : from) distance[i] = 0;
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (int n : neighbours[reached[next]])
      if (distance[n] < 0) {
        distance[n] = distance[reached[next]] + 1;
        reached.push_back(n);
      }
  return distance;
}

/// The edge whose middle is nearest to a point.
inline int edge_near(const Mesh& mesh, const Eigen::RowVector3d& point) {
  const auto away = [&](const std::array<int, 2>& e) {
    return (0.5 * (mesh.position.row(e[0]) + mesh.position.row(e[1])) - point).norm();
  };
  return static_cast<int>(std::ranges::min_element(mesh.edges, {}, away) - mesh.edges.begin());
}

/// The motion of springs to a time, to rounding but where ends meet: backwards where it lies before that of the state.
inline State<double> moved(const System<double>& system, State<double> state, double to) {
  const double sign = to < state.time ? -1 : 1, begin = state.time;
  state.velocity *= sign;
  state.time = 0;
  const Report report =
      Lockstep(taylor(system, 20, std::make_unique<JorbaZou>())).run(state, sign * (to - begin), {});
  if (report.outcome != Outcome::success) throw std::runtime_error("collapsing_body: " + report.message);
  state.velocity *= sign;
  state.time = to;
  return state;
}

/// The body with the spring on one edge collapsing after `lead` [s] > 0; offset >= 0, in lengths of that spring. When its
/// ends are nearest they lie in its middle and pass each other at one length a second, all others are in the rest shape
/// and have normal velocities of 0.02 lengths a second, from the seed; frequencies are of the order of 1.
///
/// The start is found backwards. With offset 0 there is no force where the ends meet; backwards and forwards
/// the motion is begun 1e-12 lengths beyond, on the line on which they meet, from which accelerations of the order of 1
/// have moved them by 1e-24. So `nearest` leads to a reference that has not been through the collapse.
inline CollapsingBody collapsing_body(const Mesh& mesh, int edge, double offset, double lead,
                                      std::uint64_t seed = 1) {
  const auto [a, b] = mesh.edges[edge];
  const Eigen::RowVector3d span = mesh.position.row(b) - mesh.position.row(a),
                           middle = 0.5 * (mesh.position.row(a) + mesh.position.row(b)),
                           across = Eigen::Vector3d(span.transpose()).unitOrthogonal().transpose();
  const double length = span.norm(), beyond = offset > 0 ? 0 : 1e-12;
  CollapsingBody body{
      springs_on(mesh), springs_on(mesh, edge), {}, {}, distances(mesh, {a, b}), {a, b}, length};
  State<double>& nearest = body.nearest;
  nearest = {lead, mesh.position.rowwise() - middle, Coordinates<double>(mesh.position.rows(), 3)};
  for (int i = 0; i < nearest.velocity.rows(); ++i)
    for (int c = 0; c < 3; ++c) nearest.velocity(i, c) = 0.02 * length * standard_normal(seed, i, c);
  const auto pass = [&](double ahead) {
    for (const auto& [i, sign] : {std::pair(a, -0.5), std::pair(b, 0.5)}) {
      nearest.position.row(i) = sign * (length * offset * across + ahead * span);
      nearest.velocity.row(i) = sign * span;
    }
  };
  pass(-beyond);
  body.start = moved(body.system, nearest, 0.0);
  pass(beyond);
  return body;
}

}  // namespace jetlag
