// SPDX-License-Identifier: MIT
// What does it cost to look at the forces at the end of each step, and to watch the choices that forces make?

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks.hpp"
#include "jetlag/motion/expansion.hpp"

namespace jetlag::bench {

namespace {

/// A spring that lets go where it is shorter than a thousandth of its rest length: never, here.
struct Taut {
  static constexpr const char* name = "taut";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness", "rest_length"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness, const T& rest_length) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T length = d.norm();
    const T tension = select(length > T(1e-3 * rest_length), T(stiffness * (length - rest_length)), T(0.0));
    return T(tension / length) * d;
  }
};

/// The same with springs that make a choice.
Problem choosing(Problem problem) {
  const System<double> before = problem.system;
  problem.system = System<double>(before.dimension(), before.mass());
  for (int i = 0; i < before.particles(); ++i)
    if (before.fixed()[i]) problem.system.fix(i);
  for (const auto& elements : before.elements()) {
    std::vector<std::array<int, 2>> pairs;
    std::vector<std::array<double, 2>> parameters;
    for (std::size_t e = 0; e < elements.count(); ++e) {
      pairs.push_back({elements.particles[2 * e], elements.particles[2 * e + 1]});
      parameters.push_back({elements.parameters[2 * e], elements.parameters[2 * e + 1]});
    }
    problem.system.add<Taut>(pairs, parameters);
  }
  return problem;
}

enum class Look { at_nothing, at_forces, at_choices };

/// Steps of Taylor's method, as long as the shortest period's thousandth, from one of two states to the other.
void step(benchmark::State& run, const Problem& problem, int degree, Look look) {
  constexpr double h = 1e-5;
  Expansion<double> series(problem.system, degree + 1);
  const std::vector<double> weights(degree + 2, 1.0);
  State<double> now = problem.start, next = problem.start;
  next.time += h;
  next.position += h * next.velocity;
  Coordinates<double> x, v;
  for (auto _ : run) {
    series.start(now);
    series.grow_to(degree + 1);
    double reach = h;
    if (look == Look::at_choices) benchmark::DoNotOptimize(series.first_change(reach));
    series.position_sum(0, degree, weights.data(), h, x);
    series.velocity_sum(0, degree, weights.data(), h, v);
    benchmark::DoNotOptimize(x.data());
    benchmark::DoNotOptimize(v.data());
    if (look == Look::at_forces) {
      Expansion<double>::Departure departure;
      series.look_ahead(next, 3);
      series.take_departure(degree, weights.data(), h, 0, series.particles(), departure);
      benchmark::DoNotOptimize(departure);
    }
    benchmark::ClobberMemory();
    std::swap(now, next);
  }
}

}  // namespace

void register_checks() {
  const auto add = [](const std::string& name, const std::string& what, const Problem& problem, int degree,
                      Look look) {
    benchmark::RegisterBenchmark(("BM_Check/" + name + "/" + std::to_string(degree) + "/" + what).c_str(),
                                 step, problem, degree, look);
  };
  for (const std::string name : {"cloth10", "cloth50", "kepler"})
    for (const int degree : {2, 8, 16}) {
      add(name, "none", bench::problem(name), degree, Look::at_nothing);
      add(name, "forces", bench::problem(name), degree, Look::at_forces);
    }
  for (const int degree : {2, 8, 16}) {
    add("taut", "none", choosing(bench::problem("cloth10")), degree, Look::at_nothing);
    add("taut", "choices", choosing(bench::problem("cloth10")), degree, Look::at_choices);
  }
}

}  // namespace jetlag::bench
