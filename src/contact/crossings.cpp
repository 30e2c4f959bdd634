// SPDX-License-Identifier: MIT
#include "contact/crossings.hpp"

#include <algorithm>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/cartesian.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

namespace index = boost::geometry::index;
using TreePoint = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using TreeBox = boost::geometry::model::box<TreePoint>;
using CrossingTree = index::rtree<std::pair<TreeBox, int>, index::quadratic<16>>;
using Exact = Eigen::Matrix<long double, 3, 1>;

Exact exact_place(const Coordinates<double>& position, int particle) {
  Exact x = Exact::Zero();
  for (Eigen::Index c = 0; c < position.cols(); ++c) x[c] = position(particle, c);
  return x;
}

/// Six times the volume of a tetrahedron.
long double volume(const Exact& a, const Exact& b, const Exact& c, const Exact& d) {
  const Exact x = a - d, y = b - d, z = c - d;
  return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
         x[2] * (y[0] * z[1] - y[1] * z[0]);
}
/// Twice the area of a triangle in the plane.
long double area(const Exact& a, const Exact& b, const Exact& c) {
  return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
}

/// Where p to q passes from one side of a triangle through its inside to the other: both ends off its plane, all its edges
/// turning the same way about the line.
std::optional<Exact> passage(const Exact& p, const Exact& q, const std::array<Exact, 3>& t) {
  const long double at_p = volume(t[0], t[1], t[2], p), at_q = volume(t[0], t[1], t[2], q);
  if (!((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) return {};
  const long double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
  if (!((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0))) return {};
  return Exact(p + (q - p) * (at_p / (at_p - at_q)));
}
std::optional<Exact> passage(const Exact& p, const Exact& q, const std::array<Exact, 2>& e) {
  const long double at_p = area(e[0], e[1], p), at_q = area(e[0], e[1], q);
  if (!((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) return {};
  const long double a = area(p, q, e[0]), b = area(p, q, e[1]);
  if (!((a > 0 && b < 0) || (a < 0 && b > 0))) return {};
  return Exact(p + (q - p) * (at_p / (at_p - at_q)));
}

template <std::size_t N>
TreeBox box_about(const std::array<int, N>& members, const Coordinates<double>& position) {
  double low[3] = {}, high[3] = {};
  for (Eigen::Index c = 0; c < position.cols(); ++c) {
    low[c] = high[c] = position(members[0], c);
    for (const int i : members) {
      low[c] = std::min(low[c], position(i, c));
      high[c] = std::max(high[c], position(i, c));
    }
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

template <std::size_t N>
std::string member_list(const std::array<int, N>& members) {
  std::string text;
  for (const int i : members) text += (text.empty() ? "(" : ", ") + std::to_string(i);
  return text + ")";
}

[[noreturn]] void refuse_crossing(const std::array<int, 2>& edge, const std::string& through, const Exact& at,
                                  Eigen::Index dimension) {
  std::string place;
  for (Eigen::Index c = 0; c < dimension; ++c)
    place += (c > 0 ? ", " : "(") + shown(static_cast<double>(at[c]));
  throw std::invalid_argument("edge " + member_list(edge) + " passes through " + through + " at " + place +
                              "): move them apart");
}

/// Of each edge the first one of `others` that it passes through.
template <std::size_t N>
void require_none_through(const std::vector<std::array<int, 2>>& edges,
                          const std::vector<std::array<int, N>>& others, const char* what,
                          const std::vector<bool>& fixed, const std::vector<int>& body,
                          const Coordinates<double>& position) {
  std::vector<std::pair<TreeBox, int>> boxes;
  boxes.reserve(others.size());
  for (const auto& other : others)
    boxes.emplace_back(box_about(other, position), static_cast<int>(boxes.size()));
  const CrossingTree tree(boxes);
  for (const auto& edge : edges) {
    const Exact p = exact_place(position, edge[0]), q = exact_place(position, edge[1]);
    std::optional<std::pair<int, Exact>> first;
    for (auto found = tree.qbegin(index::intersects(box_about(edge, position))); found != tree.qend();
         ++found) {
      const auto& other = others[found->second];
      const bool is_joined =
          std::ranges::any_of(other, [&](int i) { return i == edge[0] || i == edge[1]; }) ||
          (!body.empty() && body[edge[0]] == body[other[0]]);
      const bool is_fixed =
          fixed[edge[0]] && fixed[edge[1]] && std::ranges::all_of(other, [&](int i) { return fixed[i]; });
      if (is_joined || is_fixed || (first && first->first < found->second)) continue;
      std::array<Exact, N> x;
      for (std::size_t i = 0; i < N; ++i) x[i] = exact_place(position, other[i]);
      if (const auto at = passage(p, q, x)) first.emplace(found->second, *at);
    }
    if (first)
      refuse_crossing(edge, what + member_list(others[first->first]), first->second, position.cols());
  }
}

}  // namespace

void require_no_crossing(const Surface& surface, const std::vector<bool>& fixed, const std::vector<int>& body,
                         const Coordinates<double>& position) {
  if (position.cols() == 3)
    require_none_through(surface.edges(), surface.triangles(), "triangle ", fixed, body, position);
  if (position.cols() == 2)
    require_none_through(surface.edges(), surface.edges(), "edge ", fixed, body, position);
}

}  // namespace jetlag
