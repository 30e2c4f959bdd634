// SPDX-License-Identifier: MIT
#include "reporter.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <ostream>

#include "agreement.hpp"
#include "engine.hpp"
#include "goal.hpp"
#include "jetlag/tape/kernels.hpp"
#include "peers/peers.hpp"

namespace jetlag::bench {

namespace {

std::string cpu_model() {
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

constexpr const char* compiler =
#if defined(__clang__)
    "clang " __clang_version__;
#elif defined(__GNUC__)
    "g++ " __VERSION__;
#else
    "unknown";
#endif

bool print_agreement(std::ostream& out) {
  out << "Agreement with the tape, all coefficients of all positions (allowed: " << Agreement::allowed
      << ")\n";
  bool all_hold = true;
  for (const Agreement& a : agreements()) {
    out << "  " << std::left << std::setw(18) << a.engine << std::setw(9) << a.problem << "degree "
        << a.degree << "   relative difference " << std::setprecision(2) << a.difference
        << (a.holds() ? "" : "   TOO LARGE") << "\n";
    all_hold = all_hold && a.holds();
  }
  const std::vector<PeerAgreement> peers = peer_agreements();
  if (!peers.empty())
    out << "Agreement of peers with a series of degree 20, positions of a small chain (allowed: "
        << PeerAgreement::allowed << " m)\n";
  for (const PeerAgreement& a : peers) {
    out << "  " << std::left << std::setw(28) << a.method << std::setprecision(2) << a.error << " m"
        << (a.holds() ? "" : "   TOO LARGE") << "\n";
    all_hold = all_hold && a.holds();
  }
  return all_hold;
}

/// CPU time of an iteration; of those with threads the time on the wall.
double time_of(const Reporter::Run& run) {
  return run.run_name.time_type == "real_time" ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime();
}

}  // namespace

bool Reporter::ReportContext(const Context& context) {
  std::ostream& out = GetOutputStream();
  out << "CPU: " << cpu_model() << "\n"
      << "Compiler: " << compiler << "\n"
      << "Instruction set of the tape: " << kernels<double>().instruction_set << "\n";
  disagreement_ = !print_agreement(out);
  if (disagreement_) {
    out << "The engines disagree: nothing is measured.\n";
    return false;
  }
  out << "Times: one thread, CPU time, the fastest repetition. Rows appear when all are done.\n"
      << std::flush;
  return ConsoleReporter::ReportContext(context);
}

void Reporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    failed_run_ = failed_run_ || (run.error_occurred && !run.error_message.starts_with(gives_up));
    const auto [known, is_new] = fastest_.try_emplace(run.family_index, run);
    if (!is_new && time_of(run) < time_of(known->second)) known->second = run;
  }
}

void Reporter::Finalize() {
  if (disagreement_) return;
  for (const auto& [index, run] : fastest_) ConsoleReporter::ReportRuns({run});
  print_ratios();
  print_engine(*this, GetOutputStream());
  print_peers(*this, GetOutputStream());
}

std::optional<double> Reporter::nanoseconds(const std::string& benchmark) const {
  for (const auto& [index, run] : fastest_)
    if (run.run_name.function_name == benchmark && !run.error_occurred)
      return time_of(run) * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit);
  return {};
}

std::optional<double> Reporter::counter(const std::string& benchmark, const std::string& name) const {
  for (const auto& [index, run] : fastest_)
    if (run.run_name.function_name == benchmark && run.counters.contains(name)) return run.counters.at(name);
  return {};
}

std::optional<double> Reporter::nanoseconds_of_an_item(const std::string& benchmark) const {
  const auto time = nanoseconds(benchmark), items = counter(benchmark, "items");
  if (!time || !items) return {};
  return *time / *items;
}

std::optional<double> Reporter::ratio(const std::string& numerator, const std::string& denominator) const {
  const auto a = nanoseconds(numerator), b = nanoseconds(denominator);
  if (!a || !b) return {};
  return *a / *b;
}

