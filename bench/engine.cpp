// SPDX-License-Identifier: MIT
// The engine at its limit: everything that `./run bench engine` puts into one table.

#include "engine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

#include "benchmarks.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/ensembles/ensemble.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/record.hpp"

namespace jetlag::bench {

namespace {

// ---- the peak of the machine ------------------------------------------------------------------------------

/// Multiply-adds of 16 independent vectors of the widest registers this machine has; returns how many numbers a vector
/// holds. More than a fused multiply-add unit can keep in flight, and no loads: the peak.
typedef double TwoNumbers __attribute__((vector_size(16)));
typedef double FourNumbers __attribute__((vector_size(32)));
typedef double EightNumbers __attribute__((vector_size(64)));
template <class Vector>
[[gnu::always_inline]] inline int multiply_adds(std::int64_t rounds) {
  constexpr int width = sizeof(Vector) / sizeof(double);
  Vector sum[16], factor = {}, addend = {};
  for (int i = 0; i < width; ++i) factor[i] = 0.999, addend[i] = 1e-3;
  for (auto& s : sum) s = addend;
  for (std::int64_t round = 0; round < rounds; ++round)
    for (auto& s : sum) s = s * factor + addend;
  for (auto& s : sum) benchmark::DoNotOptimize(s);
  return width;
}
#if defined(__x86_64__)
[[gnu::target("avx512f"), gnu::optimize("fp-contract=fast")]] int multiply_adds_avx512(std::int64_t rounds) {
  return multiply_adds<EightNumbers>(rounds);
}
[[gnu::target("avx2,fma"), gnu::optimize("fp-contract=fast")]] int multiply_adds_avx2(std::int64_t rounds) {
  return multiply_adds<FourNumbers>(rounds);
}
#endif
int multiply_adds_plain(std::int64_t rounds) { return multiply_adds<TwoNumbers>(rounds); }

void peak(benchmark::State& run) {
  constexpr std::int64_t rounds = 1000;
  auto* function = &multiply_adds_plain;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) function = &multiply_adds_avx2;
  if (__builtin_cpu_supports("avx512f")) function = &multiply_adds_avx512;
#endif
  int width = 0;
  for (auto _ : run) width = function(rounds);
  run.counters["items"] = static_cast<double>(16 * rounds * width);
}

/// A chain of multiply-adds each of which waits for the one before: the unit of time of small systems.
#if defined(__x86_64__)
[[gnu::target("fma")]] double chain_of_multiply_adds(std::int64_t rounds, double sum, double factor) {
  for (std::int64_t i = 0; i < rounds; ++i) sum = __builtin_fma(sum, factor, 1e-3);
  return sum;
}
#else
double chain_of_multiply_adds(std::int64_t rounds, double sum, double factor) {
  for (std::int64_t i = 0; i < rounds; ++i) sum = std::fma(sum, factor, 1e-3);
  return sum;
}
#endif
void fma_latency(benchmark::State& run) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("fma")) return run.SkipWithError("this processor has no fused multiply-adds");
#endif
  constexpr std::int64_t rounds = 10000;
  double sum = 0, factor = 0.999;
  benchmark::DoNotOptimize(factor);
  for (auto _ : run) sum = chain_of_multiply_adds(rounds, sum, factor);
  benchmark::DoNotOptimize(sum);
  run.counters["items"] = static_cast<double>(rounds);
}

// ---- expansions -------------------------------------------------------------------------------------------

/// A problem and its expansion, set up once: the large ones take seconds.
struct Prepared {
  Problem problem;
  Expansion<double> series;

  Prepared(const std::string& name, int degree, int threads)
      : problem(bench::problem(name)), series(problem.system, degree, kernels<double>(), Workers(threads)) {}
};
Prepared& prepared(const std::string& name, int degree, int threads) {
  static std::map<std::tuple<std::string, int, int>, std::unique_ptr<Prepared>> all;
  auto& known = all[{name, degree, threads}];
  if (!known) known = std::make_unique<Prepared>(name, degree, threads);
  return *known;
}

/// All coefficients of the motion.
void expand(benchmark::State& run, const std::string& name, int degree, int threads) {
  auto& [problem, series] = prepared(name, degree, threads);
  for (auto _ : run) {
    series.start(problem.start);
    series.grow_to(degree);
    benchmark::ClobberMemory();
  }
  run.counters["items"] = static_cast<double>(element_count(problem.system));
  run.counters["bytes"] =
      static_cast<double>(series.bytes()) / static_cast<double>(element_count(problem.system));
}

// ---- small systems ----------------------------------------------------------------------------------------

constexpr int degree_of_small_systems = 20;

/// One step of Taylor's method with the choice of its length, along the motion; begun anew before it drifts far.
void step(benchmark::State& run, const std::string& name) {
  const Problem problem = bench::problem(name);
  const auto integrator = taylor(problem.system, degree_of_small_systems, std::make_unique<JorbaZou>());
  State<double> state = problem.start;
  Report report;
  int steps = 0;
  for (auto _ : run) {
    state.time += integrator->step(state, 1e9, report);
    if (++steps % 1000 == 0) state = problem.start;
  }
  if (report.outcome != Outcome::success) run.SkipWithError(report.message.c_str());
  run.counters["items"] = 1;
}

/// From nothing to the end of the first step: laws are recorded, memory is laid out.
void start_up(benchmark::State& run) {
  for (auto _ : run) {
    const Problem problem = bench::problem("solar");
    const auto integrator = taylor(problem.system, degree_of_small_systems, std::make_unique<JorbaZou>());
    State<double> state = problem.start;
    Report report;
    integrator->step(state, 1e9, report);
    benchmark::DoNotOptimize(state.position.data());
  }
  run.counters["items"] = 1;
}

