// SPDX-License-Identifier: MIT
#include "jetlag/integrators/implicit/explicit_implicit.hpp"

#include <stdexcept>

#include "jetlag/control/courant.hpp"

namespace jetlag {

namespace {

std::vector<bool> beyond(const std::vector<double>& omega, const System<double>& system, double step) {
  std::vector<bool> chosen(omega.size());
  for (std::size_t i = 0; i < omega.size(); ++i) chosen[i] = !system.fixed()[i] && !(step * omega[i] < 2);
  return chosen;
}

}  // namespace

std::vector<bool> beyond_courant(const System<double>& system, double step) {
  return beyond(frequency_bounds(system), system, step);
}

std::vector<bool> beyond_courant(const System<double>& system, const State<double>& state, double step) {
  return beyond(frequency_bounds(system, state), system, step);
}

ExplicitImplicit::ExplicitImplicit(const System<double>& system, double step,
                                   const std::vector<bool>& implicit)
    : ImplicitMethod(system, step), quarter_(for_all(0.0)) {
  if (implicit.size() != static_cast<std::size_t>(system.particles()))
    throw std::invalid_argument("explicit_implicit: it must be said of each of " +
                                std::to_string(system.particles()) +
                                " particles whether it is implicit, got " + std::to_string(implicit.size()));
  for (int i = 0; i < system.particles(); ++i)
    if (implicit[i] && !system.fixed()[i]) quarter_(i) = 0.25;
}

/// u = a_1, with x_s + p u the new positions:  x_s = x_0 + h v_0 + h^2 (1/2 - beta) a_0,   p = h^2 beta.
double ExplicitImplicit::advance(const State<double>& from, double limit, State<double>& to, Report& report) {
  const double h = fixed_length(from, step_, limit, report);
  Coordinates<double> a;
  if (h == 0.0 || !accelerations_(from, a, report)) return 0.0;
  const Eigen::VectorXd p = h * h * quarter_;
  const Equations equations{
      0.0 * a,
      1.0,
      {from.time + h, from.position + h * from.velocity + h * h / 2 * a - p.asDiagonal() * a,
       from.velocity + h / 2 * a},
      p,
      for_all(h / 2)};
  Coordinates<double> end = a;  // the implicit ones stand still
  for (Eigen::Index i = 0; i < end.rows(); ++i)
    if (p(i) != 0) end.row(i) = -4 / h * from.velocity.row(i) - a.row(i);
  if (!solve(equations, from.time, end, report)) return 0.0;
  to.position = equations.stage.position + p.asDiagonal() * end;
  to.velocity = equations.stage.velocity + h / 2 * end;
  return h;
}

}  // namespace jetlag
