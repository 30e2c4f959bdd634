// SPDX-License-Identifier: MIT
#include "jetlag/model/particle_order.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace jetlag {

namespace {
/// How far apart the ends of an edge are, on average.
double mean_distance(const std::vector<int>& edges, const std::vector<int>& rank) {
  double sum = 0;
  for (std::size_t e = 0; e < edges.size(); e += 2) sum += std::abs(rank[edges[e]] - rank[edges[e + 1]]);
  return sum / std::max<double>(1, edges.size() / 2);
}

std::vector<int> cuthill_mckee(int vertices, const std::vector<int>& edges) {
  std::vector<int> first(vertices + 1, 0), neighbour(edges.size());
  for (int v : edges) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> filled(first.begin(), first.end() - 1);
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    neighbour[filled[edges[e]]++] = edges[e + 1];
    neighbour[filled[edges[e + 1]]++] = edges[e];
  }
  const auto degree = [&](int v) { return first[v + 1] - first[v]; };
  const auto by_degree = [&](int a, int b) { return std::pair(degree(a), a) < std::pair(degree(b), b); };
  for (int v = 0; v < vertices; ++v)
    std::sort(neighbour.begin() + first[v], neighbour.begin() + first[v + 1], by_degree);

  std::vector<int> given(vertices);
  std::iota(given.begin(), given.end(), 0);
  std::vector<int> starts = given, rank(vertices, -1), queue;
  std::sort(starts.begin(), starts.end(), by_degree);
  queue.reserve(vertices);
  for (int start : starts) {
    if (rank[start] >= 0) continue;
    rank[start] = static_cast<int>(queue.size());
    queue.push_back(start);
    for (std::size_t head = rank[start]; head < queue.size(); ++head)
      for (int e = first[queue[head]]; e < first[queue[head] + 1]; ++e)
        if (const int v = neighbour[e]; rank[v] < 0) {
          rank[v] = static_cast<int>(queue.size());
          queue.push_back(v);
        }
  }
  return mean_distance(edges, rank) < 0.5 * mean_distance(edges, given) ? rank : given;
}

}  // namespace

std::vector<int> particle_order(int particles, const std::vector<int>& pairs) {
  constexpr std::size_t small = 1000, dense = 64;  // pairs; pairs for each particle
  const std::size_t count = pairs.size() / 2;
  if (count < small || count > dense * particles) return {};
  return cuthill_mckee(particles, pairs);
}

}  // namespace jetlag
