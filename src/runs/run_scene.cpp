// SPDX-License-Identifier: MIT
#include "jetlag/runs/run_scene.hpp"

#include "jetlag/base/stopwatch.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/model/finite.hpp"
#include "jetlag/output/result_folder.hpp"
#include "jetlag/tape/kernels.hpp"
#include "jetlag/version.hpp"
#include "runs/outputs/output.hpp"
#include "runs/recorder.hpp"

namespace jetlag {

namespace {

void run_schedule(const Scene& scene, Schedule& schedule, const RunHooks& hooks, RunResult& result) {
  Summary& summary = result.summary;
  summary.warnings = scene.warnings;
  State<double> state = scene.initial;
  for (const auto& contact : scene.contacts) *contact = {};
  if (scene.output.clocks) result.clocks.emplace(scene.system->fixed());
  Recorder recorder(scene, hooks, result);

  double recording = 0;  // seconds spent on frames and hooks, which are not part of the integration
  const Stopwatch whole;
  RunOptions options;
  options.largest = largest_number;
  options.max_steps = scene.max_steps;
  options.observer.frame_times = recorder.times();
  const auto untimed = [&](const auto& f) {
    const Stopwatch part;
    f();
    recording += part.seconds();
  };
  options.observer.at_frame = [&](const State<double>& at) { untimed([&] { recorder.record(at); }); };
  if (result.clocks)
    options.observer.on_update = [&](const Update& update) { untimed([&] { result.clocks->add(update); }); };
  options.observer.after_step = [&](const StepView& step) {
    bool go_on = recorder.failure().outcome == Outcome::success;
    if (go_on && hooks.after_step)
      untimed([&] { go_on = hooks.after_step({step.end(), scene.until, schedule.work().steps}); });
    return go_on;
  };
  Report report = schedule.run(state, scene.until, options);
  summary.wall_seconds = whole.seconds() - recording;
  if (report.outcome != Outcome::success) recorder.last_good(state);
  if (recorder.failure().outcome != Outcome::success) {
    if (report.outcome != Outcome::non_finite) report = recorder.failure();
    state = recorder.last();
  }

  if (report.outcome == Outcome::interrupted)
    report.message += " s, as asked: the outputs hold the run up to there; run it again for the rest";
  recorder.judge();
  if (std::string warning = schedule.warning(); !warning.empty())
    summary.warnings.push_back(std::move(warning));

  summary.outcome = report.outcome;
  summary.message = report.message;
  summary.time = state.time;
  summary.has_energy = scene.output.energy;
  if (scene.output.energy) summary.final_energy = EnergyMeter(*scene.system)(state);
  summary.initial_momentum = momentum(*scene.system, scene.initial);
  summary.final_momentum = momentum(*scene.system, state);
  summary.work = schedule.work();
  summary.frequency = schedule.courant_frequency();
  for (const auto& contact : scene.contacts) {
    if (!summary.contact) summary.contact.emplace();
    *summary.contact += *contact;
  }
  summary.position = std::move(state.position);
  summary.velocity = std::move(state.velocity);
  summary.version = version;
  summary.seed = scene.seed;
  summary.threads = scene.threads;
  summary.instruction_set = kernels<double>().instruction_set;
}

}  // namespace

RunResult run_scene(const Scene& scene, const RunHooks& hooks) {
  RunResult result;
  run_schedule(scene, *scene.schedule(), hooks, result);
  return result;
}

RunResult run_scene_into(const Scene& scene, const std::filesystem::path& folder, const RunHooks& hooks,
                         std::vector<std::string>& warnings) {
  const auto schedule = scene.schedule();  // its memory is taken before anything is written
  const ResultFolder held(folder);
  remove_earlier_results(folder);
  auto outputs = all_outputs();
  std::erase_if(outputs, [&](const auto& output) { return !output->is_wanted(scene.output); });

  RunResult result;
  const RecordedRun run{scene, folder, warnings};
  for (const auto& output : outputs) output->begin(run);
  RunHooks all = hooks;
  all.frame = [&](const Frame& frame) {
    for (const auto& output : outputs) output->frame(run, frame, result);
    if (hooks.frame) hooks.frame(frame);
  };
  run_schedule(scene, *schedule, all, result);
  for (const auto turn : {Output::Turn::table, Output::Turn::summary, Output::Turn::picture})
    for (const auto& output : outputs)
      if (output->turn() == turn) output->end(run, result);
  return result;
}

}  // namespace jetlag
