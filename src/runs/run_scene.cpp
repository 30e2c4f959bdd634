// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>

#include "jetlag/model/finite.hpp"
#include "jetlag/output/clock_table.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/vtu.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/tape/kernels.hpp"
#include "jetlag/version.hpp"

namespace jetlag {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What is wrong with a state whose numbers are finite but not what is made of them; success where nothing is.
Report usable(const System<double>& system, const State<double>& state, const EnergyRow* row) {
  Report report;
  if (!in_range(state, largest_number, state.time, report)) {
    report.message = "the motion has blown up: at t = " + number(state.time) + " a number of particle " +
                     std::to_string(report.particle) + " is beyond " + number(largest_number) +
                     ", where squares overflow; take a shorter step or a smaller tolerance";
    return report;
  }
  const bool finite = !row || (std::isfinite(row->energy.total()) && std::isfinite(row->relative_error));
  if (finite && momentum(system, state).allFinite()) return {};
  int fastest = 0;
  state.velocity.rowwise().squaredNorm().maxCoeff(&fastest);
  return {Outcome::non_finite,
          std::string("the ") + (finite ? "momentum" : "energy") + " at t = " + number(state.time) +
              " is not finite, and particle " + std::to_string(fastest) +
              " is the fastest: particles coincide, or the motion has blown up; take a shorter step or a "
              "smaller tolerance",
          fastest};
}

/// Whether all forces have potentials, and depend on positions only.
bool conserves_energy(const System<double>& system) {
  const auto is_of_position = [](const Node& node) {
    const bool other = node.input.kind == Input::Kind::velocity || node.input.kind == Input::Kind::time;
    return node.kind != Node::Kind::input || !other;
  };
  return std::ranges::all_of(system.elements(), [&](const Elements<double>& group) {
    return group.count() == 0 ||
           (group.law.energy && std::ranges::all_of(group.law.force.nodes, is_of_position));
  });
}

/// Hands out the frames, and keeps the table of energies, up to the first state that has none.
class Recorder {
 public:
  Recorder(const Scene& scene, const RunHooks& hooks, RunResult& result)
      : scene_(scene), hooks_(hooks), result_(result), last_(scene.initial) {
    if (scene.output.energy) meter_.emplace(*scene.system);
    record(scene.initial);
  }

  /// The times of all frames but the first.
  std::vector<double> times() const {
    std::vector<double> times;
    for (int frame = 1; frame <= scene_.output.frames; ++frame) times.push_back(time_of(frame));
    return times;
  }

  /// The state where a run has ended early, unless it is a frame already.
  void last_good(const State<double>& state) {
    if (state.time > last_.time) record(state);
  }

  /// What the energies say against the method. An initial energy that is small because its parts cancel is no measure:
  /// the change must be seen beside the kinetic energy too.
  void judge() const {
    Summary& summary = result_.summary;
    if (summary.max_relative_energy_error <= 0.1 || largest_change_ <= 1e-3 * largest_kinetic_) return;
    if (!conserves_energy(*scene_.system)) return;
    std::ostringstream text;
    text.precision(3);
    text << "energy is conserved by this scene but changed by " << summary.max_relative_energy_error
         << " times what it was: the step is too long or the method unstable; take a smaller step or "
            "tolerance";
    summary.warnings.push_back(text.str());
  }

  /// What is wrong with the first state that was not recorded; success where all were.
  const Report& failure() const { return failure_; }
  /// The last state that was recorded.
  const State<double>& last() const { return last_; }

  void record(const State<double>& state) {
    if (failure_.outcome != Outcome::success) return;
    EnergyRow row{state.time, {}, 0.0};
    if (meter_) row = measured(state);
    failure_ = usable(*scene_.system, state, meter_ ? &row : nullptr);
    if (failure_.outcome != Outcome::success) return;
    last_ = state;
    if (meter_) keep(row);
    if (!hooks_.frame) return;
    Frame frame{state.time, state.position, state.velocity};
    if (result_.clocks) {
      frame.step = result_.clocks->step();
      frame.degree = result_.clocks->degree();
    }
    hooks_.frame(frame);
  }

 private:
  EnergyRow measured(const State<double>& state) {
    const Energy energy = (*meter_)(state);
    const double initial = result_.energies.empty() ? energy.total() : result_.summary.initial_energy.total();
    const double scale = initial != 0 ? std::abs(initial) : std::max(largest_kinetic_, energy.kinetic);
    return {state.time, energy, scale > 0 ? (energy.total() - initial) / scale : 0.0};
  }
  void keep(const EnergyRow& row) {
    Summary& summary = result_.summary;
    if (result_.energies.empty()) summary.initial_energy = row.energy;
    largest_change_ =
        std::max(largest_change_, std::abs(row.energy.total() - summary.initial_energy.total()));
    largest_kinetic_ = std::max(largest_kinetic_, row.energy.kinetic);
    result_.energies.push_back(row);
    summary.max_relative_energy_error =
        std::max(summary.max_relative_energy_error, std::abs(row.relative_error));
  }

  double time_of(int frame) const {
    return frame == scene_.output.frames ? scene_.until : scene_.until * frame / scene_.output.frames;
  }

