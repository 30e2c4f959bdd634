// SPDX-License-Identifier: MIT
#include "jetlag/motion/particle_order.hpp"

namespace jetlag::detail {

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

  std::vector<int> starts(vertices), rank(vertices, -1), queue;
  std::iota(starts.begin(), starts.end(), 0);
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
  return rank;
}

}  // namespace jetlag::detail