std::optional<double> Reporter::exponent(const std::string& stem, const std::vector<int>& degrees) const {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const int degree : degrees) {
    const auto time = nanoseconds(stem + std::to_string(degree));
    if (!time) return {};
    const double log_degree = std::log(degree), log_time = std::log(*time);
    x += log_degree;
    y += log_time;
    xx += log_degree * log_degree;
    xy += log_degree * log_time;
  }
  const auto n = static_cast<double>(degrees.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

void Reporter::print_ratios() {
  using enum Goal::Kind;
  const std::string tape = "BM_Expansion/cloth10/", check = "BM_Check/cloth10/", taut = "BM_Check/taut/";
  struct Line {
    const char* what;
    std::optional<double> value;
    Goal goal;
  };
  const auto from_energy = [&](const std::string& law) {
    return ratio("BM_FromEnergy/" + law + "/from_energy", "BM_FromEnergy/" + law + "/by_hand");
  };
  const std::vector<Line> lines{
      {"ADOL-C / tape, degree 16", ratio("BM_ExpansionAdolC/cloth10/16", tape + "16"), {at_least, 15}},
      {"jets restarted / tape, degree 32", ratio("BM_Restart/cloth10/32", tape + "32"), {at_least, 4}},
      {"tape restarted / tape, degree 32", ratio("BM_RestartTape/cloth10/32", tape + "32"), {at_least, 4}},
      {"tape, degree 32 / degree 16", ratio(tape + "32", tape + "16"), {at_most, 4.5}},
      {"exponent b of cost = a N^b, N = 8 .. 64", exponent(tape, {8, 16, 32, 64}), {at_most, 2}},
      {"step: geometric:2,8,0.5 / fixed:3",
       ratio("BM_Step/geometric:2,8,0.5/cloth10", "BM_Step/fixed:3/cloth10"),
       {none}},
      {"forces at the end looked at, degree 2", ratio(check + "2/forces", check + "2/none"), {none}},
      {"forces at the end looked at, degree 8", ratio(check + "8/forces", check + "8/none"), {at_most, 1.03}},
      {"forces at the end looked at, degree 16",
       ratio(check + "16/forces", check + "16/none"),
       {at_most, 1.03}},
      {"choices watched, degree 8", ratio(taut + "8/choices", taut + "8/none"), {at_most, 1.1}},
      {"choices watched, degree 16", ratio(taut + "16/choices", taut + "16/none"), {at_most, 1.1}},
      {"step: leapfrog / fixed:2", ratio("BM_Step/leapfrog/cloth10", "BM_Step/fixed:2/cloth10"), {none}},
      {"from energy / by hand: spring", from_energy("spring"), {at_most, 1.05}},
      {"gravity", from_energy("gravity"), {at_most, 1.05}},
      {"softened gravity", from_energy("softened_gravity"), {at_most, 1.05}},
      {"floor", from_energy("floor"), {at_most, 1.05}},
      {"quadratic floor", from_energy("quadratic_floor"), {at_most, 1.05}},
      {"angle", from_energy("angle"), {at_most, 1.05}},
      {"tetrahedron", from_energy("tetrahedron"), {at_most, 1.05}},
  };
  if (std::ranges::none_of(lines, [](const Line& line) { return line.value.has_value(); })) return;
  std::ostream& out = GetOutputStream();
  out << "\nRatios of this run, cloth10 where nothing else is said (" << kernels<double>().instruction_set
      << ")\n";
  for (const Line& line : lines) {
    out << "  " << std::left << std::setw(42) << line.what << std::right;
    if (line.value)
      out << std::fixed << std::setprecision(2) << std::setw(9) << *line.value << "   " << std::left
          << std::setw(8) << line.goal.text() << line.goal.verdict(*line.value);
    else
      out << std::setw(9) << "not run" << "   " << line.goal.text();
    out << "\n" << std::defaultfloat;
  }
#if !defined(JETLAG_HAVE_ADOLC)
  out << "  (built without ADOL-C: install libadolc-dev and configure anew)\n";
#endif
  out << std::flush;
}

}  // namespace jetlag::bench
