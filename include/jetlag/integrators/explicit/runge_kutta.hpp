// SPDX-License-Identifier: MIT
#pragma once
// Explicit Runge-Kutta methods. A method is a table and a docstring (rk4.hpp, dopri5.hpp, dop853.hpp); the loop is here.

#include <limits>
#include <optional>
#include <vector>

#include "jetlag/integrators/force_rounding.hpp"
#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

/// k_i = f(t + c_i h, y + h sum_{j<i} a_ij k_j),   y_1 = y + h sum_i b_i k_i,   c_i = sum_j a_ij.
struct RungeKuttaTable {
  const char* name;
  int order;
  std::vector<std::vector<double>> a;  // row i has i entries, beginning with the empty row of stage 0
  std::vector<double> b;
  std::vector<double> error{};  // of an embedded method: estimate h sum_i error_i k_i of order error_order
  int error_order = 0;
  std::vector<double> second_error{};  // dop853: see there

  int stages() const { return static_cast<int>(b.size()); }
  std::vector<double> c() const;
};

/// Steps of a method that estimates its own error.
struct EmbeddedControl {
  double tolerance = 1e-9;  // > 0: relative to the largest components of positions and of velocities
  double max_step = std::numeric_limits<double>::infinity();  // [s], > 0
};

class RungeKutta final : public OneStep {
 public:
  /// Fixed steps [s], > 0. Throws std::invalid_argument.
  RungeKutta(const System<double>& system, const RungeKuttaTable& table, double step);

  /// Steps by the estimated error e: a step is taken where
  ///     E = max(|e_x| / max(|x_0|, |x_1|, |h v_0|), |e_v| / max(|v_0|, |v_1|, |h a_0|)) / tolerance <= 1
  /// in largest components over all particles, and otherwise tried again and counted in Work::rejected; the next
  /// length is h clamp(0.9 E^(-1/q), 1/5, 6), q the order of the estimate. The first is first_length().
  /// Source: [HNW93] II.4, with norms in place of components.
  /// To what is allowed of |e_x| and |e_v| is added what rounding makes of them: eps of the same sizes, so that no
  /// tolerance asks for more than doubles have, and that of the forces (force_rounding.hpp), so that at rest and far
  /// from the origin the step grows to the border of stability. Throws std::invalid_argument for a table without an
  /// estimate.
  RungeKutta(const System<double>& system, const RungeKuttaTable& table, const EmbeddedControl& control);

  /// Hermite's interpolation of both ends, in positions, velocities, accelerations and, from order 6 on, their
  /// derivatives: x to O(h^6) or O(h^8), v to one order less. It computes them anew, uncounted. Where it is less
  /// accurate than the method (dop853, whose order is 8) it is so between the ends of steps only.
  Piece piece() const override;

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;
  bool attempt(const State<double>& from, double h, int first, State<double>& to, Report& report);
  double error_ratio(const State<double>& from, double h, const State<double>& to);

  RungeKuttaTable table_;
  std::vector<double> c_;
  std::optional<EmbeddedControl> control_;
  double step_;                             // the one to try next; 0: none yet
  std::vector<Coordinates<double>> v_, a_;  // of the stages
  ForceRounding rounding_;
  mutable Accelerations of_piece_;
};

}  // namespace jetlag
