// SPDX-License-Identifier: MIT
#include <cmath>
#include <iomanip>
#include <ostream>
#include <span>
#include <vector>

#include "engine.hpp"
#include "goal.hpp"
#include "reporter.hpp"

namespace jetlag::bench {

namespace {

/// b in  y = a x^b,  fitted by least squares of the logarithms.
std::optional<double> exponent(const std::vector<std::pair<double, std::optional<double>>>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [at, value] : points) {
    if (!value) return {};
    const double log_x = std::log(at), log_y = std::log(*value);
    x += log_x;
    y += log_y;
    xx += log_x * log_x;
    xy += log_x * log_y;
  }
  const auto n = static_cast<double>(points.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

std::optional<double> divided(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return {};
  return *a / *b;
}
std::optional<double> times(double factor, std::optional<double> a) {
  if (!a) return {};
  return factor * *a;
}

}  // namespace

void print_engine(const Reporter& reporter, std::ostream& out) {
  const auto item = [&](const std::string& name) {
    return reporter.nanoseconds_of_an_item("engine/" + name);
  };
  const auto counter = [&](const std::string& name, const std::string& counter) {
    return reporter.counter("engine/" + name, counter);
  };
  if (!item("cloth10")) return;

  std::vector<std::pair<double, std::optional<double>>> by_degree, by_size;
  for (const int degree : engine_degrees) {
    const std::string name = "degree/" + std::to_string(degree);
    by_degree.emplace_back(degree, item(name));
  }
  for (const int side : engine_sides) {
    const std::string name = "size/" + std::to_string(side);
    const auto springs = counter(name, "items"), time = item(name);
    by_size.emplace_back(springs.value_or(1),
                         springs && time ? std::optional(*springs * *time) : std::nullopt);
  }
  const auto multiply_adds = divided(1.0, item("peak"));  // in a nanosecond
  constexpr double useful = 3 * 16 * 16;                  // multiply-adds of a spring, degree 16

  using enum Goal::Kind;
  struct Line {
    std::string what;
    std::optional<double> value;
    Goal goal;
  };
  std::vector<Line> lines{
      {"peak, fused multiply-adds in a nanosecond", multiply_adds, {none}},
      {"cloth 10x10, degree 16 [ns a spring]", item("cloth10"), {none}},
      {"  fraction of the peak, 3 N^2 multiply-adds a spring",
       divided(times(useful, divided(1.0, item("cloth10"))), multiply_adds),
       {at_least, 0.25}},
      {"  ADOL-C forode / jetlag", divided(item("adolc/cloth10"), item("cloth10")), {at_least, 60}},
      {"cloth 50x50, degree 16 [ns a spring]", item("cloth50"), {none}},
      {"  ADOL-C forode / jetlag", divided(item("adolc/cloth50"), item("cloth50")), {at_least, 40}},
      {"cloth 300x300, degree 16 [ns a spring]", item("cloth300"), {none}},
      {"  300x300 / 50x50", divided(item("cloth300"), item("cloth50")), {at_most, 1.15}},
      {"  bytes a spring", counter("cloth300", "bytes"), {at_most, 250}},
      {"  1 thread / 2 threads", divided(item("cloth300"), item("cloth300/2_threads")), {at_least, 1.7}},
      {"cloth of 1e7 springs, degree 16 [s a step]", times(1e-9, item("cloth1300")), {none}},
      {"  the program's memory at its most [GB]", times(1e-9, counter("cloth1300", "bytes")), {at_most, 8.6}},
      {"cost ~ N^b in the degree, N = 8 .. 64: b", exponent(by_degree), {at_most, 2.0}},
      {"cost ~ S^b in the springs, 1e3 .. 1e6: b", exponent(by_size), {at_most, 1.03}},
      {"outer Solar System: first step from nothing [ms]", times(1e-6, item("start_up")), {at_most, 10}},
      {"1000 of them in lanes, 1 thread / 2 threads",
       divided(item("ensemble/solar1000/1"), item("ensemble/solar1000/2")),
       {at_least, 1.9}},
      {"two bodies in space, degree 20 [ns a step]", item("kepler"), {none}},
      {"  256 planar ones in lanes [ns a step of each]", item("ensemble/kepler"), {at_most, 150}},
      {"a dependent multiply-add [ns]", item("fma_latency"), {none}},
  };
  const auto in_multiply_adds = [&](const std::string& what, const std::string& name, double goal) {
    lines.push_back({what, divided(item(name), item("fma_latency")), {at_most, goal}});
  };
  lines.push_back({"in dependent multiply-adds, degree 20, a step of", std::nullopt, {none}});
  for (const SmallSystem& system : small_systems)
    in_multiply_adds(std::string("  ") + system.title, system.name, system.step);
  for (const ManyBodies& bodies : many_bodies)
    in_multiply_adds(std::string("  ") + bodies.title, bodies.name, bodies.step);
  lines.push_back(
      {"the same a member of an ensemble in lanes, of 8 or as many as is said", std::nullopt, {none}});
  for (const SmallSystem& system : small_systems) {
    const std::string name = std::string("ensemble/") + system.name + "/", many = std::to_string(system.many);
    in_multiply_adds(std::string("  ") + system.title, name + "8", system.of_eight);
    in_multiply_adds("    of " + many, name + many, system.of_many);
  }
  lines.push_back({"runs over those of which nothing is asked, degree 20", std::nullopt, {none}});
  for (const LongRun& run : long_runs) {
    const auto ratio = [&](const std::string& asked) {
      return divided(item(std::string(run.name) + "/" + asked), item(std::string(run.name) + "/nothing"));
    };
    lines.push_back(
        {std::string("  ") + run.title + ", events on a coordinate", ratio("events"), {at_most, 1.3}});
    lines.push_back({"    three states a step", ratio("states"), {at_most, 1.3}});
    lines.push_back({"    recorded whole", ratio("record"), {at_most, 1.5}});
  }
  lines.push_back(
      {"bytes a step of the recorded pendulum", counter("pendulum/record", "bytes"), {at_most, 400}});
  out << "\nThe engine\n";
  for (const Line& line : lines) {
    out << "  " << std::left << std::setw(54) << line.what << std::right;
    if (line.value)
      out << std::setprecision(3) << std::setw(9) << *line.value << "   " << std::left << std::setw(11)
          << line.goal.text() << line.goal.verdict(*line.value);
    else if (line.goal.kind != none)  // otherwise a heading
      out << std::setw(9) << "not run" << "   " << line.goal.text();
    out << "\n";
  }
  out << std::flush;
}

}  // namespace jetlag::bench
