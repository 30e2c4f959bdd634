// SPDX-License-Identifier: MIT
#include "jetlag/runs/run_ensemble.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "base/pool.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/tape/kernels.hpp"
#include "jetlag/truncation/draws.hpp"
#include "jetlag/version.hpp"

namespace jetlag {

namespace {

using Clock = std::chrono::steady_clock;

/// The method of a scene that makes an ensemble.
const SeriesMethod& series_of(const Scene& scene, const EnsembleOptions& options) {
  if (!scene.series)
    throw SceneError("integrator.type: an ensemble is made of random_taylor, or with --perturb of taylor");
  if (known_beforehand(scene.series->law).is_fixed() && options.perturbation == 0)
    throw SceneError(
        "integrator: its degree is fixed, so all members would be the same; must be random_taylor with "
        "max_degree > min_degree, or take --perturb SIGMA for members that start apart");
  return *scene.series;
}

std::vector<Quantity> quantities_of(const Scene& scene, bool velocities) {
  std::vector<Quantity> quantities;
  for (int i = 0; i < scene.system->particles(); ++i)
    for (const bool of_velocity : {false, true})
      for (int c = 0; c < scene.system->dimension(); ++c)
        if (!scene.system->fixed()[i] && (!of_velocity || velocities))
          quantities.push_back({i, c, of_velocity});
  if (scene.output.energy) quantities.push_back({});
  return quantities;
}

void check(const Scene& scene, const EnsembleOptions& options) {
  if (options.members < 1 || options.members > 1'000'000)
    throw SceneError("--members: got " + std::to_string(options.members) +
                     "; must be a whole number from 1 to 1000000");
  if (options.threads < 1 || options.threads > 1024)
    throw SceneError("--threads: got " + std::to_string(options.threads) +
                     "; must be a whole number from 1 to 1024");
  if (!(options.perturbation >= 0) || !std::isfinite(options.perturbation))
    throw SceneError("--perturb: got " + number(options.perturbation) + "; must be a finite number >= 0");
  series_of(scene, options);
  if (moving_particles(*scene.system) == 0)
    throw SceneError("particles.fixed: all particles are fixed; an ensemble needs one that moves");
  const double bytes = bytes_needed(scene, options);
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > 0.8 * memory)
    throw SceneError("--members: " + std::to_string(options.members) + " members and " +
                     std::to_string(scene.output.frames) + " frames would take " + number(bytes / 1e9) +
                     " GB; must be below 80 % of the memory of this machine, " + number(memory / 1e9) +
                     " GB");
}

/// --watch as a position in the list of quantities; nothing: of what spreads most.
struct Watch {
  int particle = -1, component = -1;  // -1: any
};
Watch read_watch(const Scene& scene, const std::string& text) {
  if (text.empty()) return {};
  const int dimension = scene.system->dimension(), particles = scene.system->particles();
  const std::string components = std::string("xyz").substr(0, dimension);
  const auto refuse = [&](const std::string& why) {
    throw SceneError("--watch: got " + text +
                     "; must be PARTICLE or PARTICLE.COMPONENT, a moving particle from 0 to " +
                     std::to_string(particles - 1) + " and a component of " + components + why);
  };
  Watch watch;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), watch.particle);
  const std::string rest(end, text.data() + text.size());
  if (error != std::errc() || watch.particle < 0 || watch.particle >= particles) refuse("");
  if (scene.system->fixed()[watch.particle]) refuse("; this particle is fixed");
  if (rest.empty()) return watch;
  const auto component = rest.size() == 2 && rest[0] == '.' ? components.find(rest[1]) : std::string::npos;
  if (component == std::string::npos) refuse("");
  watch.component = static_cast<int>(component);
  return watch;
}
std::size_t watched(const EnsembleResult& result, const Watch& watch) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t q = 0; q < result.quantities.size(); ++q) {
    const Quantity& quantity = result.quantities[q];
    if (quantity.particle < 0 || quantity.of_velocity) continue;
    if (watch.particle >= 0 && quantity.particle != watch.particle) continue;
    if (watch.component >= 0 && quantity.component != watch.component) continue;
    const double spread = result.frames.back().samples[q].spread;
    if (most < 0 || spread > most) {
      best = q;
      most = std::isfinite(spread) ? spread : 0;
    }
  }
  return best;
}

