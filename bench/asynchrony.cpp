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

#include "benchmarks.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/event_queue.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/truncation/draws.hpp"
#include "problems/chains.hpp"
#include "problems/nets.hpp"

namespace jetlag::bench {

namespace {

/// A problem with a stiff part, the longest stable step of its soft part being its largest_step.
struct Uneven : Problem {
  double exact_step;  // [s]: exact for its stiff part
};

Uneven chain128() {
  Uneven scene{problems::stiff_spot_in_a_chain(128, 1e4), 0.005};
  scene.until = 20;
  scene.largest_step = 1.25;
  return scene;
}

Uneven stiff_patch50() { return {problems::cloth_with_a_stiff_patch(), 0.004}; }

struct Measured {
  double seconds;  // of the processor
  std::uint64_t element_coefficients;
  State<double> end;
};
template <class Make>
Measured measured(const Uneven& scene, const Make& make) {
  Measured result{0, 0, scene.start};
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
    return Lockstep(taylor(scene.system, degree, std::make_unique<LastTwo>(tolerated, scene.largest_step)));
  };
  const auto lockstep = [&] { return lockstep_to(tolerance); };
  const auto block = [&] {
    BlockSteps::Options options;
    options.tolerance = tolerance;
    options.max_step = scene.largest_step;
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
  const Uneven scene = stiff_patch50();
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
    options.max_step = scene.largest_step;
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
  for (const Case& c : {Case{"chain128", chain128, 8, 1e-9},
                        {"chain128", chain128, 12, 1e-12},
                        {"chain128", chain128, 16, 1e-12},
                        {"stiff_patch50", stiff_patch50, 8, 1e-8},
                        {"stiff_patch50", stiff_patch50, 12, 1e-10},
                        {"stiff_patch50", stiff_patch50, 16, 1e-11}})
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
