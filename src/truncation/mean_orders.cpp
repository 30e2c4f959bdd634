// SPDX-License-Identifier: MIT
#include "jetlag/truncation/mean_orders.hpp"

#include <algorithm>
#include <cmath>

namespace jetlag {

double largest_at_least(const TruncationLaw& law, const StepDraws& draws, int n) {
  const double p = law.at_least(n);
  const int moving = draws.moving, all = draws.particles;
  if (draws.shared || moving == 0) return p;
  if (draws.kind != Draw::stratified) return -std::expm1(moving * std::log1p(-p));
  const double sure = std::floor(all * p);
  double none = 1;  // of the moving ones
  for (int i = 0; i < sure && none > 0; ++i) none *= double(std::max(0, all - moving - i)) / (all - i);
  return 1 - none * (sure < all ? 1 - (all * p - sure) * std::min(1.0, moving / (all - sure)) : 1.0);
}

double mean_orders(const TruncationLaw& law, const StepDraws& draws, VelocitySeries velocity, int read) {
  const int more = velocity == VelocitySeries::own_series ? 1 : 0;
  double mean = 0;  // E max(largest K + more, read), from its tail
  for (int n = 1; n <= std::max(law.max_degree() + more, read); ++n)
    mean += n <= read || n <= more ? 1.0 : largest_at_least(law, draws, n - more);
  return std::max(mean, 1.0) - 1;
}

}  // namespace jetlag
