// SPDX-License-Identifier: MIT
// Every method moves an elastic bar at its order, or says why it does not.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "forces/solids/bodies.hpp"
#include "integrators/methods.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/scene.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::testing::methods_on_solids_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A bar of the standard material that tumbles and stretches: omega h = 1.1 for the coarser of the steps below.
struct Bar {
  Mesh mesh = jetlag::box({0.2, 0.2, 0.6}, {1, 1, 3});
  System<double> system{3, lumped_masses(mesh.position, mesh.tetrahedra, solids::density)};
  State<double> start{0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)};

  Bar() {
    const auto [lambda, mu] = lame(solids::young, solids::poisson);
    system.add_at_rest<NeoHookean>(mesh.tetrahedra, mesh.position, {{lambda, mu}});
    const Eigen::Vector3d spin(3, 1, 2);
    for (int i = 0; i < mesh.position.rows(); ++i) {
      const Eigen::Vector3d r = mesh.position.row(i).transpose() - Eigen::Vector3d(0.1, 0.1, 0.3);
      start.velocity.row(i) = spin.cross(r) + Eigen::Vector3d(0.5 * r.z() * r.z() + 0.1, 0.2, 0.3 - r.z());
    }
  }
};

constexpr double until = 0.064;  // [s]

State<double> end_of(const Bar& bar, std::unique_ptr<Integrator> integrator) {
  State<double> state = bar.start;
  EXPECT_EQ(Lockstep(std::move(integrator)).run(state, until, {}).outcome, Outcome::success);
  return state;
}

class MethodsOnSolids : public ::testing::TestWithParam<Promised> {};

TEST_P(MethodsOnSolids, KeepTheirOrder) {
  const Promised& method = GetParam();
  const Bar bar;
  const State<double> truth = end_of(bar, taylor(bar.system, 20, std::make_unique<FixedStep>(1e-3)));
  const auto error = [&](double step) {
    const int seeds = method.random ? 100 : 1;
    double squares = 0;
    for (int seed = 1; seed <= seeds; ++seed)
      squares += (end_of(bar, method.make(bar.system, step, seed)).position - truth.position).squaredNorm();
    return std::sqrt(squares / seeds);
  };
  // Slopes of methods that draw scatter by sqrt(2/100) / 2 / ln 2 = 0.1 for each of two samples, those of others differ by
  // the next term of the error: less than 0.25 in all. Positions may converge faster than the method promises.
  const double coarse = error(0.004), fine = error(0.002), rounding = 1e-15;
  EXPECT_LT(coarse, 0.03);
  if (fine > rounding) {
    EXPECT_GT(std::log2(coarse / fine), method.order - 0.25) << coarse << " and " << fine;
  }
}

INSTANTIATE_TEST_SUITE_P(, MethodsOnSolids, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return info.param.name; });

/// The scene `spinning_bar`, up to 0.1 s.
Coordinates<double> bar_by(const std::vector<std::string>& settings) {
  std::vector<std::string> all{"until=0.1", "output.frames=1"};
  all.insert(all.end(), settings.begin(), settings.end());
  const RunResult result = run_scene(load_scene("spinning_bar", all));
  EXPECT_EQ(result.summary.outcome, Outcome::success) << result.summary.message;
  return result.summary.position;
}

/// Leapfrog at a fifth of its limit, omega h <= 0.4: it goes ahead by (omega h)^2/24 of the phase, here of vibrations of some
/// 1e-3 m: 1e-5 m. Taylor's clocks have a tolerance, of 1e-9 m a step, which a hundred steps add up.
TEST(ClocksOnSolids, KeepTheirAccuracy) {
  const Coordinates<double> truth = bar_by({"integrator.degree=20"});
  const auto error = [&](const std::vector<std::string>& settings) {
    return (bar_by(settings) - truth).cwiseAbs().maxCoeff();
  };
  const std::string courant = R"(control={"courant": 0.2})";
  EXPECT_LT(error({R"(integrator={"type": "avi"})", courant}), 1e-4);
  EXPECT_LT(error({R"(integrator={"type": "subcycling", "ratio": "courant"})", courant}), 1e-4);
  const std::string last_two = R"(control={"type": "last_two", "tolerance": 1e-9, "courant": 0.5})";
  for (const std::string clocks : {"block", "asynchronous"})
    EXPECT_LT(error({R"(integrator={"type": "taylor", "degree": 8})", last_two,
                     R"(schedule={"type": ")" + clocks + R"(", "tolerance": 1e-9})"}),
              1e-7)
        << clocks;
  const std::string fixed = R"(control={"type": "fixed", "step": 0.01, "courant": 0.5})";
  EXPECT_LT(error({R"(integrator={"type": "random_taylor", "min_degree": 3, "max_degree": 4})", fixed,
                   R"(schedule={"type": "block"})"}),
            1e-4);
}

/// The scene `beam`, whose material is viscous, by steps of a fraction of its limit.
RunResult beam_by(std::vector<std::string> settings) {
  settings.insert(settings.end(), {"until=0.02", "output.frames=1",
                                   R"(control={"type": "fixed", "step": 1, "courant": 0.9})"});
  return run_scene(load_scene("beam", settings));
}

TEST(ViscousSolids, TakeStepsOfTheirLimit) {
  const std::string block = R"(schedule={"type": "block", "tolerance": 1})";
  const RunResult truth =
      run_scene(load_scene("beam", {"until=0.02", "output.frames=1", "control.step=1e-4"}));
  for (const std::vector<std::string>& clocks : {std::vector<std::string>{}, {block}}) {
    std::vector<std::string> settings{"integrator.degree=4"};
    settings.insert(settings.end(), clocks.begin(), clocks.end());
    const RunResult result = beam_by(settings);
    EXPECT_EQ(result.summary.outcome, Outcome::success) << result.summary.message;
    EXPECT_GT(result.summary.frequency.value().bound,
              100);  // sqrt(E / rho) over a cell of 0.1 m is 200 rad/s
    // Of 2e-3 m that it falls.
    EXPECT_LT((result.summary.position - truth.summary.position).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(ViscousSolids, AreRefusedWhereNothingIsKnown) {
  EXPECT_THAT([] { beam_by({}); },
              ThrowsMessage<SceneError>(HasSubstr("unstable for undamped")));  // degree 6
  EXPECT_THAT(
      [] {
        beam_by(
            {R"(integrator={"type": "random_taylor", "min_degree": 4, "max_degree": 4, "velocity": "derivative"})"});
      },
      ThrowsMessage<SceneError>(HasSubstr("velocities of their own series only")));
  EXPECT_THAT([] { beam_by({R"(integrator={"type": "leapfrog"})"}); },
              ThrowsMessage<SceneError>(HasSubstr("kelvin_voigt depends on velocities")));
}

TEST(ClocksOnSolids, OfQuantaAreRefused) {
  EXPECT_THAT([] { bar_by({R"(integrator={"type": "qss2"})", R"(control={"quantum": 1e-4})"}); },
              ThrowsMessage<SceneError>(HasSubstr("neo_hookean acts on 4")));
}

}  // namespace
}  // namespace jetlag::testing::methods_on_solids_test
