// SPDX-License-Identifier: MIT
#pragma once
// Gauss-Radau integration of order 15 (the method of IAS15).

#include <array>
#include <limits>
#include <optional>

#include "jetlag/integrators/force_rounding.hpp"
#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

/// The accelerations over a step are a polynomial of degree 7 in theta = s/h, through those at the eight nodes
/// 0 = h_0 < h_1 .. h_7 < 1 of Gauss and Radau,
///     x'' = a_0 + b_0 theta + .. + b_6 theta^7 = a_0 + g_0 theta + g_1 theta (theta - h_1) + ..,
/// found by iteration: the b of the last step, continued, predict the positions and velocities at the nodes, the forces
/// there correct the b, until b_6 changes by less than rounding or no less than before. Then
///     x_1 = x_0 + h v_0 + h^2 (a_0/2 + sum_k b_k / ((k+2)(k+3))),   v_1 = v_0 + h (a_0 + sum_k b_k / (k+2)).
/// Order 15, accurate to rounding with the steps of its control; positions and velocities are compensated sums. Forces
/// may depend on velocities. Seven force evaluations in each iteration, mostly two or three of them.
/// Source: Rein, Spiegel, MNRAS 446 (2015) 1424 [RS15]; Everhart 1985.
class GaussRadau final : public OneStep {
 public:
  /// Steps h = h_last (tolerance |a| / |b_6|)^(1/7), in largest components, of a at all nodes; a step that would have
  /// to be shorter than a quarter is taken again, and none is more than four times its predecessor: [RS15] eq. 11. What
  /// b_6 may be by rounding alone (force_rounding.hpp) is allowed where it is more than tolerance |a|, at rest, far
  /// from the origin or with a tolerance below some 1e-11: steps are then as short as rounding lets b_6 tell, not
  /// shorter.
  struct Options {
    double tolerance = 1e-9;                                    // eps_b > 0
    double max_step = std::numeric_limits<double>::infinity();  // [s], > 0
    std::optional<double> step{};  // [s], > 0: steps of this length in place of those
  };
  /// Throws std::invalid_argument.
  GaussRadau(const System<double>& system, const Options& options);

  /// Its own polynomials, of degree 9 in the position and 8 in the velocity: errors of O(h^10) and O(h^9) within a
  /// step.
  Piece piece() const override;

  static constexpr int nodes = 8;
  static const std::array<double, nodes>& node();

 private:
  using Coefficients = std::array<Coordinates<double>, nodes - 1>;

  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;
  bool solve(const State<double>& from, double h, Report& report);
  void predict(const State<double>& from, double h);
  double wanted(const State<double>& from, double h);
  double rounding(const State<double>& from, double h);
  State<double> at(const State<double>& from, double h, double theta) const;

  Options options_;
  ForceRounding rounding_;
  std::optional<double> last_rounding_;  // of b_6, in the step that is tried
  double step_ = 0;                      // the one to try next; 0: none yet
  Coordinates<double> a_;
  Coefficients b_, g_, guess_;
  double largest_a_ = 0;    // at all nodes
  double last_length_ = 0;  // of the step that b_ belongs to; 0: none
  State<double> end_;       // of that step
};

}  // namespace jetlag
