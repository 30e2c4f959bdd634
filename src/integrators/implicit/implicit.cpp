// SPDX-License-Identifier: MIT
#include "jetlag/integrators/implicit/implicit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "integrators/implicit/linear_solver.hpp"
#include "model/element_jacobian.hpp"

namespace jetlag {

/// a(t, x, v), its derivative in a direction, and the solution of a linearised step.
class NewtonSolver {
 public:
  explicit NewtonSolver(const Model<double>& model)
      : model_(model), all_(model, [](auto) { return true; }), inverse_mass_(model.particles()) {
    for (int i = 0; i < particles(); ++i) inverse_mass_(i) = model.inverse_mass(i);
  }

  int particles() const { return model_.particles(); }
  int dimension() const { return model_.dimension(); }
  std::uint64_t element_coefficients() const {
    return all_.element_coefficients() + (part_ ? part_->element_coefficients() : 0) + earlier_;
  }

  Coordinates<double> acceleration(const State<double>& state) {
    return inverse_mass_.asDiagonal() * all_.force(state);
  }
  /// da/dx u + da/dv w at the state of the last acceleration. Fixed particles go in no direction: else the pivots of a
  /// stiff step would mix their rows with others, and they would move by a rounding.
  Coordinates<double> derivative(const Coordinates<double>& u, const Coordinates<double>& w) {
    return inverse_mass_.asDiagonal() * all_.product(u, w);
  }

  /// d with (1 - r (da/dx p + da/dv q)) d = b at the state of the last acceleration, in the unknown components, which are those of whole particles;
  /// zero in the others.
  Coordinates<double> solve(const State<double>& state, const std::vector<Eigen::Index>& unknown, double r,
                            const Eigen::VectorXd& p, const Eigen::VectorXd& q,
                            const Coordinates<double>& b) {
    ElementJacobian& jacobian = jacobian_of(unknown, state);
    entries_.clear();
    const int n = static_cast<int>(unknown.size());
    for (int i = 0; i < n; ++i) entries_.emplace_back(i, i, 1.0);
    using By = ElementJacobian::By;
    for (const auto& [by, factor] : {std::pair(By::position, &p), std::pair(By::velocity, &q)}) {
      jacobian.derivatives(by, derivatives_);
      for (const JacobianEntry& entry : derivatives_)
        if (place_[entry.row] >= 0)
          entries_.emplace_back(place_[entry.row], place_[entry.column],
                                -r * inverse_mass_(entry.row / dimension()) *
                                    (*factor)(entry.column / dimension()) * entry.value);
    }
    Eigen::VectorXd right(n);
    for (int i = 0; i < n; ++i) right(i) = b.data()[unknown[i]];
    const Eigen::VectorXd change = linear_.solve(n, entries_, right);
    Coordinates<double> d = Coordinates<double>::Zero(b.rows(), b.cols());
    for (int i = 0; i < n; ++i) d.data()[unknown[i]] = change(i);
    return d;
  }

 private:
  /// The Jacobian by the unknown components, at a state: of all elements, or of those that touch one of a few. Which ones
  /// these are is the same in every step of a method.
  ElementJacobian& jacobian_of(const std::vector<Eigen::Index>& unknown, const State<double>& state) {
    if (unknown != unknown_ || place_.empty()) {
      unknown_ = unknown;
      place_.assign(static_cast<std::size_t>(particles()) * dimension(), -1);
      for (std::size_t i = 0; i < unknown.size(); ++i) place_[unknown[i]] = static_cast<int>(i);
      const auto is_unknown = [&](int particle) { return place_[particle * dimension()] >= 0; };
      bool are_all = true;
      for (int i = 0; i < particles(); ++i) are_all = are_all && (is_unknown(i) || model_.is_fixed(i));
      if (part_) earlier_ += part_->element_coefficients();
      part_ = are_all ? nullptr
                      : std::make_unique<ElementJacobian>(
                            model_, [&](auto members) { return std::ranges::any_of(members, is_unknown); },
                            is_unknown);
    }
    if (!part_) return all_;
    part_->force(state);
    return *part_;
  }

  Model<double> model_;
  ElementJacobian all_;
  Eigen::VectorXd inverse_mass_;
  std::vector<Eigen::Index> unknown_;
  std::vector<int> place_;                 // of each component among the unknowns; -1: it is none
  std::unique_ptr<ElementJacobian> part_;  // null: all
  std::vector<JacobianEntry> derivatives_;
  LinearSolver::Entries entries_;
  LinearSolver linear_;
  std::uint64_t earlier_ = 0;  // coefficients of Jacobians that are gone
};

namespace {

double dot(const Coordinates<double>& a, const Coordinates<double>& b) { return a.cwiseProduct(b).sum(); }

constexpr int few_products = 100, most_products = 1000;  // iterations, of two products each

struct Iterated {
  Coordinates<double> d;
  bool converged;
};

/// BiCGSTAB for A d = b from d = 0, until the residual has fallen by 1e-10 or falls no more.
/// Source: van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631.
template <class A>
Iterated bicgstab(const A& multiply, const Coordinates<double>& b, int most) {
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
  return {d, r.norm() <= goal};  // false for what is not a number
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
  bool factor = n <= LinearSolver::dense_unknowns;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const State<double> stage{from.time, from.position + p * u, from.velocity + q * u};
    if (!all_finite(stage.position, stage.velocity, begin, report)) return false;
    const Coordinates<double> a = solver_->acceleration(stage);
    if (!a.allFinite()) {
      Coordinates<double> again;
      if (!accelerations_(stage, again, report)) return false;
    }
    const Coordinates<double> residual = u - g - r * a;
    // A few products solve what is little stiff; a factorisation is dear, and solves the rest.
    Iterated change_of{{}, false};
    if (!factor)
      change_of = bicgstab(multiply, residual, n <= factored_unknowns ? few_products : most_products);
    factor = n <= factored_unknowns && !change_of.converged;  // in the iterations to come too
    Coordinates<double>& d = change_of.d;
    if (factor) {
      d = solver_->solve(stage, unknown, r, equations.p, equations.q, residual);
      if (n < u.size()) {  // the others follow
        Coordinates<double> others = residual - multiply(d);
        for (const Eigen::Index i : unknown) others.data()[i] = 0;
        d += others;
      }
    }
    other_element_coefficients_ = solver_->element_coefficients();
    if (!d.allFinite()) {
      // An overflow of the motion is that; without one the equations have no solution.
      const double most = std::max({largest(from.position), largest(from.velocity), largest(residual)});
      if (most < 1e300) break;
      const Coordinates<double> position = stage.position - p * d, velocity = stage.velocity - q * d;
      if (!all_finite(position, velocity, begin, report)) return false;
      break;
    }
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
  if (h == 0.0 || !accelerations_(from, w, report))
    return 0.0;  // says where a motion begins at a singular point
  w.setZero();
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
  Coordinates<double> end = -4 / h * from.velocity - a;
  if (!solve(equations, from.time, end, report)) return 0.0;
  to.position = equations.stage.position + h * h / 4 * end;
  to.velocity = equations.stage.velocity + h / 2 * end;
  return h;
}

Piece ImplicitMethod::piece() const {
  const double h = length();
  return {before().time,
          before().time + h,
          {before().position, (after().position - before().position) / h},
          {before().velocity, (after().velocity - before().velocity) / h}};
}

}  // namespace jetlag
