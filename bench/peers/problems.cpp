// SPDX-License-Identifier: MIT
// The problems on which peers run, and what all adaptors share.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "jetlag/control/courant.hpp"
#include "jetlag/scenes/scene.hpp"
#include "peers.hpp"
#include "problems/chains.hpp"
#include "problems/planets.hpp"

namespace jetlag::bench {

namespace {

PeerProblem named(std::string name, problems::Problem problem) {
  problem.name = std::move(name);
  return {std::move(problem)};
}

/// From where it is fastest; 100 periods.
PeerProblem planet() {
  PeerProblem problem = named("planet", problems::planet(0.3));
  problem.until = 100 * 2 * std::numbers::pi;
  return problem;
}

PeerProblem fput32() { return named("fput32", problems::fput()); }

/// The scene `cloth` without friction, so that every method fits.
PeerProblem cloth20() {
  const Scene scene =
      load_scene("cloth", {"until=0.5", R"(forces=[{"type": "spring", "pairs": "edges", "stiffness": 100.0},
                                        {"type": "uniform_field", "acceleration": [0.0, -2.0, -9.8]}])"});
  PeerProblem problem = named("cloth20", {*scene.system, scene.initial, scene.until});
  problem.largest_step = 2 / frequency_bound(problem.system);
  return problem;
}

/// The first step is the limit of leapfrog for a long chain of its stiffest springs, 2 / (2 sqrt(1e4)).
PeerProblem chain128() {
  PeerProblem problem = named("chain128", problems::stiff_spot_in_a_chain(128, 1e4));
  problem.until = 20;
  problem.largest_step = 0.01;
  problem.split = split_by_first_parameter(problem.system, [](double k) { return k > 100.0; });
  return problem;
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

const PeerProblem& peer_problem(const std::string& name) {
  static std::map<std::string, PeerProblem> made;
  if (const auto known = made.find(name); known != made.end()) return known->second;
  struct Entry {
    const char* name;
    PeerProblem (*make)();
  };
  for (const Entry& entry :
       {Entry{"planet", planet}, {"fput32", fput32}, {"cloth20", cloth20}, {"chain128", chain128}})
    if (name == entry.name) return made.emplace(name, entry.make()).first->second;
  throw std::invalid_argument("problem: got '" + name + "'; must be planet, fput32, cloth20 or chain128");
}

bool any_problem(const PeerProblem&) { return true; }
bool by_position(const PeerProblem& problem) {
  return !forces_read(problem.system, Input::Kind::velocity) &&
         !forces_read(problem.system, Input::Kind::time);
}
bool has_split(const PeerProblem& problem) { return problem.split.has_value(); }

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

State<double> state_of(const double* y, const PeerProblem& problem) {
  State<double> state = problem.start;
  const auto n = state.position.size();
  state.time = problem.until;
  std::copy_n(y, n, state.position.data());
  std::copy_n(y + n, n, state.velocity.data());
  return state;
}

EqualSteps::EqualSteps(double until, double h)
    : count(std::max(1L, static_cast<long>(std::ceil(until / h * (1 - 1e-12))))),
      step(until / static_cast<double>(count)) {}

}  // namespace jetlag::bench
