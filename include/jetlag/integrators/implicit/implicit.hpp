// SPDX-License-Identifier: MIT
#pragma once
// Implicit methods for stiff systems: the midpoint rule and Newmark's method, solved to rounding by Newton's method with
// the exact Jacobian of the forces.
//
// The Jacobian comes from the tape: coefficient 1 of the forces along x(t) = x + t u, v(t) = v + t w is its product with
// (u, w), for one order of every element. BiCGSTAB solves the equations with such products, without a matrix; where a
// hundred of its iterations do not, and for few unknowns at once, the matrix is assembled, a colour of particles at a
// time, and factored, dense or sparse. Beyond `factored_unknowns` unknown components there is no matrix.

#include <memory>
#include <vector>

#include "jetlag/integrators/one_step.hpp"

namespace jetlag {

class NewtonSolver;

/// What they have in common. The equations of a step:  u = g + r a(t_s, x_s + p u, v_s + q u),  with one unknown u for
/// each component and p, q for each particle. Where p is 0 and no force reads what q moves, u follows from the others.
class ImplicitMethod : public OneStep {
 public:
  ~ImplicitMethod() override;
  /// Lines in position and velocity, errors of O(h^2): nothing within a stiff step has more energy than its ends.
  Piece piece() const override;
  static constexpr int factored_unknowns = 100000;

 protected:
  ImplicitMethod(const System<double>& system, double step);
  struct Equations {
    Coordinates<double> g;
    double r;
    State<double> stage;   // t_s, x_s, v_s
    Eigen::VectorXd p, q;  // shape (particles)
  };
  /// Solves them from a guess, which should leave the particles where they are: accelerations that are taken over a stiff
  /// step throw them through each other, to solutions that are none of the motion. False with a report where Newton's method does not converge.
  bool solve(const Equations& equations, double begin, Coordinates<double>& u, Report& report);

  Eigen::VectorXd for_all(double factor) const;  // shape (particles)

  double step_;

 private:
  std::vector<Eigen::Index> unknowns(const Equations& equations) const;

  std::unique_ptr<NewtonSolver> solver_;
};

/// y_1 = y_0 + h f(t + h/2, (y_0 + y_1)/2).   Order 2, symmetric, symplectic, A-stable; conserves quadratic invariants
/// (momentum, angular momentum) to rounding; damping and forces that depend on time are welcome.
/// Solved for the mean velocity w:  w = v_0 + h/2 a(x_0 + h/2 w, w),  x_1 = x_0 + h w,  v_1 = 2 w - v_0.
/// Source: [HLW06] II.1.3, VI.4.
class ImplicitMidpoint final : public ImplicitMethod {
 public:
  /// step [s], > 0. Throws std::invalid_argument.
  ImplicitMidpoint(const System<double>& system, double step) : ImplicitMethod(system, step) {}

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;
};

/// x_1 = x_0 + h v_0 + h^2/4 (a_0 + a_1),   v_1 = v_0 + h/2 (a_0 + a_1):  beta = 1/4, gamma = 1/2, the mean acceleration.
/// Order 2, symmetric, A-stable; on linear systems it conserves the energy.
/// Source: Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67.
class Newmark final : public ImplicitMethod {
 public:
  /// step [s], > 0. Throws std::invalid_argument.
  Newmark(const System<double>& system, double step) : ImplicitMethod(system, step) {}

 private:
  double advance(const State<double>& from, double limit, State<double>& to, Report& report) override;
};

}  // namespace jetlag
