// SPDX-License-Identifier: MIT
// Scenes with contact as they run: what they conserve, what they leave, and runs that are interrupted.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "jetlag/contact/clearance.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "scenes/contact/contact_scenes.hpp"
#include "support/program.hpp"

namespace jetlag::testing::contact_runs_test {
namespace {

using contact_scenes::barrier, contact_scenes::scene;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Two tetrahedra that fly at each other, corner first, a little aside.
Scene two_bodies(const std::string& more = "") {
  return scene(3,
               R"({"position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1],
                                [1.3, 0.31, 0.27], [2.2, 0.8, 0.4], [1.9, -0.6, 0.2], [2, 0.3, 1.2]],
                   "tetrahedra": [[0, 1, 2, 3], [4, 6, 5, 7]], "density": 6,
                   "velocity": [[1, 0, 0], [1, 0, 0], [1, 0, 0], [1, 0, 0], [-2, 0.1, 0], [-2, 0.1, 0], [-2, 0.1, 0], [-2, 0.1, 0]]})",
               R"({"type": "neo_hookean", "young": 2000, "poisson": 0.3}, )" + barrier(), more);
}

TEST(ContactRuns, KeepWhatContactsConserve) {
  const Scene s = two_bodies();
  const RunResult result = run_scene(s);
  ASSERT_EQ(result.summary.outcome, Outcome::success) << result.summary.message;
  const State<double> end{result.summary.time, result.summary.position, result.summary.velocity};
  EXPECT_GT(result.summary.contact->begun, 3u);
  // Sums of 8 particles over some 1000 steps of numbers below 3; the others to what 1e-9 m a step allow.
  EXPECT_LE((momentum(*s.system, end) - momentum(*s.system, s.initial)).norm(), 1e-12);
  EXPECT_LE((angular_momentum(*s.system, end) - angular_momentum(*s.system, s.initial)).norm(), 1e-10);
  EXPECT_LT(result.summary.max_relative_energy_error, 1e-7);
  EXPECT_GT((end.velocity - s.initial.velocity).norm(), 1);  // they did meet
  for (const auto& row : result.energies)
    if (row.time == 0) {
      EXPECT_EQ(row.energy.potential, 0);
    }
}

TEST(ContactRuns, TellGapsAndForcesInFrames) {
  Scene s = two_bodies();
  s.output.frames = 100;
  bool touched = false;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    ASSERT_EQ(frame.gap.size(), 8u);
    EXPECT_LE(frame.contact_force.colwise().sum().norm(), 1e-12 * frame.contact_force.norm());
    const bool touches = frame.contact_force.norm() > 0;
    EXPECT_EQ(touches, std::ranges::any_of(frame.gap, [](double gap) { return gap < 0.1; }));
    touched = touched || touches;
  };
  run_scene(s, hooks);
  EXPECT_TRUE(touched);
  hooks.frame = [](const Frame& frame) { EXPECT_TRUE(frame.gap.empty()); };
  run_scene(load_scene("chain", {"until=0.1"}), hooks);
}

TEST(ContactRuns, CountForOneRunAfterTheOther) {
  const Scene s = two_bodies();
  const ContactRecord first = *run_scene(s).summary.contact, second = *run_scene(s).summary.contact;
  EXPECT_EQ(first.begun, second.begun);
  EXPECT_EQ(first.stencils_tested, second.stencils_tested);
  EXPECT_EQ(first.smallest_gap.value, second.smallest_gap.value);
  EXPECT_FALSE(run_scene(load_scene("chain", {"until=0.1"})).summary.contact);
}

TEST(ContactRuns, AddUpSeveralContacts) {  // of a mass with either of two walls on a line
  const std::string walls = R"("obstacles": [{"position": [[0]]}, {"position": [[1]]}])";
  const std::string mass = R"({"position": [[0.5]], "velocity": [[-1]]})";
  const auto begun = [&](const std::string& forces) {
    return run_scene(scene(1, mass, forces, walls)).summary.contact->begun;
  };
  EXPECT_EQ(begun(barrier()), 1u);
  EXPECT_EQ(begun(barrier() + ", " + barrier()), 2u);
}

// ---- runs that are interrupted -------------------------------------------------------------------------------------

bool same_bits(const State<double>& a, const State<double>& b) {
  return a.time == b.time && a.position == b.position && a.velocity == b.velocity;
}

/// Interrupted at every step, and gone on with by the same schedule, or by a new one that knows the state only.
State<double> in_steps(const Scene& s, bool anew) {
  State<double> state = s.initial;
  auto schedule = s.schedule();
  RunOptions one;
  one.observer.after_step = [](const StepView&) { return false; };
  while (schedule->run(state, s.until, one).outcome == Outcome::interrupted)
    if (anew) schedule = s.schedule();
  return state;
}

