// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace long_runs {  // batches compile studies together
namespace {

constexpr double period = 2 * std::numbers::pi;

/// A planet (particle 1) round a fixed sun, G = 1: semi-major axis 1, period 2 pi, energy -1/2.
class Planet {
 public:
  /// e: eccentricity; anomaly: the eccentric anomaly at the start; turn: of the orbit in its plane [rad].
  Planet(double e, double anomaly, double turn, bool compensated) : system_(2, {1.0, 1.0}) {
    system_.fix(0);
    system_.add<Gravity>({{0, 1}}, {{1.0}});
    const double c = std::cos(anomaly), s = std::sin(anomaly), b = std::sqrt((1 - e) * (1 + e)),
                 r = 1 - e * c;
    state_ = {0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
    Eigen::RowVector2d x(c - e, b * s), v(-s / r, b * c / r);
    if (anomaly == 0) {  // as in the references, to the last bit
      x = {1 - e, 0};
      v = {0, std::sqrt((1 + e) / (1 - e))};
    }
    Eigen::Matrix2d rotation;
    rotation << std::cos(turn), std::sin(turn), -std::sin(turn), std::cos(turn);
    state_.position.row(1) = x * rotation;
    state_.velocity.row(1) = v * rotation;
    start_ = state_;
    RandomTaylor::Options options;
    options.compensated = compensated;
    schedule_ = std::make_unique<Lockstep>(
        std::make_unique<RandomTaylor>(system_, fixed_degree(20), std::make_unique<JorbaZou>(), options));
  }

  void run_to(double until) { schedule_->run(state_, until, {}); }

  std::uint64_t steps() const { return schedule_->work().steps; }
  double energy_error() const { return static_cast<double>(energy(state_) / energy(start_) - 1); }
  double distance_from_start() const { return (state_.position - start_.position).norm(); }

 private:
  /// |v|^2 / 2 - 1 / |x|, rests included: 1000 times larger terms cancel near the sun.
  static long double energy(const State<double>& state) {
    const auto squared = [](const Coordinates<double>& y, const Coordinates<double>& rest) {
      long double sum = 0;
      for (int c = 0; c < 2; ++c) {
        const long double z = y(1, c) + (rest.size() == 0 ? 0.0L : static_cast<long double>(rest(1, c)));
        sum += z * z;
      }
      return sum;
    };
    return squared(state.velocity, state.velocity_rest) / 2 -
           1 / std::sqrt(squared(state.position, state.position_rest));
  }

  System<double> system_;
  State<double> state_, start_;
  std::unique_ptr<Lockstep> schedule_;
};

double root_mean_square(const std::vector<double>& errors) {
  double sum = 0;
  for (double error : errors) sum += error * error;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

struct Arguments {
  int periods, runs;
  std::uint64_t seed = 1;
  bool plain = false;
};

/// The planets of the references from the pericentre; beyond the first run with the orbit turned in its plane, so that
/// rounding falls otherwise.
int run_kepler(const Arguments& arguments) {
  std::printf("degree 20, jorba_zou, %d periods, %d runs with the orbit turned\n", arguments.periods,
              arguments.runs);
  std::printf("%6s %-12s %12s  %-34s %14s\n", "", "", "steps", "relative error of the energy", "position");
  std::printf("%6s %-12s %12s  %10s %11s %11s %14s\n", "e", "sums", "a period", "first run", "rms", "largest",
              "first run");
  for (const bool compensated : {false, true})
    for (const double e : {0.9, 0.99, 0.999}) {
      std::vector<double> errors;
      double steps = 0, distance = 0;
      for (int run = 0; run < arguments.runs; ++run) {
        Planet planet(e, 0.0, run == 0 ? 0.0 : period * uniform(arguments.seed, 0, run), compensated);
        planet.run_to(arguments.periods * period);
        errors.push_back(std::abs(planet.energy_error()));
        steps += static_cast<double>(planet.steps()) / arguments.periods / arguments.runs;
        if (run == 0) distance = planet.distance_from_start();
      }
      std::printf("%6g %-12s %12.2f  %10.2g %11.2g %11.2g %14.2g\n", e, compensated ? "compensated" : "plain",
                  steps, errors[0], root_mean_square(errors), *std::ranges::max_element(errors), distance);
      std::fflush(stdout);
    }
  return 0;
}

/// Rounding that is not biased makes the energy walk at random: the error grows with the root of time, and that of the
/// phase with its power 3/2.         Source: Brouwer, Astron. J. 46 (1937) 149.
int run_brouwer(const Arguments& arguments) {
  std::vector<Planet> planets;
  for (int run = 0; run < arguments.runs; ++run)
    planets.emplace_back(0.5, period * uniform(arguments.seed, 0, run),
                         period * uniform(arguments.seed, 1, run), !arguments.plain);
  std::printf("e = 0.5, %d runs from random phases, degree 20, jorba_zou, %s sums\n", arguments.runs,
              arguments.plain ? "plain" : "compensated");
  std::printf("%10s %14s %14s %14s\n", "periods", "rms dE/E", "mean dE/E", "steps/period");
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;  // of the straight line through log periods, log rms
  for (int decade = 1; decade <= arguments.periods; decade *= 10)
    for (int digit : {1, 2, 5}) {
      const int periods = decade * digit;
      if (periods > arguments.periods) break;
      std::vector<double> errors;
      double steps = 0, mean = 0;
      for (Planet& planet : planets) {
        planet.run_to(periods * period);
        errors.push_back(planet.energy_error());
        mean += errors.back() / arguments.runs;
        steps += static_cast<double>(planet.steps()) / periods / arguments.runs;
      }
      const double rms = root_mean_square(errors), x = std::log10(periods), y = std::log10(rms);
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
      std::printf("%10d %14.3g %14.2g %14.2f\n", periods, rms, mean, steps);
      std::fflush(stdout);
    }
  if (n > 1)
    std::printf("the rms grows with the power %.3f of time\n", (n * sxy - sx * sy) / (n * sxx - sx * sx));
  return 0;
}

std::vector<Option> options_of_both(Arguments& a) {
  return {{"--periods", &a.periods, "length of the runs", Between{1, 1'000'000}},
          {"--runs", &a.runs, "number of runs", Between{1, 10'000}},
          {"--seed", &a.seed, "seed"}};
}

}  // namespace
}  // namespace long_runs

Command kepler_study() {
  using namespace long_runs;
  return command<Arguments>("kepler",
                            "planets of e = .9, .99, .999: steps a period and what becomes of the energy",
                            run_kepler, options_of_both, {1000, 1});
}

Command brouwer_study() {
  using namespace long_runs;
  return command<Arguments>(
      "brouwer", "how the energy errors of planets from random phases grow with time", run_brouwer,
      [](Arguments& a) {
        std::vector<Option> options = options_of_both(a);
        options.push_back({"--plain", &a.plain, "plain sums in place of compensated ones"});
        return options;
      },
      {1000, 16});
}

}  // namespace jetlag