/// A run beside the ensemble, from frame to frame.
class Companion {
 public:
  Companion(const Scene& scene, TruncationLaw law, std::unique_ptr<Control> control,
            RandomTaylor::Options options)
      : taylor_(*scene.system, std::move(law), std::move(control), options),
        state_(scene.initial),
        seen_(scene.initial),
        end_(scene.until) {}

  /// Its state is then that at `time`, from the polynomial of the last step. Returns whether it has got there.
  bool advance_to(double time, const std::function<bool()>& go_on) {
    while (message_.empty() && state_.time < time) {
      if (go_on && !go_on()) {
        message_ = "was stopped at t = " + number(state_.time) + " s";
        break;
      }
      if (taylor_.work().steps >= most_steps)
        message_ = "left at t = " + number(state_.time) + " s after " + std::to_string(most_steps) + " steps";
      Report report;
      const double limit = end_ - state_.time, h = taylor_.step(state_, limit, report);
      if (report.outcome != Outcome::success)
        message_ = "ended at t = " + number(state_.time) + " s: " + report.message;
      else
        state_.time = h == limit ? end_ : state_.time + h;
    }
    if (message_.empty()) seen_ = state_.time == time ? state_ : taylor_.piece().at(time);
    return message_.empty();
  }
  const State<double>& state() const { return seen_; }
  /// Why it goes no further; empty: it does.
  const std::string& message() const { return message_; }
  const Work& work() const { return taylor_.work(); }

 private:
  static constexpr std::uint64_t most_steps = 5'000'000;
  RandomTaylor taylor_;
  State<double> state_, seen_;
  double end_;
  std::string message_;
};

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

