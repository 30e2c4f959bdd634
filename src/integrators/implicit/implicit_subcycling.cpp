// SPDX-License-Identifier: MIT
#include "jetlag/integrators/implicit/implicit_subcycling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "integrators/implicit/linear_solver.hpp"
#include "model/element_jacobian.hpp"

namespace jetlag {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Triplets = LinearSolver::Entries;
using By = ElementJacobian::By;

std::vector<bool> chosen(const System<double>& system, const std::vector<int>& particles) {
  std::vector<bool> is_chosen(system.particles(), false);
  for (const int i : particles) is_chosen[i] = true;
  return is_chosen;
}

bool has_fine(const System<double>& system, const std::vector<bool>& coarse, std::span<const int> members) {
  return std::ranges::any_of(members, [&](int i) { return !coarse[i] && !system.fixed()[i]; });
}

constexpr double gibibyte = 1 << 30, most_bytes = 2 * gibibyte;  // of a cycle

/// How many substeps of at most dt a cycle of length h <= ratio * dt takes; h / dt may be some roundings too large.
int substeps(double h, double dt, int ratio) {
  if (h >= ratio * dt) return ratio;
  return std::clamp(static_cast<int>(std::ceil(h / dt * (1 - 1e-9))), 1, ratio);
}

}  // namespace

/// A cycle, and Newton's method on it.
class SubcyclingSolver {
 public:
  SubcyclingSolver(const System<double>& system, const std::vector<int>& coarse)
      : dimension_(system.dimension()),
        coarse_(chosen(system, coarse)),
        mass_(system.mass()),
        fine_elements_(system, [&](auto members) { return has_fine(system, coarse_, members); }),
        coarse_elements_(system, [&](auto members) { return !has_fine(system, coarse_, members); }) {
    place_.assign(system.particles() * dimension_, -1);
    int fine = 0, all_coarse = 0;
    for (const bool of_interface : {true, false})  // first of the coarse ones
      for (int i = 0; i < system.particles(); ++i)
        if (coarse_[i] && !system.fixed()[i] && fine_elements_.touches(i) == of_interface) {
          for (int c = 0; c < dimension_; ++c) place_[i * dimension_ + c] = all_coarse++;
          if (of_interface) interface_ = all_coarse;
        }
    for (int i = 0; i < system.particles(); ++i)
      if (!coarse_[i] && !system.fixed()[i])
        for (int c = 0; c < dimension_; ++c) place_[i * dimension_ + c] = fine++;
    fine_unknowns_ = fine;
    coarse_unknowns_ = all_coarse;
  }

  std::uint64_t element_coefficients() const {
    return fine_elements_.element_coefficients() + coarse_elements_.element_coefficients();
  }

  /// About what a cycle keeps, in bytes: of each substep the state, and the change of its fine velocities with their
  /// response to the interface; six more such matrices in work; and i^2 numbers in the pull on the interface, in the
  /// entries of the coarse matrix, in that matrix and in its factors.
  double bytes(int ratio) const {
    const double m = ratio, i = interface_;
    return 8 * ((m + 6) * fine_unknowns_ * (1 + i) + 2 * (m + 1) * static_cast<double>(place_.size()) +
                8 * i * i);
  }
  int fine_unknowns() const { return fine_unknowns_; }
  int interface_unknowns() const { return interface_; }

  /// The states at the ends of the substeps, all in one place, by velocities to and fro: from there the first pass is a
  /// linearly implicit method. Accelerations taken over a stiff step would lead far away.
  void stand_still(const State<double>& from, double h, int ratio) {
    ratio_ = ratio;
    h_ = h;
    dt_ = h / ratio_;
    states_.assign(ratio_ + 1, from);
    for (int j = 1; j <= ratio_; ++j) states_[j].time = from.time + j * dt_;
    for_each(false, [&](int g, int) {
      for (int j = 1; j <= ratio_; j += 2) states_[j].velocity.data()[g] = -from.velocity.data()[g];
    });
    for_each(true, [&](int g, int) { states_.back().velocity.data()[g] = -from.velocity.data()[g]; });
    move();
    first_fine_ = fine_elements_.force(from);
    first_coarse_ = coarse_elements_.force(from);
  }
  const State<double>& end() const { return states_.back(); }
  bool finite(double begin, Report& report) const {
    return std::ranges::all_of(states_, [&](const State<double>& state) {
      return all_finite(state.position, state.velocity, begin, report);
    });
  }

