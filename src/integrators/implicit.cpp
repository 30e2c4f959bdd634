// SPDX-License-Identifier: MIT
#include "jetlag/integrators/implicit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "jetlag/motion/element_blocks.hpp"

namespace jetlag {

/// a(t, x, v) and its derivative in a direction.
class NewtonSolver {
 public:
  explicit NewtonSolver(const System<double>& system)
      : particles_(system.particles()), dimension_(system.dimension()), stride_(padded(dimension_)) {
    for (const auto& elements : system.elements())
      if (elements.count() > 0) {
        laws_.emplace_back(system, elements, elements.law.force, kernels<double>());
        laws_.back().reserve(2);
      }
    for (int i = 0; i < particles_; ++i)
      inverse_mass_.push_back(system.fixed()[i] ? 0.0 : 1.0 / system.mass()[i]);
    position_.resize(2 * rows());
    velocity_.resize(2 * rows());
    force_.resize(rows());
  }

  int particles() const { return particles_; }
  int dimension() const { return dimension_; }
  std::uint64_t element_coefficients() const { return element_coefficients_; }

  Coordinates<double> acceleration(const State<double>& state) {
    time_ = state.time;
    put(state.position, 0, position_);
    put(state.velocity, 0, velocity_);
    return order(0);
  }
  /// da/dx u + da/dv w at the state of the last acceleration. Fixed particles go in no direction: else the pivots of a
  /// stiff step would mix their rows with others, and they would move by a rounding.
  Coordinates<double> derivative(const Coordinates<double>& u, const Coordinates<double>& w) {
    put(u, 1, position_);
    put(w, 1, velocity_);
    return order(1);
  }

 private:
  std::size_t rows() const { return static_cast<std::size_t>(particles_) * stride_; }
  void put(const Coordinates<double>& c, int k, AlignedVector<double>& into) const {
    for (int i = 0; i < particles_; ++i)
      for (int j = 0; j < dimension_; ++j)
        into[k * rows() + i * stride_ + j] = k > 0 && inverse_mass_[i] == 0 ? 0.0 : c(i, j);
  }
  Coordinates<double> order(int k) {
    std::ranges::fill(force_, 0.0);
    // A unit of time of 0: the time stands still along the direction.
    const MotionRows<double> motion{position_.data() + k * rows(), velocity_.data() + k * rows(), rows(),
                                    time_, 0.0};
    for (auto& law : laws_) {
      if (law.running(k, 1) == 0) continue;
      for (std::size_t chunk = 0; chunk < law.chunks(); ++chunk) law.push(chunk, k, 1, motion, force_.data());
      element_coefficients_ += law.count();
    }
    Coordinates<double> a(particles_, dimension_);
    for (int i = 0; i < particles_; ++i)
      for (int j = 0; j < dimension_; ++j)
        a(i, j) = inverse_mass_[i] == 0 ? 0.0 : inverse_mass_[i] * force_[i * stride_ + j];
    return a;
  }

