// SPDX-License-Identifier: MIT
#include "odeint.hpp"

#if defined(JETLAG_HAVE_ODEINT)

#include <boost/numeric/odeint.hpp>
#include <stdexcept>
#include <utility>

namespace jetlag::bench {

namespace {

namespace odeint = boost::numeric::odeint;
using Vector = std::vector<double>;
using Pair = std::pair<Vector, Vector>;

/// The forces in the shapes that steppers ask for.
class RightHandSide {
 public:
  RightHandSide(const PeerProblem& problem, const Asked& asked) : forces_(problem.system, asked.seconds) {}

  /// y' = f(y), y = (x, v).
  void operator()(const Vector& y, Vector& rate, double t) {
    const std::size_t n = forces_.unknowns();
    std::copy(y.begin() + n, y.end(), rate.begin());
    evaluate(t, y.data(), y.data() + n, rate.data() + n);
  }
  /// x'' at (x, v).
  void operator()(const Vector& x, const Vector& v, Vector& a, double t) {
    evaluate(t, x.data(), v.data(), a.data());
  }
  /// x'' at x: without velocities.
  void operator()(const Vector& x, Vector& a) {
    still_.resize(x.size());
    evaluate(0.0, x.data(), still_.data(), a.data());
  }

  double element_coefficients() const { return forces_.element_coefficients(); }

 private:
  void evaluate(double t, const double* x, const double* v, double* a) {
    if (!forces_(t, x, v, a)) throw std::runtime_error(forces_.failure());
  }

  Forces forces_;
  Vector still_;
};

template <class Integrate>
Ending ending(const PeerProblem& problem, const Asked& asked, const Integrate& integrate) {
  RightHandSide rate(problem, asked);
  try {
    const State<double> end = integrate(rate);
    return {end, rate.element_coefficients() / static_cast<double>(problems::element_count(problem.system))};
  } catch (const std::runtime_error& error) {  // of odeint too: no step is short enough
    return {problem.start, 0, error.what()};
  }
}

template <class Stepper>
Ending fixed(const PeerProblem& problem, const Asked& asked) {
  return ending(problem, asked, [&](RightHandSide& rate) {
    Vector y = flat(problem.start);
    const EqualSteps steps(problem.until, asked.setting);
    odeint::integrate_n_steps(Stepper(), std::ref(rate), y, 0.0, steps.step, steps.count);
    return state_of(y.data(), problem);
  });
}

/// Of second order: position and velocity apart.
template <class Stepper>
Ending fixed_pair(const PeerProblem& problem, const Asked& asked) {
  return ending(problem, asked, [&](RightHandSide& rate) {
    const Vector all = flat(problem.start);
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    Pair y(Vector(all.begin(), middle), Vector(middle, all.end()));
    const EqualSteps steps(problem.until, asked.setting);
    odeint::integrate_n_steps(Stepper(), std::ref(rate), y, 0.0, steps.step, steps.count);
    y.first.insert(y.first.end(), y.second.begin(), y.second.end());
    return state_of(y.first.data(), problem);
  });
}

template <class Stepper>
Ending controlled(const PeerProblem& problem, const Asked& asked, Stepper stepper) {
  return ending(problem, asked, [&](RightHandSide& rate) {
    Vector y = flat(problem.start);
    odeint::integrate_adaptive(stepper, std::ref(rate), y, 0.0, problem.until, problem.largest_step / 100);
    return state_of(y.data(), problem);
  });
}

}  // namespace

std::vector<Method> odeint_methods() {
  const auto pair = [](auto stepper) {
    return [stepper](const PeerProblem& p, const Asked& asked) {
      return controlled(p, asked, odeint::make_controlled(asked.setting, asked.setting, stepper));
    };
  };
  return {
      {"odeint_velocity_verlet", true, 1, false, by_position, fixed_pair<odeint::velocity_verlet<Vector>>},
      {"odeint_symplectic_rkn_sb3a", true, 4, false, by_position,
       fixed_pair<odeint::symplectic_rkn_sb3a_mclachlan<Vector>>},
      {"odeint_runge_kutta4", true, 2, false, any_problem, fixed<odeint::runge_kutta4<Vector>>},
      {"odeint_dopri5", false, 1e1, false, any_problem, pair(odeint::runge_kutta_dopri5<Vector>())},
      {"odeint_fehlberg78", false, 1e1, false, any_problem, pair(odeint::runge_kutta_fehlberg78<Vector>())},
      {"odeint_bulirsch_stoer", false, 1e1, false, any_problem,
       [](const PeerProblem& p, const Asked& asked) {
         return controlled(p, asked, odeint::bulirsch_stoer<Vector>(asked.setting, asked.setting));
       }},
  };
}

}  // namespace jetlag::bench

#else

namespace jetlag::bench {
std::vector<Method> odeint_methods() { return {}; }
}  // namespace jetlag::bench

#endif
