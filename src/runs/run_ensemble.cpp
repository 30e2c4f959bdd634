// SPDX-License-Identifier: MIT
#include "jetlag/runs/run_ensemble.hpp"

#include <algorithm>
#include <cmath>

#include "ensembles/companion.hpp"
#include "jetlag/base/stopwatch.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/result_folder.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "jetlag/tape/kernels.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/version.hpp"
#include "runs/ensemble_options.hpp"
#include "runs/ensemble_statistics.hpp"
#include "runs/ensemble_watch.hpp"
#include "runs/outputs/output.hpp"
#include "runs/outputs/picture.hpp"

namespace jetlag {

namespace {

/// Where a member starts.
State<double> start(const Scene& scene, double perturbation, std::size_t member) {
  State<double> state = scene.initial;
  state.drop_rests();
  if (perturbation > 0)
    for (int p = 0; p < scene.system->particles(); ++p)
      for (int c = 0; c < scene.system->dimension() && !scene.system->fixed()[p]; ++c)
        state.position(p, c) +=
            perturbation * standard_normal(member_seed(scene.seed, member), static_cast<std::uint32_t>(p), c);
  return state;
}

/// What the members are compared with: a series so long, with a step so short, that it counts as the truth.
SeriesMethod reference_of(const SeriesMethod& method) {
  SeriesMethod reference{fixed_degree(20), method.options, std::make_shared<JorbaZou>()};
  reference.options.velocity = VelocitySeries::own_series;
  return reference;
}

/// Why a companion goes no further; empty where it does.
std::string end_of(const Companion& run) {
  const std::string at = " at t = " + number(run.time()) + " s";
  switch (run.report().outcome) {
    case Outcome::success: return "";
    case Outcome::interrupted: return "was stopped" + at;
    case Outcome::step_limit: return "left" + at + " after " + std::to_string(run.work().steps) + " steps";
    default: return "ended" + at + ": " + run.report().message;
  }
}

class EnsembleRun {
 public:
  EnsembleRun(const Scene& scene, const EnsembleOptions& options, const EnsembleHooks& hooks)
      : scene_(scene),
        hooks_(hooks),
        series_(series_of(scene, options)),
        workers_(options.threads),
        members_(*scene.system, series_, options.members,
                 [&](std::size_t i) { return start(scene, options.perturbation, i); },
                 {workers_, scene.max_steps, scene.until}),
        reference_(*scene.system, reference_of(series_), scene.initial, scene.until),
        statistics_(*scene.system, quantities_of(scene, options.velocities), workers_) {
    result_.quantities = statistics_.quantities();
    result_.members = options.members;
    result_.perturbation = options.perturbation;
    result_.in_lanes = members_.in_lanes();
    result_.threads = options.threads;
    result_.seed = scene.seed;
    result_.version = version;
    result_.instruction_set = kernels<double>().instruction_set;
    for (std::size_t i = 0; i < members_.size(); ++i) alive_.push_back(i);
  }

  /// measured: told after each frame, of what there is so far.
  EnsembleResult run(const std::function<void(const EnsembleResult&)>& measured = {}) {
    const int last = std::max(1, scene_.output.frames);
    const auto measure = [&](double time) {
      this->measure(time);
      if (measured) measured(result_);
    };
    measure(0.0);
    for (int f = 1; f <= last; ++f) {
      const double t = f == last ? scene_.until : scene_.until * f / last;
      const Stopwatch watch;
      const bool arrived = members_.advance_to(t, hooks_.go_on);
      result_.wall_seconds += watch.seconds();
      if (arrived) reference_.advance_to(t, hooks_.go_on);
      if (!arrived || (hooks_.go_on && !hooks_.go_on())) {
        end(Outcome::interrupted,
            "stopped after the frame at t = " + number(result_.frames.back().time) +
                " s, as asked: the outputs hold the frames up to there; run it again for the rest");
        break;
      }
      drop_failed();
      if (alive_.empty()) {
        const Report& first = result_.failures.front().report;
        end(first.outcome,
            "all members have failed before t = " + number(t) + " s; the first of them: " + first.message);
        break;
      }
      measure(t);
      if (hooks_.after_frame) hooks_.after_frame(t, scene_.until);
    }
    result_.work = members_.work();
    result_.reference_message = end_of(reference_);
    result_.mean_orders = members_.mean_orders();
    compare_with_fixed_degree();
    return std::move(result_);
  }

