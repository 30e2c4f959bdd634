// SPDX-License-Identifier: MIT
#pragma once
// First-order systems y' = f(t, y, p), as a user of the library would write them.

#include <array>

namespace jetlag::problems {

/// A body of no mass near the earth and the moon, in coordinates that turn with them: (x, y, x', y'), p = (mu).
/// Source: Arenstorf, Amer. J. Math. 85 (1963) 27.
inline constexpr auto arenstorf = [](const auto&, const auto& u, const auto& p) {
  const auto mu = p[0], rest = 1.0 - p[0];
  const auto to_earth = u[0] + mu, to_moon = u[0] - rest, yy = u[1] * u[1];
  const auto earth = rest * pow(to_earth * to_earth + yy, -1.5),
             moon = mu * pow(to_moon * to_moon + yy, -1.5);
  return std::array{u[2], u[3], u[0] + 2.0 * u[3] - earth * to_earth - moon * to_moon,
                    u[1] - 2.0 * u[2] - (earth + moon) * u[1]};
};

/// Source: DETEST, problem B1: Hull et al., SIAM J. Numer. Anal. 9 (1972) 603.
inline constexpr auto lotka_volterra = [](const auto&, const auto& y) {
  return std::array{2.0 * (y[0] - y[0] * y[1]), y[0] * y[1] - y[1]};
};

/// y_i' = p_i y_j y_k.         Source: Euler 1758; p = (1, -1, -0.51) is DETEST, problem B5.
inline constexpr auto euler_rigid = [](const auto&, const auto& y, const auto& p) {
  return std::array{p[0] * (y[1] * y[2]), p[1] * (y[2] * y[0]), p[2] * (y[0] * y[1])};
};

/// Source: DETEST, problem E2.
inline constexpr auto van_der_pol = [](const auto&, const auto& y) {
  return std::array{y[1], (1.0 - y[0] * y[0]) * y[1] - y[0]};
};

/// p = (sigma, rho, beta).         Source: Lorenz, J. Atmos. Sci. 20 (1963) 130.
inline constexpr auto lorenz = [](const auto&, const auto& y, const auto& p) {
  return std::array{p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - y[1], y[0] * y[1] - p[2] * y[2]};
};

/// Two equal bobs on equal rods: (theta_1, theta_2, omega_1, omega_2), p = (g / l).
inline constexpr auto double_pendulum = [](const auto&, const auto& u, const auto& p) {
  const auto difference = u[0] - u[1], first = u[2] * u[2], second = u[3] * u[3];
  const auto s = sin(difference), c = cos(difference), share = 2.0 - c * c;
  return std::array{u[2], u[3],
                    (c * (p[0] * sin(u[1]) - s * first) - s * second - 2.0 * p[0] * sin(u[0])) / share,
                    (s * (2.0 * first + 2.0 * p[0] * cos(u[0]) + c * second)) / share};
};

}  // namespace jetlag::problems
