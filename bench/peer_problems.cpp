// SPDX-License-Identifier: MIT
// The problems on which peers run, and what all adaptors share.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "jetlag/control/courant.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/scenes/scene.hpp"
#include "peers.hpp"
#include "scenes.hpp"

namespace jetlag::bench {

namespace {

/// A planet, e = 0.3, begins where it is fastest; 100 periods.
Problem planet() {
  System<double> system(2, {1.0, 1.0});
  system.fix(0);
  system.add<Gravity>({{0, 1}}, {{1.0}});
  State<double> begin{0.0, Coordinates<double>::Zero(2, 2), Coordinates<double>::Zero(2, 2)};
  const double e = 0.3, period = 2 * std::numbers::pi;
  begin.position(1, 0) = 1 - e;
  begin.velocity(1, 1) = std::sqrt((1 + e) / (1 - e));
  return {"planet", std::move(system), std::move(begin), 100 * period, period / 14.7964875};
}

/// 32 masses between walls, springs d + d^3.         Source: the beta chain of Fermi, Pasta, Ulam, Tsingou 1955.
Problem fput32() {
  System<double> system(1, std::vector<double>(34, 1.0));
  system.fix(0);
  system.fix(33);
  std::vector<std::array<int, 2>> pairs;
  for (int j = 0; j < 33; ++j) pairs.push_back({j, j + 1});
  system.add<CubicSpring>(pairs, {{1.0}});
  State<double> begin{0.0, Coordinates<double>::Zero(34, 1), Coordinates<double>::Zero(34, 1)};
  for (int i = 1; i <= 32; ++i)
    begin.position(i, 0) =
        0.1 * std::sin(2 * std::numbers::pi * i / 33) + 0.02 * std::sin(9 * std::numbers::pi * i / 33);
  return {"fput32", std::move(system), std::move(begin), 496, 1.24};
}

/// The scene `cloth` without friction, so that every method fits.
Problem cloth20() {
  const jetlag::Scene scene =
      load_scene("cloth", {"until=0.5", R"(forces=[{"type": "spring", "pairs": "edges", "stiffness": 100.0},
                                        {"type": "uniform_field", "acceleration": [0.0, -2.0, -9.8]}])"});
  return {"cloth20", *scene.system, scene.initial, scene.until, 2 / frequency_bound(*scene.system)};
}

Problem chain128() {
  Uneven scene = chain();
  const double step =
      0.01;  // [s]: the limit of leapfrog for a long chain of its stiffest springs, 2 / (2 sqrt(1e4))
  const auto stiff = [](double stiffness) { return stiffness > 100.0; };
  Split split = split_by_first_parameter(scene.system, stiff);
  return {"chain128", std::move(scene.system), std::move(scene.state), scene.until, step, std::move(split)};
}

}  // namespace

Split split_by_first_parameter(const System<double>& system, const std::function<bool(double)>& fast) {
  System<double> nothing(system.dimension(), system.mass());
  for (int i = 0; i < system.particles(); ++i)
    if (system.fixed()[i]) nothing.fix(i);
  Split split{nothing, nothing};
  for (const auto& all : system.elements()) {
    const std::size_t members = all.law.participants, width = all.law.parameters.size();
    std::array<std::vector<int>, 2> particles;
    std::array<std::vector<double>, 2> parameters;
    for (std::size_t e = 0; e < all.count(); ++e) {
      const auto part = fast(all.parameters[e * width]) ? 0 : 1;
      const auto first = all.particles.begin() + static_cast<std::ptrdiff_t>(e * members);
      const auto set = all.parameters.begin() + static_cast<std::ptrdiff_t>(e * width);
      particles[part].insert(particles[part].end(), first, first + static_cast<std::ptrdiff_t>(members));
      parameters[part].insert(parameters[part].end(), set, set + static_cast<std::ptrdiff_t>(width));
    }
    if (!particles[0].empty()) split.fast.add(all.law, particles[0], parameters[0]);
    if (!particles[1].empty()) split.slow.add(all.law, particles[1], parameters[1]);
  }
  return split;
}

const Problem& problem(const std::string& name) {
  static std::map<std::string, Problem> made;
  if (const auto known = made.find(name); known != made.end()) return known->second;
  struct Entry {
    const char* name;
    Problem (*make)();
  };
  for (const Entry& entry :
       {Entry{"planet", planet}, {"fput32", fput32}, {"cloth20", cloth20}, {"chain128", chain128}})
    if (name == entry.name) return made.emplace(name, entry.make()).first->second;
  throw std::invalid_argument("problem: got '" + name + "'; must be planet, fput32, cloth20 or chain128");
}

bool any_problem(const Problem&) { return true; }
bool by_position(const Problem& problem) {
  return !forces_read(problem.system, Input::Kind::velocity) &&
         !forces_read(problem.system, Input::Kind::time);
}
bool has_split(const Problem& problem) { return problem.split.has_value(); }

Forces::Forces(const System<double>& system, double seconds)
    : unknowns_(static_cast<std::size_t>(system.particles() * system.dimension())),
      accelerations_(system),
      state_{0.0, Coordinates<double>(system.particles(), system.dimension()),
             Coordinates<double>(system.particles(), system.dimension())},
      deadline_(processor_seconds() + seconds) {}

bool Forces::operator()(double t, const double* x, const double* v, double* a) {
  constexpr std::uint32_t calls_between_looks = 1024;
  if (++calls_ % calls_between_looks == 0 && processor_seconds() > deadline_) {
    out_of_time_ = true;
    report_.message = "the time is used up";
    return false;
  }
  state_.time = t;
  std::copy_n(x, unknowns_, state_.position.data());
  std::copy_n(v, unknowns_, state_.velocity.data());
  if (!accelerations_(state_, a_, report_)) return false;
  std::copy_n(a_.data(), unknowns_, a);
  return true;
}

std::vector<double> flat(const State<double>& state) {
  std::vector<double> y(state.position.data(), state.position.data() + state.position.size());
  y.insert(y.end(), state.velocity.data(), state.velocity.data() + state.velocity.size());
  return y;
}

State<double> state_of(const double* y, const Problem& problem) {
  State<double> state = problem.begin;
  const auto n = state.position.size();
  state.time = problem.until;
  std::copy_n(y, n, state.position.data());
  std::copy_n(y + n, n, state.velocity.data());
  return state;
}

double elements(const System<double>& system) {
  std::size_t count = 0;
  for (const auto& each : system.elements()) count += each.count();
  return static_cast<double>(count);
}

EqualSteps::EqualSteps(double until, double h)
    : count(std::max(1L, static_cast<long>(std::ceil(until / h * (1 - 1e-12))))),
      step(until / static_cast<double>(count)) {}

}  // namespace jetlag::bench
