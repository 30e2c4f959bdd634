// SPDX-License-Identifier: MIT
#pragma once
// Which series the velocity is taken from when a series is stopped at degree K.

namespace jetlag {

/// Two ways to stop the velocity with the position.
enum class VelocitySeries {
  own_series,  // its own, v = sum_{n<=K} w_n v_n h^n: one coefficient more of x is needed
  derivative,  // the derivative of the position's, v = sum_{1<=n<=K} w_n n x_n h^{n-1}: one order less
};

/// The order up to which positions must be known for a stop at this degree.
constexpr int order_needed(int degree, VelocitySeries velocity) {
  return velocity == VelocitySeries::own_series ? degree + 1 : degree;
}

}  // namespace jetlag
