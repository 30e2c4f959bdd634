// SPDX-License-Identifier: MIT
// What do clocks of their own save? Block steps beside one clock, both run in turn on the same scene from the same
// state with the same step rule, and the error of both; and what an event costs in the queue.
//
//   BM_Asynchrony/<scene>/<degree>   lockstep_over_block: time, one thread; elements_over: element coefficients;
//                                    error_over: error of block steps over that of lockstep; at_equal_error: time, with
//                                    the coarsest tolerance of lockstep, 10^(-1/4) apart, that is as accurate as block
//   BM_AgainstLeapfrog/<digits>      the stiff patch to an error of 10^-digits m: leapfrog_over_block: time, each with the
//                                    coarsest of its settings that is as accurate: steps of leapfrog 2^(-1/4) apart,
//                                    tolerances 10^(-1/4) apart for degrees 4, 6, 8, 10; and the errors of both
//   BM_EventQueue/<clocks>           the time of one event

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "benchmarks.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/event_queue.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"

namespace jetlag::bench {

namespace {

/// 50 x 50 particles of 1 kg, 0.1 m apart, springs as in the scene `cloth` of 5 N/m; those within a square of 5 % are
/// 1e3 times stiffer. It begins flat, with a smooth velocity.
Uneven cloth_with_a_stiff_patch() {
  constexpr int side = 50, first = 16, last = 27;
  constexpr double spacing = 0.1;
  Uneven scene{System<double>(3, std::vector<double>(side * side, 1.0)),
               {0.0, Coordinates<double>::Zero(side * side, 3), Coordinates<double>::Zero(side * side, 3)},
               4,
               0.25,
               0.004};
  const auto in_patch = [](int i) { return first <= i && i <= last; };
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 2>> springs;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double x = static_cast<double>(i) / side, y = static_cast<double>(j) / side,
                   pi = std::numbers::pi;
      scene.state.position.row(i * side + j) << spacing * i, spacing * j, 0.0;
      scene.state.velocity.row(i * side + j) << 0.1 * std::sin(3 * y), 0.1 * std::cos(4 * x),
          0.3 * std::sin(pi * x) * std::sin(2 * pi * y);
      for (const auto& [a, b] : {std::pair(0, 1), {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}}) {
        const int k = i + a, l = j + b;
        if (k >= side || l < 0 || l >= side) continue;
        const bool stiff = in_patch(i) && in_patch(j) && in_patch(k) && in_patch(l);
        pairs.push_back({i * side + j, k * side + l});
        springs.push_back({stiff ? 5e3 : 5.0, spacing * std::hypot(a, b)});
      }
    }
  scene.system.add<Spring>(pairs, springs);
  return scene;
}

struct Measured {
  double seconds;  // of the processor
  std::uint64_t element_coefficients;
  State<double> end;
};
template <class Make>
Measured measured(const Uneven& scene, const Make& make) {
  Measured result{0, 0, scene.state};
  auto schedule = make();
  const std::clock_t start = std::clock();
  schedule.run(result.end, scene.until, {});
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  result.element_coefficients = schedule.work().element_coefficients;
  return result;
}

double largest_error(const State<double>& a, const State<double>& b) {
  const double error = (a.position - b.position).cwiseAbs().maxCoeff();
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

/// The first of the settings 0, 1, .. whose error is at most `target`.
template <class Make>
double first_accurate(const Uneven& scene, const State<double>& truth, double target, const Make& make) {
  for (int setting = 0;; ++setting)
    if (largest_error(measured(scene, [&] { return make(setting); }).end, truth) <= target) return setting;
}

void asynchrony(benchmark::State& run, Uneven (*make)(), int degree, double tolerance) {
  const Uneven scene = make();
  const auto lockstep_to = [&](double tolerated) {
    return Lockstep(taylor(scene.system, degree, std::make_unique<LastTwo>(tolerated, scene.max_step)));
  };
  const auto lockstep = [&] { return lockstep_to(tolerance); };
  const auto block = [&] {
    BlockSteps::Options options;
    options.tolerance = tolerance;
    options.max_step = scene.max_step;
    return BlockSteps(scene.system, degree, options);
  };
  const Measured truth = measured(scene, [&] {
    return Lockstep(taylor(scene.system, 20, std::make_unique<FixedStep>(scene.exact_step)));
  });
  const auto error = [&](const Measured& m) { return largest_error(m.end, truth.end); };
  const auto coarser = [&](int setting) {
    return lockstep_to(tolerance * std::pow(10.0, 2 - 0.25 * setting));
  };
  const int as_accurate = first_accurate(scene, truth.end, error(measured(scene, block)), coarser);
  double one_clock = std::numeric_limits<double>::infinity(), many = one_clock, equal = one_clock;
  for (auto _ : run) {
    const Measured a = measured(scene, lockstep), b = measured(scene, block),
                   c = measured(scene, [&] { return coarser(as_accurate); });
    one_clock = std::min(one_clock, a.seconds);
    many = std::min(many, b.seconds);
    equal = std::min(equal, c.seconds);
    run.counters["elements_over"] =
        static_cast<double>(a.element_coefficients) / static_cast<double>(b.element_coefficients);
    run.counters["error_lockstep"] = error(a);
    run.counters["error_over"] = error(b) / error(a);
  }
  run.counters["lockstep_over_block"] = one_clock / many;
  run.counters["at_equal_error"] = equal / many;
}

void against_leapfrog(benchmark::State& run, int digits) {
  const Uneven scene = cloth_with_a_stiff_patch();
  const double target = std::pow(10.0, -digits);
  const State<double> truth =
      measured(scene, [&] {
        return Lockstep(taylor(scene.system, 20, std::make_unique<FixedStep>(scene.exact_step)));
      }).end;
  const double limit = 2 / frequency_bound(scene.system);
  const auto leapfrog = [&](int setting) {
    return Lockstep(std::make_unique<Leapfrog>(scene.system, limit * std::exp2(-0.25 * setting)));
  };
  struct Clocks {
    int degree, setting;
    double seconds;
  };
  std::vector<Clocks> candidates;
  const auto block = [&](int degree, int setting) {
    BlockSteps::Options options;
    options.tolerance = target * std::pow(10.0, 1 - 0.25 * setting);
    options.max_step = scene.max_step;
    return BlockSteps(scene.system, degree, options);
  };
  const int steps = first_accurate(scene, truth, target, leapfrog);
  for (int degree : {4, 6, 8, 10}) {
    const int setting = first_accurate(scene, truth, target, [&](int n) { return block(degree, n); });
    candidates.push_back({degree, setting, measured(scene, [&] { return block(degree, setting); }).seconds});
  }
  const Clocks best = *std::ranges::min_element(candidates, {}, &Clocks::seconds);
  double one_clock = std::numeric_limits<double>::infinity(), many = one_clock;
  for (auto _ : run) {
    const Measured a = measured(scene, [&] { return leapfrog(steps); }),
                   b = measured(scene, [&] { return block(best.degree, best.setting); });
    one_clock = std::min(one_clock, a.seconds);
    many = std::min(many, b.seconds);
    run.counters["error_leapfrog"] = largest_error(a.end, truth);
    run.counters["error_block"] = largest_error(b.end, truth);
  }
  run.counters["degree"] = best.degree;
  run.counters["leapfrog_over_block"] = one_clock / many;
}

/// Each event: the earliest clock is set to a later time, of up to 64 steps of the shortest.
void event_queue(benchmark::State& run, int clocks) {
  EventQueue queue(clocks);
  for (int i = 0; i < clocks; ++i) queue.set(i, static_cast<EventQueue::Time>(1e6 * uniform(1, i, 0)));
  constexpr int events = 1 << 16;
  std::vector<EventQueue::Time> steps;
  for (int i = 0; i < events; ++i)
    steps.push_back(static_cast<EventQueue::Time>(1e4 * std::exp2(6 * uniform(2, i, 0))));
  for (auto _ : run)
    for (int i = 0; i < events; ++i) queue.set(queue.clock(), queue.time() + steps[i]);
  using benchmark::Counter;
  run.counters["items"] = events;
  run.counters["per_event"] = Counter(events, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

}  // namespace

void register_asynchrony() {
  struct Case {
    const char* name;
    Uneven (*make)();
    int degree;
    double tolerance;
  };
  for (const Case& c : {Case{"chain128", chain, 8, 1e-9},
                        {"chain128", chain, 12, 1e-12},
                        {"chain128", chain, 16, 1e-12},
                        {"stiff_patch50", cloth_with_a_stiff_patch, 8, 1e-8},
                        {"stiff_patch50", cloth_with_a_stiff_patch, 12, 1e-10},
                        {"stiff_patch50", cloth_with_a_stiff_patch, 16, 1e-11}})
    benchmark::RegisterBenchmark(
        ("BM_Asynchrony/" + std::string(c.name) + "/" + std::to_string(c.degree)).c_str(), asynchrony, c.make,
        c.degree, c.tolerance)
        ->Unit(benchmark::kMillisecond);
  for (int digits : {3, 6})
    benchmark::RegisterBenchmark(("BM_AgainstLeapfrog/" + std::to_string(digits)).c_str(), against_leapfrog,
                                 digits)
        ->Unit(benchmark::kMillisecond);
  for (int clocks : {1000, 100000})
    benchmark::RegisterBenchmark(("BM_EventQueue/" + std::to_string(clocks)).c_str(), event_queue, clocks);
}

}  // namespace jetlag::bench
