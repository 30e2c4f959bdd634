// SPDX-License-Identifier: MIT
// What does a given error cost with our methods, and with maintained implementations of others? All run the same forces, by
// jetlag's code, from a system and a state to the end; the tape is recorded anew in each run.
//
//   BM_Peers/<problem>/<digits>/<method>   to an error of 10^-digits m at the end, in the largest component of a position,
//                                          against a series of degree 20; with the coarsest setting that is as accurate:
//                                          steps 2^(-1/2) apart, tolerances 10^(-1/2) apart. Counters: error, evaluations of
//                                          all forces, setting (step [s] or tolerance).

#include "peers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "../benchmarks.hpp"
#include "../reporter.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "odeint.hpp"
#include "problems/laws.hpp"
#include "sundials.hpp"

namespace jetlag::bench {

namespace {

constexpr const char* peer_problems[] = {"planet", "fput32", "cloth20", "chain128"};
constexpr int peer_digits[] = {3, 6, 9};
constexpr double longest = 0.6;  // [s]: a search goes no further after a run that took as long
constexpr double least_tolerance = 1e-16;

/// The end of a series of that degree, steps by Jorba and Zou, compensated sums.
State<double> end_of_series(const PeerProblem& problem, int degree) {
  RandomTaylor::Options options;
  options.compensated = true;
  Lockstep schedule(std::make_unique<RandomTaylor>(problem.system, fixed_degree(degree),
                                                   std::make_unique<JorbaZou>(), options));
  State<double> state = problem.start;
  const Report report = schedule.run(state, problem.until, {});
  if (report.outcome != Outcome::success)
    throw std::runtime_error(problem.name + ": no reference: " + report.message);
  return state;
}

double error_of(const Ending& ending, const State<double>& truth) {
  if (!ending.failure.empty()) return std::numeric_limits<double>::infinity();
  const double error = (ending.state.position - truth.position).cwiseAbs().maxCoeff();
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

const std::vector<Method>& methods() {
  static const std::vector<Method> all = [] {
    std::vector<Method> result = own_methods();
    for (auto&& peers : {odeint_methods(), sundials_methods()})
      result.insert(result.end(), peers.begin(), peers.end());
    return result;
  }();
  return all;
}

double setting(const PeerProblem& problem, const Method& method, int n) {
  return method.by_step ? problem.largest_step * method.coarsest * std::exp2(-0.5 * n)
                        : method.coarsest * std::pow(10.0, -0.5 * n);
}

struct Truth {
  State<double> end;
  double uncertainty;  // [m]: how far a series of degree 24 ends from it
};
const Truth& truth_of(const PeerProblem& problem) {
  static std::map<std::string, Truth> known;
  const auto found = known.find(problem.name);
  if (found != known.end()) return found->second;
  const State<double> end = end_of_series(problem, 20);
  const double uncertainty = error_of({end_of_series(problem, 24)}, end);
  return known.emplace(problem.name, Truth{end, uncertainty}).first->second;
}

struct Tried {
  double setting, seconds, error, evaluations;
};

/// The runs of one method on one problem, by the number of their setting, the coarsest being 0.
struct Search {
  std::map<int, Tried> tried;

  const Tried& at(const PeerProblem& problem, const Method& method, double target, int n) {
    if (const auto known = tried.find(n); known != tried.end()) return known->second;
    const double chosen = setting(problem, method, n), start = processor_seconds();
    const Ending ending = method.run(problem, {chosen, target, longest});
    const double seconds = processor_seconds() - start;
    return tried
        .emplace(n, Tried{chosen, seconds, error_of(ending, truth_of(problem).end), ending.evaluations})
        .first->second;
  }

  /// Steps are tried from the longest on. Tolerances are tried from a hundredth of the target on, and coarser ones as long
  /// as they do: with those that are far too coarse a planet falls into its sun, and such a run takes long.
  const Tried* coarsest_accurate(const PeerProblem& problem, const Method& method, double target) {
    int n = 0, unfinished = 0;
    if (!method.by_step)
      while (n < 60 && setting(problem, method, n) > method.first_of_target * target * 1.001) ++n;
    int first = n;
    for (;; ++n) {
      if (!method.by_step && setting(problem, method, n) < least_tolerance) return nullptr;
      const Tried& run = at(problem, method, target, n);
      if (run.error <= target) break;
      if (run.seconds > longest && (std::isfinite(run.error) || ++unfinished == 2)) return nullptr;
    }
    while (n == first && n > 0 && at(problem, method, target, n - 1).error <= target) first = --n;
    return &tried.at(n);
  }

  std::string why_none() const {
    const auto& [n, best] =
        *std::ranges::min_element(tried, {}, [](const auto& t) { return t.second.error; });
    std::ostringstream text;
    text.precision(2);
    text << gives_up << ": least error " << best.error << " m, in " << best.seconds << " s at "
         << best.setting;
    return text.str();
  }
};

/// Kept, since a benchmark is entered once for each repetition.
Search& search_of(const PeerProblem& problem, const Method& method, int digits) {
  static std::map<std::string, Search> all;
  return all[problem.name + '/' + method.name + '/' + (method.uses_target ? std::to_string(digits) : "")];
}

void peers(benchmark::State& run, const PeerProblem& problem, const Method& method, int digits) {
  const double target = std::pow(10.0, -digits);
  if (truth_of(problem).uncertainty > target / 30) {
    run.SkipWithError("the reference is not known well enough");
    return;
  }
  Search& search = search_of(problem, method, digits);
  const Tried* found = search.coarsest_accurate(problem, method, target);
  if (found == nullptr) {
    run.SkipWithError(search.why_none().c_str());
    return;
  }
  for (auto _ : run) {
    Ending ending = method.run(problem, {found->setting, target, std::numeric_limits<double>::infinity()});
    benchmark::DoNotOptimize(ending.state.position.data());
  }
  run.counters["error"] = found->error;
  run.counters["evaluations"] = found->evaluations;
  run.counters["setting"] = found->setting;
}

/// Eight masses between walls, one spring 100 times stiffer.
PeerProblem small_chain() {
  System<double> system(1, std::vector<double>(10, 1.0));
  system.fix(0);
  system.fix(9);
  std::vector<std::array<int, 2>> pairs;
  std::vector<std::array<double, 1>> stiffness;
  for (int j = 0; j < 9; ++j) {
    pairs.push_back({j, j + 1});
    stiffness.push_back({j == 4 ? 100.0 : 1.0});
  }
  system.add<problems::CubicSpring>(pairs, stiffness);
  State<double> start = problems::at_origin(system);
  for (int i = 1; i <= 8; ++i) start.position(i, 0) = 0.1 * std::sin(3 * std::numbers::pi * i / 9);
  PeerProblem problem{{std::move(system), std::move(start), 2.0}};
  problem.name = "small chain";
  problem.largest_step = 1e-4;
  problem.split = split_by_first_parameter(problem.system, [](double k) { return k > 10; });
  return problem;
}

}  // namespace

std::vector<PeerAgreement> peer_agreements() {
  constexpr double tolerance = 1e-9;  // of those with one
  const PeerProblem problem = small_chain();
  const State<double> truth = end_of_series(problem, 20);
  std::vector<PeerAgreement> all;
  for (auto&& some : {odeint_methods(), sundials_methods()})
    for (const Method& method : some) {
      const double setting = method.by_step ? problem.largest_step * method.coarsest : tolerance;
      const Ending ending = method.run(problem, {setting, 10 * tolerance, 10.0});
      all.push_back({method.name, error_of(ending, truth)});
    }
  return all;
}

void register_peers() {
  for (const char* name : peer_problems)
    for (const int digits : peer_digits)
      for (const Method& method : methods()) {
        const PeerProblem& problem = peer_problem(name);
        if (!method.fits(problem)) continue;
        const std::string title =
            "BM_Peers/" + problem.name + '/' + std::to_string(digits) + '/' + method.name;
        benchmark::RegisterBenchmark(
            title.c_str(),
            [&problem, &method, digits](benchmark::State& run) { peers(run, problem, method, digits); })
            ->Unit(benchmark::kMillisecond)
            ->Repetitions(3);
      }
}

void print_peers(const Reporter& reporter, std::ostream& out) {
  const auto name = [](const std::string& problem, int digits, const std::string& method) {
    return "BM_Peers/" + problem + '/' + std::to_string(digits) + '/' + method;
  };
  const auto milliseconds = [&](const std::string& problem, int digits, const std::string& method) {
    const auto time = reporter.nanoseconds(name(problem, digits, method));
    return time ? *time / 1e6 : std::numeric_limits<double>::infinity();
  };
  for (const std::string problem : peer_problems) {
    std::ostringstream rows;
    for (const Method& method : methods()) {
      std::ostringstream row;
      bool measured = false;
      for (const int digits : peer_digits) {
        const double time = milliseconds(problem, digits, method.name);
        row.precision(3);
        row << " | ";
        if (!std::isfinite(time)) {
          row << '-';
          continue;
        }
        measured = true;
        row << time << " (";
        row.precision(2);
        row << std::fixed
            << reporter.counter(name(problem, digits, method.name), "evaluations").value_or(0) / 1e3
            << std::defaultfloat << ')';
      }
      if (measured) rows << "| " << method.name << row.str() << " |\n";
    }
    if (rows.str().empty()) continue;
    out << "\n| " << problem << ": ms (1000 evaluations) for an error of";
    for (const int digits : peer_digits) out << " | 1e-" << digits;
    out << " |\n|---|---|---|---|\n" << rows.str();
  }
}

}  // namespace jetlag::bench