RandomTaylor::Options companion_options(const SeriesMethod& series, bool is_reference) {
  RandomTaylor::Options options = series.options;
  if (is_reference) options.velocity = VelocitySeries::own_series;
  return options;
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
        reference_(scene, fixed_degree(20), std::make_unique<JorbaZou>(), companion_options(series_, true)) {
    result_.quantities = quantities_of(scene, options.velocities);
    result_.members = options.members;
    result_.perturbation = options.perturbation;
    result_.in_lanes = members_.in_lanes();
    result_.threads = options.threads;
    result_.seed = scene.seed;
    result_.version = version;
    result_.instruction_set = kernels<double>().instruction_set;
    for (std::size_t i = 0; i < members_.size(); ++i) alive_.push_back(i);
  }

  EnsembleResult run() {
    const int last = scene_.output.frames;
    measure(0.0);
    for (int f = 1; f <= last; ++f) {
      const double t = f == last ? scene_.until : scene_.until * f / last;
      const auto start = Clock::now();
      const bool arrived = members_.advance_to(t, hooks_.go_on);
      result_.wall_seconds += std::chrono::duration<double>(Clock::now() - start).count();
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
    result_.reference_message = reference_.message();
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
    Companion run(scene_, fixed_degree(degree), series_.control->clone(), companion_options(series_, false));
    std::vector<double> of_run(result_.quantities.size());
    EnergyMeter meter(*scene_.system);
    for (EnsembleFrame& frame : result_.frames) {
      if (!run.advance_to(frame.time, hooks_.go_on)) break;
      values(run.state(), meter, [&](std::size_t q, double x) { of_run[q] = x; });
      frame.calibration.deterministic_error = error(frame, of_run);
    }
    result_.deterministic_work = run.work();
    result_.deterministic_message = run.message();
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

  /// The value of every quantity in a state.
  template <class Put>
  void values(const State<double>& state, EnergyMeter& meter, const Put& put) const {
    for (std::size_t q = 0; q < result_.quantities.size(); ++q) {
      const auto& [particle, component, of_velocity] = result_.quantities[q];
      put(q, particle < 0  ? meter(state).total()
             : of_velocity ? state.velocity(particle, component)
                           : state.position(particle, component));
    }
  }

  void measure(double time) {
    constexpr std::size_t together = 16;  // members, quantities
    const std::size_t n = alive_.size(), count = result_.quantities.size();
    values_.resize(n * count);
    const auto make = [&] { return std::make_unique<EnergyMeter>(*scene_.system); };
    workers_.each((n + together - 1) / together, [&](std::size_t part) {
      auto meter = meters_.lend(make);
      for (std::size_t i = part * together; i < std::min(n, (part + 1) * together); ++i)
        values(members_.state(alive_[i]), *meter, [&](std::size_t q, double x) { values_[q * n + i] = x; });
      meters_.give_back(std::move(meter));
    });
    EnsembleFrame frame;
    frame.time = time;
    frame.members = n;
    frame.samples.resize(count);
    workers_.each((count + together - 1) / together, [&](std::size_t part) {
      for (std::size_t q = part * together; q < std::min(count, (part + 1) * together); ++q)
        frame.samples[q] = sample_of({values_.data() + q * n, n});
    });
    frame.reference.assign(count, Calibration::not_known);
    auto meter = meters_.lend(make);
    if (reference_.message().empty())
      values(reference_.state(), *meter, [&](std::size_t q, double x) { frame.reference[q] = x; });
    meters_.give_back(std::move(meter));
    frame.calibration = calibration(frame);
    result_.frames.push_back(std::move(frame));
  }

  /// The mean square of member - reference is that of the members about their mean and that of the mean:
  ///     sum_i (x_i - r)^2 / n = (n - 1)/n s^2 + (mean - r)^2.
  Calibration calibration(const EnsembleFrame& frame) const {
    double spread = 0, members = 0, mean = 0, count = 0;
    const auto n = static_cast<double>(frame.members);
    for (std::size_t q = 0; q < result_.quantities.size(); ++q) {
      if (!is_position(q)) continue;
      const Sample& sample = frame.samples[q];
      const double of_mean = sample.mean - frame.reference[q];
      const double own = n > 1 ? (n - 1) / n * sample.spread * sample.spread : 0.0;
      spread += sample.spread * sample.spread;
      members += own + of_mean * of_mean;
      mean += of_mean * of_mean;
      ++count;
    }
    const auto root = [&](double sum) { return std::sqrt(sum / count); };
    return {root(spread), root(members), root(mean)};
  }

  /// Root mean square of x - reference over the positions.
  double error(const EnsembleFrame& frame, const std::vector<double>& x) const {
    double sum = 0, count = 0;
    for (std::size_t q = 0; q < x.size(); ++q) {
      if (!is_position(q)) continue;
      sum += (x[q] - frame.reference[q]) * (x[q] - frame.reference[q]);
      ++count;
    }
    return std::sqrt(sum / count);
  }

  bool is_position(std::size_t q) const {
    return result_.quantities[q].particle >= 0 && !result_.quantities[q].of_velocity;
  }

  const Scene& scene_;
  const EnsembleHooks& hooks_;
  const SeriesMethod& series_;
  Workers workers_;
  RandomEnsemble members_;
  Companion reference_;
  EnsembleResult result_;
  std::vector<std::size_t> alive_;
  std::vector<double> values_;  // [quantity][member]
  Pool<EnergyMeter> meters_;
};

}  // namespace

double bytes_needed(const Scene& scene, const EnsembleOptions& options) {
  constexpr double in_a_sample = sizeof(Sample) + sizeof(double),
                   in_the_table = 2 * 260;  // text, as it grows
  const auto quantities = static_cast<double>(quantities_of(scene, options.velocities).size());
  const double of_a_member = RandomEnsemble::bytes_of_a_member(*scene.system, series_of(scene, options));
  return options.members * (of_a_member + quantities * sizeof(double)) +
         scene.output.frames * quantities * (in_a_sample + in_the_table);
}

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
  std::filesystem::create_directories(folder);
  for (const char* name : {"ensemble.json", "ensemble.csv", "ensemble.svg"})
    std::filesystem::remove(folder / name);
  write_file(folder / "scene.json", scene.json + "\n");
  EnsembleResult result = ensemble.run();
  write_ensemble_csv(folder / "ensemble.csv", result);
  write_file(folder / "ensemble.json", to_json(result));
  if (scene.output.pictures && !can_draw()) {
    warnings.push_back("gnuplot is not installed: no pictures are drawn");
  } else if (scene.output.pictures) {
    try {
      draw_ensemble(folder / "ensemble.svg", result, watched(result, watch), scene.name);
    } catch (const std::runtime_error& error) {
      warnings.push_back(error.what());
    }
  }
  return result;
}

}  // namespace jetlag
