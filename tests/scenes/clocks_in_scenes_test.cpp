// SPDX-License-Identifier: MIT
// Scenes whose particles have clocks of their own: the keys, the frames, the work.

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using Settings = std::vector<std::string>;

Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}
const Settings smooth = {"integrator={\"type\": \"taylor\", \"degree\": 12}", "until=2", "output.frames=8"};

struct Ran {
  RunResult result;
  std::vector<Frame> frames;
};
Ran run(const std::string& scene, const Settings& settings) {
  Ran run;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { run.frames.push_back(frame); };
  run.result = run_scene(load_scene(scene, settings), hooks);
  return run;
}

TEST(ClocksInScenes, ShowTheMotionOfOneClockAtTheSameFrames) {
  // Every step of a particle is within 1e-11 m, 200 at most in 2 s of a frequency of 87 / s.
  const Ran one = run("chain", with(smooth, {"control={\"type\": \"jorba_zou\"}", "integrator.degree=20"}));
  for (const std::string type : {"block", "asynchronous"}) {
    const std::string notify = type == "asynchronous" ? ", \"notify\": 1e-3" : "";
    const Ran many = run(
        "chain", with(smooth, {"schedule={\"type\": \"" + type + "\", \"tolerance\": 1e-11" + notify + "}",
                               "control={\"type\": \"fixed\", \"step\": 0.05}"}));
    EXPECT_EQ(many.result.summary.outcome, Outcome::success);
    EXPECT_EQ(many.result.summary.time, 2.0);
    ASSERT_EQ(many.frames.size(), 9u);
    for (int frame = 0; frame <= 8; ++frame) {
      EXPECT_EQ(many.frames[frame].time, 0.25 * frame);
      EXPECT_LT((many.frames[frame].position - one.frames[frame].position).cwiseAbs().maxCoeff(), 2e-9)
          << type;
    }
    EXPECT_EQ(many.result.energies.size(), 9u);
    const Work& work = many.result.summary.work;
    EXPECT_GT(work.updates, work.steps);
    EXPECT_GT(work.element_coefficients, work.updates);
    EXPECT_DOUBLE_EQ(work.mean_degree(), 12);
    EXPECT_EQ(work.wake_ups > 0, type == "asynchronous");
  }
}

TEST(ClocksInScenes, RunWhatIsBuiltIn) {
  // The longest step is that of the scene's control; degrees are drawn.
  for (const std::string type : {"block", "asynchronous"})
    EXPECT_EQ(run("chain", {"schedule.type=" + type, "until=1"}).result.summary.outcome, Outcome::success)
        << type;
}

TEST(ClocksInScenes, CompleteTheScene) {
  const std::string json = load_scene("chain", {"schedule.type=block", "schedule.tolerance=1e-7"}).json;
  EXPECT_THAT(json, AllOf(HasSubstr("\"tolerance\": 1e-07"), HasSubstr("\"grading\": 1")));
  EXPECT_THAT(load_scene("chain", {"schedule.type=asynchronous"}).json,
              AllOf(HasSubstr("\"tolerance\": 1e-09"), HasSubstr("\"notify\": 1")));
}

TEST(ClocksInScenes, RefuseWhatMakesNoSense) {
  const auto refuses = [](const Settings& settings, const char* key) {
    EXPECT_THAT([&] { load_scene("chain", with({"schedule.type=block"}, settings)); },
                ThrowsMessage<SceneError>(HasSubstr(key)));
  };
  refuses({"schedule.tolerance=0"}, "schedule.tolerance");
  refuses({"schedule.grading=-1"}, "schedule.grading");
  refuses({"schedule.notify=1"}, "schedule.notify");
  refuses({"schedule.max_step=0"}, "schedule.max_step");
  refuses({"schedule.type=asynchronous", "schedule.grading=0.5"}, "schedule.grading");
  refuses({"control={\"type\": \"jorba_zou\"}"}, "control.type");
  refuses({"integrator={\"type\": \"leapfrog\"}"}, "integrator.type");
  refuses({"integrator={\"type\": \"taylor\", \"degree\": 2}"}, "integrator.degree");
  refuses({"integrator.compensated=true"}, "integrator.compensated");
}

}  // namespace
}  // namespace jetlag::testing
