// SPDX-License-Identifier: MIT
#include "jetlag/contact/surface.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>

namespace jetlag {

namespace {

template <class X>
void sort_and_merge(std::vector<X>& all) {
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
}

template <class X>
std::vector<X> without(const std::vector<X>& all, const std::vector<X>& others) {
  std::vector<X> rest;
  std::ranges::set_difference(all, others, std::back_inserter(rest));
  return rest;
}

template <std::size_t N>
std::string shown(const std::array<int, N>& members) {
  std::string text = "(";
  for (std::size_t i = 0; i < N; ++i) text += (i > 0 ? ", " : "") + std::to_string(members[i]);
  return text + ")";
}

/// Ascending, members ascending.
template <std::size_t N>
std::vector<std::array<int, N>> sorted(std::vector<std::array<int, N>> all, const std::string& what) {
  for (auto& members : all) {
    const auto given = members;
    std::ranges::sort(members);
    if (std::ranges::adjacent_find(members) != members.end())
      throw std::invalid_argument("Surface: " + what + " " + shown(given) + " names a particle twice");
  }
  std::ranges::sort(all);
  if (const auto twice = std::ranges::adjacent_find(all); twice != all.end())
    throw std::invalid_argument("Surface: " + what + " " + shown(*twice) + " is listed twice");
  return all;
}

}  // namespace

Surface::Surface(const std::vector<std::array<int, 3>>& triangles,
                 const std::vector<std::array<int, 2>>& edges, const std::vector<int>& points)
    : vertices_(points), edges_(sorted(edges, "edge")), triangles_(sorted(triangles, "triangle")) {
  complete();
}

Surface& Surface::operator+=(const Surface& other) {
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(vertices_, other.vertices_);
  append(edges_, other.edges_);
  append(triangles_, other.triangles_);
  sort_and_merge(triangles_);
  complete();
  return *this;
}

void Surface::complete() {
  std::vector<std::array<int, 2>> of_triangles;
  for (const auto& [a, b, c] : triangles_)
    of_triangles.insert(of_triangles.end(), {std::array{a, b}, std::array{a, c}, std::array{b, c}});
  sort_and_merge(of_triangles);
  edges_.insert(edges_.end(), of_triangles.begin(), of_triangles.end());
  sort_and_merge(edges_);
  loose_edges_ = without(edges_, of_triangles);

  std::vector<int> of_edges;
  for (const auto& edge : edges_) of_edges.insert(of_edges.end(), edge.begin(), edge.end());
  sort_and_merge(of_edges);
  vertices_.insert(vertices_.end(), of_edges.begin(), of_edges.end());
  sort_and_merge(vertices_);
  loose_vertices_ = without(vertices_, of_edges);
}

std::vector<int> bodies_of(const Surface& surface, int particles) {
  std::vector<int> root(particles);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [a, b] : surface.edges()) {
    const int low = std::min(find(a), find(b));
    root[find(a)] = root[find(b)] = low;
  }
  for (int i = 0; i < particles; ++i) root[i] = find(i);
  return root;
}

}  // namespace jetlag
