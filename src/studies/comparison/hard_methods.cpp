// SPDX-License-Identifier: MIT
// The methods, their runs, and the table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "jetlag/base/stopwatch.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/result_folder.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/methods/methods.hpp"
#include "studies/comparison/hard_cases.hpp"
#include "studies/studies.hpp"

namespace jetlag {

using problems::Problem;

namespace {

using Json = nlohmann::ordered_json;

HardMethod stepped(std::string name, Json integrator) {
  return {std::move(name), std::move(integrator), {{"type", "fixed"}}, {}, true, {}};
}
HardMethod chosen_steps(std::string name, Json integrator, Json control, Json schedule = {}) {
  return {std::move(name), std::move(integrator), std::move(control), std::move(schedule), false, {}};
}

HardMethod partitioned(std::string name, Json integrator, std::string list) {
  HardMethod method = stepped(std::move(name), std::move(integrator));
  method.part = std::move(list);
  return method;
}

std::vector<int> part_of(const Problem& hard, bool stiff) {
  if (const auto& named = stiff ? hard.stiff : hard.slow; !named.empty()) return named;
  std::vector<int> moving;
  for (int i = 0; i < hard.system.particles(); ++i)
    if (!hard.system.fixed()[i]) moving.push_back(i);
  return {stiff ? moving.back() : moving.front()};
}

/// The size of the motion: the largest distance of a particle from where it began, or from the origin at the end.
double extent(const Problem& hard) {
  const double moved = (*hard.end - hard.start.position).rowwise().norm().maxCoeff();
  return std::max(moved, hard.end->rowwise().norm().maxCoeff());
}

double elements_of(const System<double>& system) {
  return static_cast<double>(problems::element_count(system));
}

/// The step of the control at which a run spends so many evaluations, from the first 50th of it at a guess.
template <class Read>
double step_for(const Problem& hard, const Read& read, double evaluations) {
  constexpr double probe = 1e-3;
  const Method guess = read(probe);
  const double per_step =
      guess.fixed_step ? *guess.fixed_step / probe : 1.0;  // steps of the control in a step
  const auto control_step = [&](double each) {
    return hard.until / std::max(1.0, std::floor(evaluations / each)) / per_step;
  };
  const auto schedule = read(control_step(guess.mean_orders)).schedule();
  State<double> state = hard.start;
  schedule->run(state, hard.until / 50, {});
  const Work& work = schedule->work();
  const double spent = static_cast<double>(work.element_coefficients) / elements_of(hard.system);
  return control_step(work.steps > 0 && spent > 0 ? spent / static_cast<double>(work.steps)
                                                  : guess.mean_orders);
}

}  // namespace

/// Methods whose settings are chosen for these cases; every other one of the register follows as its record shows it.
std::vector<HardMethod> hard_methods() {
  const Json leapfrog = {{"type", "leapfrog"}}, rk4 = {{"type", "rk4"}};
  std::vector<HardMethod> methods = {
      chosen_steps("taylor 20, jorba_zou", {{"type", "taylor"}, {"degree", 20}}, {{"type", "jorba_zou"}}),
      chosen_steps("the same, compensated", {{"type", "taylor"}, {"degree", 20}, {"compensated", true}},
                   {{"type", "jorba_zou"}}),
      stepped("taylor 8", {{"type", "taylor"}, {"degree", 8}}),
      stepped("random_taylor, m = 7, ruler 2", {{"type", "random_taylor"},
                                                {"min_degree", 7},
                                                {"max_degree", 16},
                                                {"probability", 0.5},
                                                {"draws", "ruler"}}),
      chosen_steps(
          "random_taylor, m = 6, variance",
          {{"type", "random_taylor"}, {"min_degree", 6}, {"max_degree", 16}, {"probability", 0.5}},
          {{"type", "variance"}, {"step", 1e-4}, {"tolerance_random", 1e-9}, {"tolerance_bias", 1e-9}}),
      chosen_steps("taylor 12, block", {{"type", "taylor"}, {"degree", 12}},
                   {{"type", "last_two"}, {"tolerance", 1e-11}}, {{"type", "block"}}),
      chosen_steps("taylor 8, asynchronous", {{"type", "taylor"}, {"degree", 8}},
                   {{"type", "last_two"}, {"tolerance", 1e-11}}, {{"type", "asynchronous"}}),
      stepped("avi", {{"type", "avi"}}),
      chosen_steps("dopri5, 1e-10", {{"type", "dopri5"}}, {{"type", "embedded"}, {"tolerance", 1e-10}}),
      chosen_steps("dop853, 1e-12", {{"type", "dop853"}}, {{"type", "embedded"}, {"tolerance", 1e-12}}),
      chosen_steps("gauss_radau", {{"type", "gauss_radau"}}, {{"type", "embedded"}}),
      chosen_steps("hermite, aarseth", {{"type", "hermite"}}, {{"type", "aarseth"}, {"accuracy", 1e-4}}),
      partitioned("explicit_implicit", {{"type", "explicit_implicit"}}, "implicit"),
      partitioned("subcycling, ratio 2", {{"type", "subcycling"}, {"ratio", 2}}, "coarse"),
      partitioned("subcycling, ratio 2, avoided",
                  {{"type", "subcycling"}, {"ratio", 2}, {"resonance", "avoided"}}, "coarse"),
      partitioned("implicit_subcycling, ratio 4", {{"type", "implicit_subcycling"}, {"ratio", 4}}, "coarse"),
      chosen_steps("qss1, 1e-3", {{"type", "qss1"}}, {{"type", "quantum"}, {"quantum", 1e-3}}),
      chosen_steps("qss2, 1e-5", {{"type", "qss2"}}, {{"type", "quantum"}, {"quantum", 1e-5}}),
      chosen_steps("qss3, 1e-7", {{"type", "qss3"}}, {{"type", "quantum"}, {"quantum", 1e-7}}),
      stepped("conrad, rk4", {{"type", "conrad"}, {"inner", rk4}, {"order", 4}, {"sigma", 1.0}}),
      stepped("random_step, leapfrog", {{"type", "random_step"}, {"inner", leapfrog}, {"order", 2}}),
  };
  for (const MethodRecord& record : method_records()) {
    const bool listed = std::ranges::any_of(
        methods, [&](const HardMethod& method) { return method.integrator.at("type") == record.name; });
    if (record.stepper != nullptr && !listed)
      methods.push_back(stepped(record.name, Json::parse(record.examples.front()).at("integrator")));
  }
  return methods;
}

HardResult run_hard_case(const Problem& hard, const HardMethod& method, double evaluations, double limit) {
  using Verdict = HardResult::Verdict;
  Json json = {{"integrator", method.integrator}, {"control", method.control}};
  if (!method.schedule.is_null()) json["schedule"] = method.schedule;
  if (!method.part.empty()) json["integrator"][method.part] = part_of(hard, method.part == "implicit");
  const auto system = std::make_shared<const System<double>>(hard.system);
  const auto read = [&](double step) {
    Json copy = json;
    if (method.has_step) copy["control"]["step"] = step;
    const Value scene(copy, "");
    scene.only({"integrator", "control", "schedule"});
    return read_method(scene, system, hard.start, 1);
  };
  HardResult result;
  result.verdict = Verdict::refused;
  result.error = result.energy_error = std::numeric_limits<double>::quiet_NaN();
  State<double> state = hard.start;
  const double start = processor_seconds();
  try {
    const auto schedule = read(method.has_step ? step_for(hard, read, evaluations) : 0.0).schedule();
    RunOptions options;
    int calls = 0;
    options.observer.after_step = [&](const StepView&) {
      return ++calls % 64 != 0 || processor_seconds() - start < limit;
    };
    const Report report = schedule->run(state, hard.until, options);
    result.seconds = processor_seconds() - start;
    result.evaluations =
        static_cast<double>(schedule->work().element_coefficients) / elements_of(hard.system);
    result.message = report.message;
    if (report.outcome != Outcome::success) {
      result.verdict = report.outcome == Outcome::interrupted ? Verdict::slow : Verdict::failed;
      return result;
    }
  } catch (const SceneError& error) {
    result.message = error.what();
    return result;
  }
  result.error = (state.position - *hard.end).rowwise().norm().maxCoeff() / extent(hard);
  result.verdict = result.error <= 0.1 ? Verdict::accurate : Verdict::wrong;
  EnergyMeter meter(hard.system);
  if (problems::conserves_energy(hard.system)) {
    const Energy before = meter(hard.start);
    const double size = std::max(std::abs(before.kinetic), std::abs(before.potential));
    result.energy_error = std::abs(meter(state).total() - before.total()) / size;
  }
  return result;
}

namespace hard_cases {  // batches compile studies together
namespace {

struct Arguments {
  std::vector<std::string> cases, methods;
  double evaluations = 2e5, limit = 20;
  std::filesystem::path folder = "out/hard_cases";
};

const char* word(HardResult::Verdict verdict) {
  constexpr const char* words[] = {"accurate", "wrong", "failed", "too slow", "refused"};
  return words[static_cast<int>(verdict)];
}

std::string shown(double value) { return std::isfinite(value) ? fmt::format("{:.1e}", value) : "-"; }

/// The first clause of a message.
std::string brief(const std::string& message) {
  constexpr std::size_t most = 90;
  return message.size() <= most ? message : message.substr(0, most) + "..";
}

/// "H4", or with the last word of the name where there are several of that number: "H1 0.99".
std::string label(const Problem& hard, const std::vector<Problem>& cases) {
  const auto number_of = [](const Problem& one) { return one.name.substr(0, one.name.find(' ')); };
  const std::string number = number_of(hard);
  if (std::ranges::count(cases, number, number_of) < 2) return number;
  return number + hard.name.substr(hard.name.rfind(' '));
}

/// One row a method, one column a case: the error, or what happened.
std::string summary(const std::vector<Problem>& cases, const std::vector<HardMethod>& methods,
                    const std::vector<std::vector<HardResult>>& results) {
  std::string text = "| method |";
  for (const Problem& hard : cases) text += ' ' + label(hard, cases) + " |";
  text += "\n|---|";
  for (std::size_t c = 0; c < cases.size(); ++c) text += "---|";
  text += "\n";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    text += "| " + methods[m].name + " |";
    for (std::size_t c = 0; c < cases.size(); ++c) {
      const HardResult& r = results[c][m];
      text += r.verdict == HardResult::Verdict::accurate ? fmt::format(" {:.0e} |", r.error)
                                                         : fmt::format(" {} |", word(r.verdict));
    }
    text += "\n";
  }
  text += "\n";
  for (const Problem& hard : cases)
    text += fmt::format("- {}: {}; until {:.6g} s\n", hard.name, hard.description, hard.until);
  return text;
}

template <class Named>
std::vector<Named> named(std::vector<Named> all, const std::vector<std::string>& names) {
  if (!names.empty())
    std::erase_if(all, [&](const Named& one) {
      return std::ranges::none_of(names, [&](const std::string& name) { return one.name.starts_with(name); });
    });
  return all;
}

int run_study(const Arguments& arguments) {
  const auto cases = named(problems::hard_cases(), arguments.cases);
  const auto methods = named(hard_methods(), arguments.methods);
  if (cases.empty() || methods.empty()) {
    fmt::print(stderr, "no {} begins with such a name\n", cases.empty() ? "case" : "method");
    return bad_input;
  }
  std::vector<std::vector<HardResult>> results;
  std::string csv = "case,method,verdict,error,energy_error,evaluations,seconds,message\n";
  for (const Problem& hard : cases) {
    fmt::print("\n{}: {}; until {:.6g} s\n\n", hard.name, hard.description, hard.until);
    fmt::print("{:<32} {:<9} {:>9} {:>9} {:>12} {:>9}\n", "method", "", "error", "energy", "evaluations",
               "CPU [s]");
    auto& of_case = results.emplace_back();
    for (const HardMethod& method : methods) {
      const HardResult& r =
          of_case.emplace_back(run_hard_case(hard, method, arguments.evaluations, arguments.limit));
      fmt::print("{:<32} {:<9} {:>9} {:>9} {:>12.4g} {:>9.2g}  {}\n", method.name, word(r.verdict),
                 shown(r.error), shown(r.energy_error), r.evaluations, r.seconds, brief(r.message));
      std::fflush(stdout);
      std::string message = r.message;
      std::ranges::replace(message, '"', '\'');
      csv += fmt::format("\"{}\",\"{}\",{},{},{},{},{},\"{}\"\n", hard.name, method.name, word(r.verdict),
                         std::isfinite(r.error) ? number(r.error) : "",
                         std::isfinite(r.energy_error) ? number(r.energy_error) : "", number(r.evaluations),
                         number(r.seconds), message);
    }
  }
  const std::string table = summary(cases, methods, results);
  fmt::print("\nerror of the positions, in extents of the motion\n\n{}", table);
  const ResultFolder held(arguments.folder);
  write_file(arguments.folder / "hard_cases.csv", csv);
  write_file(arguments.folder / "hard_cases.md", table);
  fmt::print("\n{}\n{}\n", (arguments.folder / "hard_cases.csv").string(),
             (arguments.folder / "hard_cases.md").string());
  return 0;
}

}  // namespace
}  // namespace hard_cases

Command hard_cases_study() {
  using namespace hard_cases;
  return command<Arguments>(
      "hard_cases", "every method on motions that break methods", run_study,
      [](Arguments& a) -> std::vector<Option> {
        return {{"--case", &a.cases, "only cases whose names begin so, as H5"},
                {"--method", &a.methods, "only methods whose names begin so"},
                {"--evaluations", &a.evaluations,
                 "force evaluations that a method with a fixed step may spend on a case", Between{1, 1e9}},
                {"--limit", &a.limit, "processor time after which a run is stopped [s]", Positive{}},
                {"--out", &a.folder, "folder for the tables"}};
      });
}

}  // namespace jetlag
