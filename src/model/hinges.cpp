// SPDX-License-Identifier: MIT
#include "jetlag/model/hinges.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace jetlag {

namespace {

/// A triangle at an edge.
struct Side {
  int triangle, opposite;
  bool is_forward;  // passed round from the lower vertex of the edge to the higher one
};

[[noreturn]] void refuse(const std::array<int, 2>& edge, const std::vector<Side>& sides) {
  const std::string at = std::to_string(edge[0]) + "-" + std::to_string(edge[1]);
  if (sides.size() == 2)
    throw std::invalid_argument("triangles " + std::to_string(sides[0].triangle) + " and " +
                                std::to_string(sides[1].triangle) + " disagree in orientation at edge " + at +
                                ": exchange two vertices of one of them");
  std::string triangles;
  for (const Side& side : sides) triangles += (triangles.empty() ? "" : ", ") + std::to_string(side.triangle);
  throw std::invalid_argument("edge " + at + " belongs to triangles " + triangles +
                              ": a surface has at most two there");
}

}  // namespace

std::vector<std::array<int, 4>> hinges_of(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::array<int, 2>, std::vector<Side>> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& triangle = triangles[t];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0] ||
        std::ranges::min(triangle) < 0)
      throw std::invalid_argument("triangle " + std::to_string(t) +
                                  ": needs three different vertices, all >= 0");
    for (int i = 0; i < 3; ++i) {
      const int from = triangle[i], to = triangle[(i + 1) % 3];
      edges[{std::min(from, to), std::max(from, to)}].push_back(
          {static_cast<int>(t), triangle[(i + 2) % 3], from < to});
    }
  }
  std::vector<std::array<int, 4>> hinges;
  for (const auto& [edge, sides] : edges) {
    if (sides.size() == 1) continue;
    if (sides.size() > 2 || sides[0].is_forward == sides[1].is_forward) refuse(edge, sides);
    const int forward = sides[0].is_forward ? 0 : 1;
    hinges.push_back({edge[0], edge[1], sides[forward].opposite, sides[1 - forward].opposite});
  }
  return hinges;
}

}  // namespace jetlag