  /// One pass of Newton's method. Returns the largest change of a velocity; where the equations have no solution
  /// the states are no longer finite.
  double improve();

  /// The largest velocities and positions of the cycle.
  double speed() const {
    return over_states([](const State<double>& s) { return largest(s.velocity); });
  }
  double distance() const {
    return over_states([](const State<double>& s) { return largest(s.position); });
  }

 private:
  template <class F>
  double over_states(F f) const {
    double most = 0;
    for (const auto& state : states_) most = std::max(most, f(state));
    return most;
  }
  bool is_coarse(int component) const { return coarse_[component / dimension_]; }
  double mass(int component) const { return mass_[component / dimension_]; }
  /// f(component, place) for the moving components of one part.
  template <class F>
  void for_each(bool coarse, F f) const {
    for (int g = 0; g < static_cast<int>(place_.size()); ++g)
      if (place_[g] >= 0 && is_coarse(g) == coarse) f(g, place_[g]);
  }

  void move();

  int dimension_;
  int ratio_ = 1;  // of this cycle
  std::vector<bool> coarse_;
  std::vector<double> mass_;
  ElementJacobian fine_elements_, coarse_elements_;  // with a fine particle; without
  std::vector<int> place_;                           // of a component in its part; -1: fixed
  int fine_unknowns_ = 0, coarse_unknowns_ = 0, interface_ = 0;
  double h_ = 0, dt_ = 0;
  std::vector<State<double>> states_;  // 0 .. ratio
  Coordinates<double> first_fine_, first_coarse_;
  std::vector<JacobianEntry> by_position_, by_velocity_;
  LinearSolver fine_solver_, coarse_solver_;
};

/// All positions, and coarse velocities within the cycle, from the other velocities.
void SubcyclingSolver::move() {
  const State<double>& first = states_.front();
  State<double>& last = states_.back();
  for_each(true, [&](int g, int) {
    const double x = first.position.data()[g], v = first.velocity.data()[g], v_end = last.velocity.data()[g];
    const double way = h_ / 2 * (v + v_end);
    for (int j = 1; j <= ratio_; ++j) {
      const double share = static_cast<double>(j) / ratio_;
      states_[j].position.data()[g] = x + share * way;
      if (j < ratio_) states_[j].velocity.data()[g] = v + share * (v_end - v);
    }
  });
  for_each(false, [&](int g, int) {
    for (int j = 0; j < ratio_; ++j)
      states_[j + 1].position.data()[g] =
          states_[j].position.data()[g] +
          dt_ / 2 * (states_[j].velocity.data()[g] + states_[j + 1].velocity.data()[g]);
  });
}

