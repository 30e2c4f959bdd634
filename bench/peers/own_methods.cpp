// SPDX-License-Identifier: MIT
// Methods of jetlag, to run beside their peers.

#include <limits>
#include <memory>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/explicit/dop853.hpp"
#include "jetlag/integrators/explicit/dopri5.hpp"
#include "jetlag/integrators/explicit/gauss_radau.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/explicit/rk4.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "peers.hpp"

namespace jetlag::bench {

namespace {

Ending ending(const PeerProblem& problem, const Asked& asked, Schedule& schedule) {
  const double deadline = processor_seconds() + asked.seconds;
  std::uint32_t steps = 0;
  RunOptions options;
  options.observer.after_step = [&](const StepView&) {
    return ++steps % 1024 != 0 || processor_seconds() < deadline;
  };
  Ending result{problem.start};
  const Report report = schedule.run(result.state, problem.until, options);
  result.evaluations = static_cast<double>(schedule.work().element_coefficients) /
                       static_cast<double>(problems::element_count(problem.system));
  if (report.outcome == Outcome::interrupted)
    result.failure = "the time is used up";
  else if (report.outcome != Outcome::success)
    result.failure = report.message;
  return result;
}

/// make(problem, setting): the integrator. A step is made such that all of them are equal.
template <class Make>
auto lockstep(const Make& make) {
  return [make](const PeerProblem& problem, const Asked& asked) {
    Lockstep schedule(make(problem, asked.setting));
    return ending(problem, asked, schedule);
  };
}

double equal(const PeerProblem& problem, double step) { return EqualSteps(problem.until, step).step; }

Method fixed_taylor(int degree) {
  return {"taylor" + std::to_string(degree) + "_fixed",
          true,
          8,
          false,
          any_problem,
          lockstep([degree](const PeerProblem& p, double step) {
            return taylor(p.system, degree, std::make_unique<FixedStep>(equal(p, step)));
          })};
}

Method embedded(const std::string& name, const RungeKuttaTable& (*table)()) {
  return {name, false, 1e1, false, any_problem, lockstep([table](const PeerProblem& p, double tolerance) {
            return std::make_unique<RungeKutta>(p.system, table(), EmbeddedControl{tolerance});
          })};
}

Method block(int degree) {
  return {"block" + std::to_string(degree),
          false,
          1e1,
          false,
          has_split,
          [degree](const PeerProblem& p, const Asked& asked) {
            BlockSteps::Options options;
            options.tolerance = asked.setting;
            options.max_step = 1.25;  // [s]: as in BM_Asynchrony
            BlockSteps schedule(p.system, degree, options);
            return ending(p, asked, schedule);
          }};
}

}  // namespace

std::vector<Method> own_methods() {
  return {
      {"leapfrog", true, 1, false, any_problem, lockstep([](const PeerProblem& p, double step) {
         return std::make_unique<Leapfrog>(p.system, equal(p, step));
       })},
      {"rk4", true, 2, false, any_problem, lockstep([](const PeerProblem& p, double step) {
         return std::make_unique<RungeKutta>(p.system, rk4(), equal(p, step));
       })},
      embedded("dopri5", dopri5),
      embedded("dop853", dop853),
      {"gauss_radau", false, 1e2, false, any_problem, lockstep([](const PeerProblem& p, double tolerance) {
         return std::make_unique<GaussRadau>(p.system, GaussRadau::Options{.tolerance = tolerance});
       }),
       std::numeric_limits<double>::infinity()},
      {"gauss_radau_fixed", true, 8, false, any_problem, lockstep([](const PeerProblem& p, double step) {
         return std::make_unique<GaussRadau>(p.system, GaussRadau::Options{.step = equal(p, step)});
       })},
      fixed_taylor(8),
      fixed_taylor(12),
      fixed_taylor(20),
      {"taylor_jorba_zou", false, 1e1, false, any_problem,
       lockstep([](const PeerProblem& p, double tolerance) {
         return taylor(p.system, jorba_zou_degree(tolerance), std::make_unique<JorbaZou>());
       })},
      block(4),
      block(8),
      block(12),
  };
}

}  // namespace jetlag::bench
