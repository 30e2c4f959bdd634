// SPDX-License-Identifier: MIT
#pragma once
// The room of problems, for tests, and what is known of their motion in closed form.

#include <Eigen/Core>
#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "problems/chains.hpp"
#include "problems/laws.hpp"
#include "problems/nets.hpp"
#include "problems/particles.hpp"
#include "problems/planets.hpp"

namespace jetlag::testing {

using namespace problems;

/// Where planet(e) is: Kepler's equation  E - e sin E = t,
///     x = (cos E - e, sqrt(1 - e^2) sin E),   v = (-sin E, sqrt(1 - e^2) cos E) / (1 - e cos E).
/// Solved in 80 bits, so that the truth has more digits than what is compared with it.
struct KeplerPoint {
  Eigen::RowVector2d position, velocity;
};

inline KeplerPoint kepler(double e, double t) {
  using Real = long double;
  const Real turn = boost::math::constants::two_pi<Real>();
  const Real mean = std::remainder(static_cast<Real>(t), turn);
  const auto f = [&](Real anomaly) {
    return std::pair(anomaly - e * std::sin(anomaly) - mean, 1 - e * std::cos(anomaly));
  };
  const Real anomaly = boost::math::tools::newton_raphson_iterate(
      f, mean + e * std::sin(mean), mean - e, mean + e, std::numeric_limits<Real>::digits - 1);
  const Real c = std::cos(anomaly), s = std::sin(anomaly), b = std::sqrt((1 - Real(e)) * (1 + Real(e)));
  const Real distance = 1 - e * c;
  KeplerPoint point;
  point.position << static_cast<double>(c - e), static_cast<double>(b * s);
  point.velocity << static_cast<double>(-s / distance), static_cast<double>(b * c / distance);
  return point;
}

}  // namespace jetlag::testing