  int particles_, dimension_, stride_;
  std::vector<ElementBlocks<double>> laws_;
  std::vector<double> inverse_mass_;
  AlignedVector<double> position_, velocity_, force_;  // orders 0 and 1, padded rows
  double time_ = 0;
  std::uint64_t element_coefficients_ = 0;
};

namespace {

double dot(const Coordinates<double>& a, const Coordinates<double>& b) { return a.cwiseProduct(b).sum(); }

/// BiCGSTAB for A d = b from d = 0, until the residual has fallen by 1e-10 or falls no more.
/// Source: van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631.
template <class A>
Coordinates<double> bicgstab(const A& multiply, const Coordinates<double>& b, int most) {
  Coordinates<double> d = 0.0 * b, r = b, p = d, v = d;
  const Coordinates<double> shadow = b;
  double rho = 1, alpha = 1, omega = 1;
  const double goal = 1e-10 * b.norm();
  for (int i = 0; i < most && r.norm() > goal; ++i) {
    const double next = dot(shadow, r);
    if (next == 0) break;
    p = r + next / rho * (alpha / omega) * (p - omega * v);
    rho = next;
    v = multiply(p);
    alpha = rho / dot(shadow, v);
    const Coordinates<double> s = r - alpha * v, t = multiply(s);
    const double tt = dot(t, t);
    omega = tt > 0 ? dot(t, s) / tt : 0.0;
    d += alpha * p + omega * s;
    r = s - omega * t;
    if (omega == 0) break;
  }
  return d;
}

}  // namespace

ImplicitMethod::ImplicitMethod(const System<double>& system, double step)
    : OneStep(system, 2), step_(step), solver_(std::make_unique<NewtonSolver>(system)) {
  require_positive("step", step);
}
ImplicitMethod::~ImplicitMethod() = default;

Eigen::VectorXd ImplicitMethod::for_all(double factor) const {
  return Eigen::VectorXd::Constant(solver_->particles(), factor);
}

/// The components that are to be solved for, row by row.
std::vector<Eigen::Index> ImplicitMethod::unknowns(const Equations& equations) const {
  std::vector<Eigen::Index> found;
  for (int i = 0; i < solver_->particles(); ++i)
    if (equations.p(i) != 0 || (equations.q(i) != 0 && accelerations_.depend_on_velocity()))
      for (int c = 0; c < solver_->dimension(); ++c) found.push_back(i * solver_->dimension() + c);
  return found;
}

/// Newton:  (1 - r (da/dx p + da/dv q)) d = u - g - r a,   u <- u - d, until d is rounding.
bool ImplicitMethod::solve(const Equations& equations, double begin, Coordinates<double>& u, Report& report) {
  const auto& g = equations.g;
  const auto& from = equations.stage;
  const double r = equations.r;
  const auto p = equations.p.asDiagonal(), q = equations.q.asDiagonal();
  const auto multiply = [&](const Coordinates<double>& d) -> Coordinates<double> {
    return d - r * solver_->derivative(p * d, q * d);
  };
  const std::vector<Eigen::Index> unknown = unknowns(equations);
  const auto n = static_cast<Eigen::Index>(unknown.size());
  const double eps = std::numeric_limits<double>::epsilon();
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const State<double> stage{from.time, from.position + p * u, from.velocity + q * u};
    if (!all_finite(stage.position, stage.velocity, begin, report)) return false;
    const Coordinates<double> a = solver_->acceleration(stage);
    if (!a.allFinite()) {
      Coordinates<double> again;
      if (!accelerations_(stage, again, report)) return false;
    }
    const Coordinates<double> residual = u - g - r * a;
    Coordinates<double> d;
    if (n <= dense_unknowns) {
      Eigen::MatrixXd matrix(n, n);
      d = Coordinates<double>::Zero(u.rows(), u.cols());
      for (Eigen::Index k = 0; k < n; ++k) {
        d.data()[unknown[k]] = 1;
        const Coordinates<double> column = multiply(d);
        for (Eigen::Index i = 0; i < n; ++i) matrix(i, k) = column.data()[unknown[i]];
        d.data()[unknown[k]] = 0;
      }
      Eigen::VectorXd change(n);
      for (Eigen::Index i = 0; i < n; ++i) change(i) = residual.data()[unknown[i]];
      if (n > 0) change = matrix.partialPivLu().solve(change);
      for (Eigen::Index i = 0; i < n; ++i) d.data()[unknown[i]] = change(i);
      if (n < u.size()) {  // the others follow
        Coordinates<double> others = residual - multiply(d);
        for (const Eigen::Index i : unknown) others.data()[i] = 0;
        d += others;
      }
    } else {
      d = bicgstab(multiply, residual, static_cast<int>(2 * n));
    }
    other_element_coefficients_ = solver_->element_coefficients();
    if (!d.allFinite()) break;
    u -= d;
    const double change = largest(d), change_x = largest(p * d), change_v = largest(q * d),
                 of_x = std::max({largest(from.position), largest(stage.position), largest(p * u)}),
                 of_v = std::max({largest(from.velocity), largest(stage.velocity), largest(q * u)});
    if (change_x <= 2 * eps * of_x && change_v <= 2 * eps * of_v) return true;
    // At rounding, which may be that of large forces in balance, a change is no longer much smaller than the last.
    if (change >= 0.25 * last && change_x <= 1e-8 * of_x) return true;
    last = change;
  }
  std::ostringstream text;
  text << "Newton's method does not solve the implicit step from t = " << begin
       << ": the forces change too much in it; take a shorter step";
  report = {Outcome::not_converged, text.str(), -1};
  return false;
}

double ImplicitMidpoint::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  const double h = fixed_length(from, step_, limit, report);
  Coordinates<double> w;
  if (h == 0.0 || !accelerations_(from, w, report)) return 0.0;
  w = from.velocity + h / 2 * w;
  const Equations equations{from.velocity,
                            h / 2,
                            {from.time + h / 2, from.position, Coordinates<double>::Zero(w.rows(), w.cols())},
                            for_all(h / 2),
                            for_all(1.0)};
  if (!solve(equations, from.time, w, report)) return 0.0;
  to.position = from.position + h * w;
  to.velocity = 2 * w - from.velocity;
  return h;
}

double Newmark::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  const double h = fixed_length(from, step_, limit, report);
  Coordinates<double> a;
  if (h == 0.0 || !accelerations_(from, a, report)) return 0.0;
  const Equations equations{
      0.0 * a,
      1.0,
      {from.time + h, from.position + h * from.velocity + h * h / 4 * a, from.velocity + h / 2 * a},
      for_all(h * h / 4),
      for_all(h / 2)};
  Coordinates<double> end = a;
  if (!solve(equations, from.time, end, report)) return 0.0;
  to.position = equations.stage.position + h * h / 4 * end;
  to.velocity = equations.stage.velocity + h / 2 * end;
  return h;
}

/// The parabola that begins as the step does and ends where it does: of Newmark and the midpoint rule, the motion under
/// the mean acceleration.
Piece ImplicitMethod::piece() const {
  const double h = length();
  const Coordinates<double> a = (after().velocity - before().velocity) / h,
                            half = ((after().position - before().position) / h - before().velocity) / h;
  return {
      before().time, before().time + h, {before().position, before().velocity, half}, {before().velocity, a}};
}

}  // namespace jetlag
