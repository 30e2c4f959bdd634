// SPDX-License-Identifier: MIT
#include "jetlag/truncation/stable_rays.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "jetlag/truncation/stability.hpp"

namespace jetlag {

StableRays::StableRays(const TruncationLaw& law) : law_(law) {
  constexpr int cells = 64;
  constexpr double quarter = std::numbers::pi / 2;
  for (int i = 0; i <= cells; ++i) rays_.push_back({quarter * i / cells, exit(quarter * i / cells)});
  std::vector<Ray> least;
  for (int i = 1; i < cells; ++i)
    if (rays_[i].exit <= std::min(rays_[i - 1].exit, rays_[i + 1].exit))
      least.push_back(least_between(rays_[i - 1].angle, rays_[i + 1].angle));
  rays_.insert(rays_.end(), least.begin(), least.end());
  std::ranges::sort(rays_, {}, &Ray::angle);
}

/// Both axes to their last digit. Strides as long as the rays are apart.
double StableRays::exit(double angle) const {
  const bool is_real = angle >= std::numbers::pi / 2;
  return stability_limit(law_, Growth::mean_square,
                         {is_real ? -1.0 : -std::sin(angle), is_real ? 0.0 : std::cos(angle)}, 0x1p-6);
}

/// By thirds: the exit is least to the square of the width that is left.
StableRays::Ray StableRays::least_between(double low, double high) const {
  while (high - low > 1e-5) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (exit(a) < exit(b) ? high : low) = exit(a) < exit(b) ? b : a;
  }
  const double middle = 0.5 * (low + high);
  return {middle, exit(middle)};
}

double StableRays::step(const ModeBounds& bounds) const {
  const auto& [omega, least, most] = bounds;
  double step = most > 0 ? rays_.back().exit / most : std::numeric_limits<double>::infinity();
  if (!(0.5 * least < omega)) return step;
  // The largest |lambda| on a ray, the larger the nearer to the imaginary axis.
  const auto farthest = [&](double angle) {
    return 2 * std::sin(angle) * omega <= most ? omega : most / (2 * std::sin(angle));
  };
  Ray from = rays_.front();
  if (least > 0) {
    const double corner = std::asin(0.5 * least / omega);
    from = {corner, exit(corner)};
  }
  for (const Ray& to : rays_) {
    if (to.angle <= from.angle) continue;
    step = std::min(step, std::min(from.exit, to.exit) / farthest(from.angle));
    from = to;
  }
  return step;
}

}  // namespace jetlag