  const Scene& scene_;
  const RunHooks& hooks_;
  RunResult& result_;
  std::optional<EnergyMeter> meter_;
  double largest_kinetic_ = 0, largest_change_ = 0;  // [J]
  State<double> last_;
  Report failure_;
};

/// Keeps frames for the film strip: all of a small scene, evenly spaced ones of a large one.
class FilmFrames {
 public:
  explicit FilmFrames(const Scene& scene) {
    const double numbers = 2.0 * scene.shape.particles * scene.shape.dimension * (scene.output.frames + 1);
    stride_ = std::max(1, static_cast<int>(numbers / 4e6));
    stride_ = std::min(stride_, std::max(1, scene.output.frames / 12));
  }
  void add(const Frame& frame) {
    if (count_++ % stride_ == 0)
      frames_.push_back(frame);
    else
      last_ = frame;
  }
  std::vector<Frame> all() const {
    auto frames = frames_;
    if (last_.time > frames.back().time) frames.push_back(last_);
    return frames;
  }

 private:
  int stride_, count_ = 0;
  std::vector<Frame> frames_;
  Frame last_;
};

std::string frame_name(std::size_t number) {
  const std::string digits = std::to_string(number);
  return "frame_" + std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits + ".vtu";
}

/// Whether a name is one that frame_name gives: nothing else is ever removed.
bool is_frame(const std::string& name) {
  const std::string digits = name.size() > 10 ? name.substr(6, name.size() - 10) : "";
  return !digits.empty() && digits.size() <= 9 &&
         digits.find_first_not_of("0123456789") == std::string::npos &&
         name == frame_name(std::stoul(digits));
}

void remove_earlier_run(const std::filesystem::path& folder) {
  for (const char* name :
       {"summary.json", "energy.csv", "energy.svg", "film.png", "film.svg", "clocks.csv", "clocks.svg"})
    std::filesystem::remove(folder / name);
  if (std::filesystem::is_directory(folder / "frames"))
    for (const auto& entry : std::filesystem::directory_iterator(folder / "frames"))
      if (is_frame(entry.path().filename().string())) std::filesystem::remove(entry.path());
}

}  // namespace

namespace {

RunResult run_schedule(const Scene& scene, Schedule& schedule, const RunHooks& hooks) {
  RunResult result;
  Summary& summary = result.summary;
  State<double> state = scene.initial;
  if (scene.output.clocks) result.clocks.emplace(scene.system->fixed());
  Recorder recorder(scene, hooks, result);

  double recording = 0;  // seconds spent on frames and hooks, which are not part of the integration
  const auto start = Clock::now();
  RunOptions options;
  options.largest = largest_number;
  options.max_steps = scene.max_steps;
  options.observer.frame_times = recorder.times();
  const auto untimed = [&](const auto& f) {
    const auto begin = Clock::now();
    f();
    recording += seconds_since(begin);
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
  summary.wall_seconds = seconds_since(start) - recording;
  if (report.outcome != Outcome::success) recorder.last_good(state);
  if (recorder.failure().outcome != Outcome::success) {
    if (report.outcome != Outcome::non_finite) report = recorder.failure();
    state = recorder.last();
  }

  if (report.outcome == Outcome::interrupted)
    report.message += " s, as asked: the outputs hold the run up to there; run it again for the rest";
  recorder.judge();

  summary.outcome = report.outcome;
  summary.message = report.message;
  summary.time = state.time;
  summary.has_energy = scene.output.energy;
  if (scene.output.energy) summary.final_energy = EnergyMeter(*scene.system)(state);
  summary.initial_momentum = momentum(*scene.system, scene.initial);
  summary.final_momentum = momentum(*scene.system, state);
  summary.work = schedule.work();
  summary.position = std::move(state.position);
  summary.velocity = std::move(state.velocity);
  summary.version = version;
  summary.seed = scene.seed;
  summary.threads = scene.threads;
  summary.instruction_set = kernels<double>().instruction_set;
  return result;
}

}  // namespace

RunResult run_scene(const Scene& scene, const RunHooks& hooks) {
  return run_schedule(scene, *scene.schedule(), hooks);
}

RunResult run_scene_into(const Scene& scene, const std::filesystem::path& folder, const RunHooks& hooks,
                         std::vector<std::string>& warnings) {
  const auto schedule = scene.schedule();  // its memory is taken before anything is written
  std::filesystem::create_directories(folder / "frames");
  remove_earlier_run(folder);
  write_file(folder / "scene.json", scene.json + "\n");

  FilmFrames film(scene);
  std::vector<double> times;
  std::vector<std::string> names;
  RunHooks all = hooks;
  all.frame = [&](const Frame& frame) {
    names.push_back(frame_name(names.size()));
    times.push_back(frame.time);
    write_vtu(folder / "frames" / names.back(), scene.shape, frame);
    film.add(frame);
    if (hooks.frame) hooks.frame(frame);
  };
  RunResult result = run_schedule(scene, *schedule, all);
  write_pvd(folder / "frames" / "run.pvd", times, names);
  if (scene.output.energy) write_energy_csv(folder / "energy.csv", result.energies);
  if (result.clocks) write_clocks_csv(folder / "clocks.csv", *result.clocks);
  write_file(folder / "summary.json", to_json(result.summary));

  if (scene.output.pictures && !can_draw()) {
    warnings.push_back("gnuplot is not installed: no pictures are drawn");
  } else if (scene.output.pictures) {
    try {
      if (scene.output.energy) draw_energy(folder / "energy.csv", folder / "energy.svg", scene.name);
      if (result.clocks) draw_clocks(folder / "clocks.svg", *result.clocks, scene.until, scene.name);
      draw_film(folder / "film.png", scene.shape, film.all(), scene.name);
    } catch (const std::runtime_error& error) {
      warnings.push_back(error.what());
    }
  }
  return result;
}

}  // namespace jetlag
