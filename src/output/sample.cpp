// SPDX-License-Identifier: MIT
#include "jetlag/output/sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace jetlag {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double student_95(long freedom) {
  if (freedom < 1)
    throw std::invalid_argument("student_95: degrees of freedom must be >= 1, got " +
                                std::to_string(freedom));
  if (freedom == 1) return 12.7062047;
  if (freedom == 2) return 4.3026527;
  constexpr double z = 1.959963984540054, z2 = z * z;
  constexpr double g1 = z * (z2 + 1) / 4, g2 = z * ((5 * z2 + 16) * z2 + 3) / 96,
                   g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384,
                   g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  const double f = 1.0 / static_cast<double>(freedom);
  return z + f * (g1 + f * (g2 + f * (g3 + f * g4)));
}

Sample sample_of(std::span<double> x) {
  if (x.empty()) throw std::invalid_argument("sample_of: at least one number is needed");
  const auto n = static_cast<double>(x.size());
  Sample sample{not_known, not_known, {}, not_known};
  sample.quantiles.fill(not_known);
  if (!std::ranges::all_of(x, [](double value) { return std::isfinite(value); })) return sample;

  // About the first number: a spread far below the size of the numbers keeps its digits, and equal numbers have none.
  double shifted = 0, squares = 0;
  for (const double value : x) shifted += value - x[0];
  shifted /= n;
  sample.mean = x[0] + shifted;
  for (const double value : x) {
    const double difference = (value - x[0]) - shifted;
    squares += difference * difference;
  }
  if (x.size() > 1) {
    sample.spread = std::sqrt(squares / (n - 1));
    sample.half_width = student_95(static_cast<long>(x.size()) - 1) * sample.spread / std::sqrt(n);
  }
  auto from = x.begin();
  for (std::size_t i = 0; i < sample.quantiles.size(); ++i) {
    const double place = (n - 1) * Sample::probabilities[i];
    const auto below = x.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(from, below, x.end());
    const auto above = std::min_element(below + 1, x.end());
    const double share = place - std::floor(place);
    sample.quantiles[i] = above == x.end() || share == 0 ? *below : *below + share * (*above - *below);
    from = below;
  }
  return sample;
}

}  // namespace jetlag