/// Column 0 of what follows: the change of a fine part that moves freely. The others: its response to a change of the
/// velocity at the end of the cycle of each component of the interface.
double SubcyclingSolver::improve() {
  const int columns = 1 + interface_;
  MatrixXd dx = MatrixXd::Zero(fine_unknowns_, columns), dv = dx, of_force = dx;
  std::vector<MatrixXd> changes;                        // of the velocities, step by step
  MatrixXd pull = MatrixXd::Zero(interface_, columns);  // dt sum_j of the changes of the mean force
  VectorXd impulse = VectorXd::Zero(coarse_unknowns_);  // of all forces on coarse particles
  const auto add = [&](double weight, const Coordinates<double>& force) {
    for_each(true, [&](int g, int p) { impulse(p) += weight * force.data()[g]; });
  };
  add(dt_ / 2, first_fine_);
  add(h_ / 2, first_coarse_);

  Coordinates<double> before = first_fine_;
  for (int j = 1; j <= ratio_; ++j) {
    const Coordinates<double> force = fine_elements_.force(states_[j]);
    fine_elements_.derivatives(By::position, by_position_);
    fine_elements_.derivatives(By::velocity, by_velocity_);
    const double share = static_cast<double>(j) / ratio_;
    // Known parts of dx and of the forces: all but the new dv.
    dx += dt_ / 2 * dv;
    MatrixXd right = dt_ / 2 * of_force, on_fine = MatrixXd::Zero(fine_unknowns_, columns),
             on_interface = MatrixXd::Zero(interface_, columns);
    Triplets matrix;
    for_each(false, [&](int g, int p) {
      right.row(p) += mass(g) * dv.row(p);
      right(p, 0) -= mass(g) * (states_[j].velocity.data()[g] - states_[j - 1].velocity.data()[g]) -
                     dt_ / 2 * (before.data()[g] + force.data()[g]);
      matrix.emplace_back(p, p, mass(g));
    });
    const auto known = [&](const JacobianEntry& entry, const MatrixXd* of_fine, double of_interface) {
      auto row = is_coarse(entry.row) ? on_interface.row(place_[entry.row]) : on_fine.row(place_[entry.row]);
      const int p = place_[entry.column];
      if (is_coarse(entry.column))
        row(1 + p) += entry.value * of_interface;
      else if (of_fine)
        row += entry.value * of_fine->row(p);
    };
    for (const auto& entry : by_position_) known(entry, &dx, share * h_ / 2);
    for (const auto& entry : by_velocity_) known(entry, nullptr, share);
    const auto to_matrix = [&](const JacobianEntry& entry, double factor) {
      if (!is_coarse(entry.row) && !is_coarse(entry.column))
        matrix.emplace_back(place_[entry.row], place_[entry.column], -dt_ / 2 * factor * entry.value);
    };
    for (const auto& entry : by_position_) to_matrix(entry, dt_ / 2);
    for (const auto& entry : by_velocity_) to_matrix(entry, 1);
    dv = fine_solver_.solve(fine_unknowns_, matrix, right + dt_ / 2 * on_fine);
    dx += dt_ / 2 * dv;
    const auto new_part = [&](const JacobianEntry& entry, double factor) {
      if (is_coarse(entry.column)) return;
      auto row = is_coarse(entry.row) ? on_interface.row(place_[entry.row]) : on_fine.row(place_[entry.row]);
      row += factor * entry.value * dv.row(place_[entry.column]);
    };
    for (const auto& entry : by_position_) new_part(entry, dt_ / 2);
    for (const auto& entry : by_velocity_) new_part(entry, 1);
    changes.push_back(dv);
    of_force = std::move(on_fine);
    const double weight = j < ratio_ ? dt_ : dt_ / 2;
    pull += weight * on_interface;
    add(weight, force);
    before = force;
  }

  // The coarse equations, condensed: their own Jacobian, and the pull of the fine part.
  add(h_ / 2, coarse_elements_.force(states_.back()));
  VectorXd right = impulse;
  Triplets matrix;
  for_each(true, [&](int g, int p) {
    right(p) -= mass(g) * (states_.back().velocity.data()[g] - states_.front().velocity.data()[g]);
    matrix.emplace_back(p, p, mass(g));
  });
  right.head(interface_) += pull.col(0);
  for (int p = 0; p < interface_; ++p)
    for (int q = 0; q < interface_; ++q) matrix.emplace_back(p, q, -pull(p, 1 + q));
  for (const auto& [by, factor] : {std::pair(By::position, h_ / 2), std::pair(By::velocity, 1.0)}) {
    coarse_elements_.derivatives(by, by_position_);
    for (const auto& entry : by_position_)
      matrix.emplace_back(place_[entry.row], place_[entry.column], -h_ / 2 * factor * entry.value);
  }
  const VectorXd change = coarse_solver_.solve(coarse_unknowns_, matrix, right);

  double most = change.size() > 0 ? change.cwiseAbs().maxCoeff() : 0.0;
  for_each(true, [&](int g, int p) { states_.back().velocity.data()[g] += change(p); });
  for (int j = 1; j <= ratio_; ++j) {
    const VectorXd fine =
        changes[j - 1].col(0) + changes[j - 1].rightCols(interface_) * change.head(interface_);
    if (fine.size() > 0) most = std::max(most, fine.cwiseAbs().maxCoeff());
    for_each(false, [&](int g, int p) { states_[j].velocity.data()[g] += fine(p); });
  }
  move();
  return most;
}