/// One step of a cloth of ten million springs, degree 16, each a thousandth of a second.
void huge_cloth(benchmark::State& run) {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (memory < 8e9) return run.SkipWithError("this machine has less than 8 GB");
  const Problem problem = bench::problem("cloth1300");
  const auto integrator = taylor(problem.system, 16, std::make_unique<FixedStep>(1e-3));
  State<double> state = problem.start;
  Report report;
  state.time += integrator->step(state, 1, report);  // room is made for it
  for (auto _ : run) state.time += integrator->step(state, 1, report);
  if (report.outcome != Outcome::success) run.SkipWithError(report.message.c_str());
  run.counters["items"] = 1;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  run.counters["bytes"] = 1024.0 * static_cast<double>(usage.ru_maxrss);  // of the whole program, at its most
}

// ---- dense output and events ------------------------------------------------------------------------------

/// A run of some 1e5 steps to `until`, and what is asked of it: nothing, when component 0 of the last particle is zero, three states
/// a step, or all of the motion.
void long_run(benchmark::State& run, const std::string& name, double until, const std::string& asked) {
  const Problem problem = bench::problem(name);
  const auto schedule = [&] {
    return Lockstep(taylor(problem.system, degree_of_small_systems, std::make_unique<JorbaZou>()));
  };
  State<double> state = problem.start;
  Lockstep first = schedule();
  first.run(state, until, {});
  const auto steps = static_cast<double>(first.work().steps);

  RunOptions options;
  std::vector<EventHit> hits;
  if (asked == "events") {
    const int last = problem.system.particles() - 1;
    options.events = {
        {.name = "zero", .g = [last](const auto&, const auto& x, const auto&) { return x(last, 0); }}};
    options.hits = &hits;
  }
  if (asked == "states") {
    for (int i = 1; i <= 3 * steps; ++i) options.observer.frame_times.push_back(until * i / (3 * steps));
    options.observer.at_frame = [](const State<double>& at) { benchmark::DoNotOptimize(at.position.data()); };
  }
  for (auto _ : run) {
    Lockstep lockstep = schedule();
    state = problem.start;
    hits.clear();
    Trajectory motion;
    if (asked == "record") {
      record(lockstep, state, until, motion, options);
      run.counters["bytes"] = static_cast<double>(motion.bytes()) / steps;
    } else {
      lockstep.run(state, until, options);
    }
  }
  if (state.time != until) run.SkipWithError("the run has ended early");
  run.counters["items"] = steps;
}

// ---- ensembles --------------------------------------------------------------------------------------------

/// The same system from states that differ by millionths, followed for `length` of its time in an iteration.
void ensemble(benchmark::State& run, const std::string& name, int members, int threads, double length) {
  const Problem problem = bench::problem(name);
  std::vector<State<double>> states(members, problem.start);
  for (int i = 0; i < members; ++i) states[i].position *= 1.0 + 1e-6 * i;
  Ensemble all(problem.system, degree_of_small_systems, states, std::numeric_limits<double>::infinity(),
               Workers(threads));
  double until = 0;
  for (auto _ : run) all.advance_to(until += length);
  run.counters["items"] = static_cast<double>(all.steps()) / static_cast<double>(run.iterations());
}

}  // namespace

void register_engine() {
  const auto name = [](const std::string& what) { return "engine/" + what; };
  benchmark::RegisterBenchmark(name("peak").c_str(), peak);
  for (const std::string cloth : {"cloth10", "cloth50", "cloth300"})
    benchmark::RegisterBenchmark(name(cloth).c_str(), expand, cloth, 16, 1)->UseRealTime();
  benchmark::RegisterBenchmark(name("cloth300/2_threads").c_str(), expand, "cloth300", 16, 2)->UseRealTime();
  for (const int degree : engine_degrees)
    benchmark::RegisterBenchmark(name("degree/" + std::to_string(degree)).c_str(), expand, "cloth10", degree,
                                 1);
  for (const int side : engine_sides)
    benchmark::RegisterBenchmark(name("size/" + std::to_string(side)).c_str(), expand,
                                 "cloth" + std::to_string(side), 8, 1);
  benchmark::RegisterBenchmark(name("fma_latency").c_str(), fma_latency);
  benchmark::RegisterBenchmark(name("kepler").c_str(), step, "kepler");
  for (const SmallSystem& system : small_systems) {
    const std::string of = system.name;
    const double length = of.starts_with("s") ? 2e4 : 20;
    benchmark::RegisterBenchmark(name(of).c_str(), step, of);
    for (const int members : {8, system.many})
      benchmark::RegisterBenchmark(name("ensemble/" + of + "/" + std::to_string(members)).c_str(), ensemble,
                                   of, members, 1, length);
  }
  for (const ManyBodies& of : many_bodies) benchmark::RegisterBenchmark(name(of.name).c_str(), step, of.name);
  benchmark::RegisterBenchmark(name("cloth1300").c_str(), huge_cloth)
      ->Iterations(1)
      ->Repetitions(1)
      ->UseRealTime();
  for (const LongRun& of : long_runs)
    for (const std::string asked : {"nothing", "events", "states", "record"})
      benchmark::RegisterBenchmark(name(std::string(of.name) + "/" + asked).c_str(), long_run, of.name,
                                   of.until, asked);
  benchmark::RegisterBenchmark(name("start_up").c_str(), start_up);
  benchmark::RegisterBenchmark(name("ensemble/kepler").c_str(), ensemble, "planar_kepler", 256, 1, 20.0);
  for (const int threads : {1, 2})
    benchmark::RegisterBenchmark(name("ensemble/solar1000/" + std::to_string(threads)).c_str(), ensemble,
                                 "solar", 1000, threads, 2e4)
        ->UseRealTime();
}

}  // namespace jetlag::bench