 private:
  /// The run of the fixed degree whose steps cost what those of the members have cost, through all frames.
  void compare_with_fixed_degree() {
    if (result_.work.steps == 0) {
      result_.deterministic_message = "was not made: no member has taken a step";
      return;
    }
    const bool own_series = series_.options.velocity == VelocitySeries::own_series;
    const int degree = std::max(1, static_cast<int>(std::lround(result_.mean_orders)) + (own_series ? 0 : 1));
    result_.deterministic_degree = degree;
    if (result_.outcome == Outcome::interrupted) {
      result_.deterministic_message = "was not made: " + result_.message;
      return;
    }
    Companion run(*scene_.system, {fixed_degree(degree), series_.options, series_.control}, scene_.initial,
                  scene_.until);
    for (EnsembleFrame& frame : result_.frames) {
      if (!run.advance_to(frame.time, hooks_.go_on)) break;
      frame.calibration.deterministic_error = statistics_.error(frame, run.state());
    }
    result_.deterministic_work = run.work();
    result_.deterministic_message = end_of(run);
    result_.warning = run.warning();
  }

  void end(Outcome outcome, const std::string& message) {
    result_.outcome = outcome;
    result_.message = message;
  }

  void drop_failed() {
    std::erase_if(alive_, [&](std::size_t i) {
      const Report& report = members_.report(i);
      if (report.outcome == Outcome::success) return false;
      result_.failures.push_back({i, members_.state(i).time, report});
      return true;
    });
  }

  void measure(double time) {
    const bool known = reference_.report().outcome == Outcome::success;
    result_.frames.push_back(statistics_.at(
        time, alive_, [this](std::size_t i) { return members_.state(i); },
        known ? &reference_.state() : nullptr));
  }

  const Scene& scene_;
  const EnsembleHooks& hooks_;
  const SeriesMethod& series_;
  Workers workers_;
  RandomEnsemble members_;
  Companion reference_;
  EnsembleStatistics statistics_;
  EnsembleResult result_;
  std::vector<std::size_t> alive_;
};

}  // namespace

EnsembleResult run_ensemble(const Scene& scene, const EnsembleOptions& options, const EnsembleHooks& hooks) {
  check(scene, options);
  read_watch(scene, options.watch);
  return EnsembleRun(scene, options, hooks).run();
}

EnsembleResult run_ensemble_into(const Scene& scene, const EnsembleOptions& options,
                                 const std::filesystem::path& folder, const EnsembleHooks& hooks,
                                 std::vector<std::string>& warnings) {
  check(scene, options);
  const Watch watch = read_watch(scene, options.watch);
  EnsembleRun ensemble(scene, options, hooks);  // its memory is taken before anything is written
  const ResultFolder held(folder);
  remove_earlier_results(folder);
  write_file(folder / "scene.json", scene.json + "\n");
  ListGrowth growth{1. / 2};
  EnsembleResult result = ensemble.run([&](const EnsembleResult& so_far) {
    if (growth.is_due(so_far.frames.size() * so_far.quantities.size()))
      write_ensemble_csv(folder / "ensemble.csv", so_far, Until::handed_over);
  });
  write_ensemble_csv(folder / "ensemble.csv", result);
  write_file(folder / "ensemble.json", to_json(result));
  if (scene.output.pictures)
    draw_or_warn(warnings,
                 [&] { draw_ensemble(folder / "ensemble.svg", result, watched(result, watch), scene.name); });
  return result;
}

}  // namespace jetlag