ImplicitSubcycling::ImplicitSubcycling(const System<double>& system, Options options)
    : OneStep(system, 2), options_(std::move(options)) {
  require_positive("step", options_.step);
  if (options_.ratio < 1)
    throw std::invalid_argument("implicit_subcycling: the ratio must be at least 1, got " +
                                std::to_string(options_.ratio));
  std::vector<bool> named(system.particles(), false);
  for (const int i : options_.coarse) {
    if (i < 0 || i >= system.particles())
      throw std::invalid_argument("implicit_subcycling: coarse particle " + std::to_string(i) +
                                  " does not exist, there are " + std::to_string(system.particles()));
    if (named[i])
      throw std::invalid_argument("implicit_subcycling: coarse particle " + std::to_string(i) +
                                  " is named twice");
    named[i] = true;
  }
  solver_ = std::make_unique<SubcyclingSolver>(system, options_.coarse);
  if (const double bytes = solver_->bytes(options_.ratio); bytes > most_bytes) {
    std::ostringstream text;
    text << "implicit_subcycling: a cycle of " << options_.ratio << " substeps with "
         << solver_->fine_unknowns() << " fine components and " << solver_->interface_unknowns()
         << " of the interface needs " << bytes / gibibyte << " GiB of memory, at most "
         << most_bytes / gibibyte
         << " are allowed; take a smaller ratio, or fewer coarse particles that share an element with a fine "
            "one";
    throw std::invalid_argument(text.str());
  }
}

ImplicitSubcycling::~ImplicitSubcycling() = default;

/// Newton's method, until a change is rounding.
double ImplicitSubcycling::advance(const State<double>& from, double limit, State<double>& to,
                                   Report& report) {
  const double h = fixed_length(from, options_.ratio * options_.step, limit, report);
  Coordinates<double> a;
  if (h == 0.0 || !accelerations_(from, a, report)) return 0.0;
  const double eps = std::numeric_limits<double>::epsilon();
  double last = std::numeric_limits<double>::infinity();
  solver_->stand_still(from, h, substeps(h, options_.step, options_.ratio));
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double change = solver_->improve();
    other_element_coefficients_ = solver_->element_coefficients();
    if (!solver_->finite(from.time, report)) return 0.0;
    // At rounding, which may be that of large forces in balance, a change is no longer much smaller than the last.
    const bool small =
        change <= 2 * eps * solver_->speed() && h / 2 * change <= 2 * eps * solver_->distance();
    if (small || (change >= 0.25 * last && h / 2 * change <= 1e-8 * solver_->distance())) {
      to.position = solver_->end().position;
      to.velocity = solver_->end().velocity;
      return h;
    }
    last = change;
  }
  std::ostringstream text;
  text << "Newton's method does not solve the cycle of implicit steps from t = " << from.time
       << ": the forces change too much in it; take a shorter step or a smaller ratio";
  report = {Outcome::not_converged, text.str(), -1};
  return 0.0;
}

/// In units of h where a rounding over h would overflow: the lengths of steps down to 1e-300 are allowed at t = 0.
Piece ImplicitSubcycling::piece() const {
  const double h = length(), unit = h < 1e-100 ? h : 1.0;
  const Coordinates<double> way = (after().position - before().position) / (h / unit),
                            change = (after().velocity - before().velocity) / (h / unit);
  return {before().time, before().time + h, {before().position, way}, {before().velocity, change}, unit};
}

}  // namespace jetlag
