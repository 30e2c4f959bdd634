// SPDX-License-Identifier: MIT
#include "jetlag/truncation/variance_capped.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

/// Neighbouring orders with one probability.
struct Pool {
  int orders;
  double nu, cost;
  double slope() const { return nu / cost; }
};

/// sqrt(nu_n / t_n), n = 1 .. N, pooled until it does not rise.         Source: pool adjacent violators, Ayer et al.
/// 1955.
std::vector<double> falling_shape(std::span<const double> nu, std::span<const double> increments) {
  std::vector<Pool> pools;
  for (std::size_t n = 1; n < nu.size(); ++n) {
    pools.push_back({1, nu[n], increments[n]});
    while (pools.size() > 1 && pools[pools.size() - 2].slope() <= pools.back().slope()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back() = {pools.back().orders + last.orders, pools.back().nu + last.nu,
                      pools.back().cost + last.cost};
    }
  }
  std::vector<double> shape{1.0};
  for (const Pool& pool : pools)
    shape.insert(shape.end(), pool.orders, std::sqrt(std::max(pool.slope(), 0.0)));
  return shape;
}

}  // namespace

TruncationLaw variance_capped(std::span<const double> terms, double max_variance,
                              std::span<const double> increments) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("variance_capped: " + what);
  };
  std::size_t count = terms.size();
  for (std::size_t n = 0; n < count; ++n)
    if (!std::isfinite(terms[n])) refuse("term " + std::to_string(n) + " is not finite");
  while (count > 0 && terms[count - 1] == 0.0) --count;
  if (count < 2) refuse("a term other than 0 beyond term 0 is needed");
  if (!(max_variance > 0.0)) refuse("max_variance must be > 0, got " + shown(max_variance));
  std::vector<double> ones;
  if (increments.empty()) increments = ones = linear_cost(static_cast<int>(count) - 1);
  if (increments.size() < count)
    refuse("increments of the cost are needed for " + std::to_string(count) + " terms, got " +
           std::to_string(increments.size()));
  for (std::size_t n = 1; n < count; ++n)
    if (!(increments[n] > 0.0) || !std::isfinite(increments[n]))
      refuse("increment " + std::to_string(n) + " of the cost must be > 0 and finite");

  double size = 0;  // the largest term: in its unit nothing under- or overflows
  for (std::size_t n = 1; n < count; ++n) size = std::max(size, std::abs(terms[n]));
  std::vector<double> nu(count);
  double tail_sum = 0, after = 0;  // S_n, S_{n+1}
  for (std::size_t n = count; n-- > 1;) {
    tail_sum += terms[n] / size;
    nu[n] = (tail_sum - after) * (tail_sum + after);
    after = tail_sum;
  }
  const std::vector<double> shape = falling_shape(nu, increments);
  if (shape.back() == 0.0)
    refuse("the terms cancel: a sum of last terms is 0, and so would be the probability of its first");
  const auto law = [&](double log_lambda) {
    std::vector<double> tail(count, 1.0);
    for (std::size_t n = 1; n < count; ++n) tail[n] = std::min(1.0, std::exp2(log_lambda) * shape[n]);
    return TruncationLaw("variance_capped", std::move(tail));
  };
  double high = -std::log2(shape.back());  // all probabilities are 1
  double low = high;
  for (double stride = 1; variance(law(low), terms) <= max_variance; stride *= 2) low -= stride;
  while (high - low > 1e-13 * std::max(1.0, std::abs(high))) {
    const double middle = 0.5 * (low + high);
    (variance(law(middle), terms) <= max_variance ? high : low) = middle;
  }
  return law(high);
}

}  // namespace jetlag