// The time is a sum that knows what rounding cuts off, which an interruption forgets: steps that are powers of two have none.
TEST(ContactRuns, InterruptedAtAnyTimeGoOnWithTheSameBits) {
  const Scene s = two_bodies(R"("integrator": {"type": "taylor", "degree": 6},
                                "control": {"type": "fixed", "step": 0.0009765625})");
  State<double> whole = s.initial;
  ASSERT_EQ(s.schedule()->run(whole, s.until, {}).outcome, Outcome::success);
  EXPECT_TRUE(same_bits(in_steps(s, false), whole));
  EXPECT_TRUE(same_bits(in_steps(s, true), whole));
}

TEST(ContactRuns, InterruptedAtStepsThatAreChosenGoOnAsBefore) {  // but for one ulp of time a step
  const Scene s = two_bodies();
  State<double> whole = s.initial;
  ASSERT_EQ(s.schedule()->run(whole, s.until, {}).outcome, Outcome::success);
  for (const bool anew : {false, true}) {
    const State<double> end = in_steps(s, anew);
    EXPECT_EQ(end.time, whole.time);
    EXPECT_LE((end.position - whole.position).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(ContactRuns, LeaveASceneThatGivesTheSameBits) {
  const TemporaryFolder folder;
  write(folder / "scene.json",
        contact_scenes::text(3, R"({"position": [[0.1, 0.2, 0.5]], "velocity": [[0, 0, -2]]})",
                             barrier(R"("points": [0])"), R"("obstacles": [{"sphere": {"radius": 0.3}}])"));
  for (const char* run : {"run scene.json --out a --quiet", "run a/scene.json --out b --quiet"})
    ASSERT_EQ(program(run, folder.path()).exit_code, 0);
  const auto summary = [&](const char* out) {
    return nlohmann::json::parse(content(folder / out / "summary.json"));
  };
  EXPECT_EQ(summary("a")["position"], summary("b")["position"]);
  EXPECT_EQ(summary("a")["contact"], summary("b")["contact"]);
  EXPECT_EQ(summary("a")["position"].size(), 1u + 162);
}

TEST(ContactRuns, AreChecked) {
  const TemporaryFolder folder;
  write(folder / "scene.json", contact_scenes::text(1, R"({"position": [[0], [0.05]]})", barrier()));
  const Ended check = program("check scene.json", folder.path());
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_THAT(check.output, HasSubstr("contact     1 element of features within the thickness"));
}

// ---- the scenes that come with the program -----------------------------------------------------------------------------

TEST(Cradle, HandsTheMotionOnAndBack) {
  // A pendulum of 1 m let go at 50 degrees is at its other end after half a period, 2 K(sin 25 deg) sqrt(L / g) = 1.052 s.
  const RunResult half = run_scene(load_scene("cradle", {"until=1.052", "output.pictures=false"}));
  ASSERT_EQ(half.summary.outcome, Outcome::success);
  EXPECT_LT(half.summary.max_relative_energy_error, 1e-12);
  const auto& x = half.summary.position;
  const double swing = std::sin(50 * std::acos(-1) / 180);
  EXPECT_NEAR(x(4, 0) - x(9, 0), swing, 0.03);  // what the others keep; contacts take their time
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(x(i, 0), x(i + 5, 0), 0.03);
  EXPECT_GE(half.summary.contact->begun, 4u);
}

TEST(Pile, ComesToRestInItsBox) {
  const RunResult result = run_scene(load_scene("pile", {"output.pictures=false"}));
  ASSERT_EQ(result.summary.outcome, Outcome::success) << result.summary.message;
  EXPECT_THAT(result.summary.warnings, IsEmpty());
  EXPECT_LT(result.energies.back().energy.kinetic, 1e-2);
  EXPECT_EQ(result.summary.elements[0].inverted, 0);
  for (int i = 0; i < 63; ++i) {
    const double x = result.summary.position(i, 0), y = result.summary.position(i, 1);
    EXPECT_GT(y, 0);
    EXPECT_LT(std::abs(x), 0.85 + 0.15 * y / 2);
  }
  for (std::size_t r = 1; r < result.energies.size();
       ++r)  // it only loses energy, but for the tolerance of steps
    EXPECT_LT(result.energies[r].energy.total(), result.energies[r - 1].energy.total() + 1e-3);
}

TEST(Drape, PassesThroughNothing) {  // up to where the sphere is covered
  const Scene s = load_scene("drape", {"until=0.3", "output.frames=10"});
  const RunResult result = run_scene(s);
  ASSERT_EQ(result.summary.outcome, Outcome::success) << result.summary.message;
  EXPECT_THAT(result.summary.warnings, IsEmpty());
  EXPECT_GT(result.summary.contact->active_largest, 50u);
  EXPECT_GT(result.summary.contact->smallest_gap.value, 0);
  ContactBarrier all{.surface = Surface(s.shape.surface, {}, {}),
                     .rest = s.initial.position,
                     .thickness = 1e-3,
                     .stiffness = 1};
  EXPECT_NO_THROW(require_apart(*s.system, all, result.summary.position));
  for (std::size_t r = 1; r < result.energies.size(); ++r)
    EXPECT_LT(result.energies[r].energy.total(), result.energies[r - 1].energy.total());
}

}  // namespace
}  // namespace jetlag::testing::contact_runs_test
