// SPDX-License-Identifier: MIT
#include "studies/competitors.hpp"

#include <fmt/format.h>

namespace jetlag {

namespace {

using Json = nlohmann::ordered_json;

const Json fixed_step = {{"type", "fixed"}};

Competitor fixed(int degree) {
  return {
      "fixed degree", fmt::format("degree {}", degree), {{"type", "taylor"}, {"degree", degree}}, fixed_step};
}

/// The geometric law up to degree 16.
Competitor geometric(const char* draws, int m, double p) {
  return {draws,
          fmt::format("({},16,{:.4g}) {}", m, p, draws),
          {{"type", "random_taylor"},
           {"min_degree", m},
           {"max_degree", 16},
           {"probability", p},
           {"draws", draws}},
          fixed_step,
          true};
}

}  // namespace

std::vector<Competitor> competitors() {
  std::vector<Competitor> all;
  for (int degree : {2, 3, 4, 5, 6, 7, 8, 10, 12, 16}) all.push_back(fixed(degree));
  for (const char* draws : {"independent"})
    for (int m : {3, 4, 6}) all.push_back(geometric(draws, m, 0.5));
  all.push_back({"jorba_zou",
                 "degree 20, step chosen",
                 {{"type", "taylor"}, {"degree", 20}},
                 {{"type", "jorba_zou"}},
                 false,
                 false});
  return all;
}

}  // namespace jetlag
