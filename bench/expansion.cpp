// SPDX-License-Identifier: MIT
// Does the expansion of a problem's motion cost O(N^2), and what is the price of an element? Does it cost more where the
// forces are taken from the energy than where they are written by hand?

#include "jetlag/motion/expansion.hpp"

#include <array>
#include <random>
#include <string>
#include <vector>

#include "benchmarks.hpp"
#include "jetlag/forces/forces.hpp"
#include "problems/from_energy.hpp"
#include "support/laws/laws_of_many.hpp"

namespace jetlag::bench {

namespace {

void expand(benchmark::State& run, const Problem& problem, int degree) {
  Expansion<double> series(problem.system, degree);
  for (auto _ : run) {
    series.start(problem.start);
    series.grow_to(degree);
    benchmark::DoNotOptimize(series.position(degree).data());
    benchmark::ClobberMemory();
  }
  count_elements(run, problem);
}

/// 512 elements of one law, each on particles of its own, in three dimensions.
template <ForceLaw L>
Problem elements_of() {
  constexpr int elements = 512, particles = elements * L::participants;
  std::mt19937_64 bits(1);
  const auto draw = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  Problem problem{System<double>(3, std::vector<double>(particles, 1.0)),
                  {0.0, Coordinates<double>(particles, 3), Coordinates<double>(particles, 3)}};
  for (int i = 0; i < particles; ++i)  // in the positive octant from the one before, and so apart
    for (int axis = 0; axis < 3; ++axis) {
      problem.start.position(i, axis) = draw() + 1.5 * (i % L::participants);
      problem.start.velocity(i, axis) = 0.1 * draw();
    }
  std::vector<std::array<int, L::participants>> members(elements);
  for (int i = 0; i < particles; ++i) members[i / L::participants][i % L::participants] = i;
  std::array<double, L::parameters.size()> parameters;
  parameters.fill(0.5);
  problem.system.add<L>(members, {parameters});
  return problem;
}

template <ForceLaw L>
void register_law() {
  constexpr int degree = 16;
  const auto both = [](const char* how, Problem (*problem)()) {
    benchmark::RegisterBenchmark(("BM_FromEnergy/" + std::string(L::name) + "/" + how).c_str(),
                                 [problem](benchmark::State& run) { expand(run, problem(), degree); });
  };
  both("by_hand", elements_of<L>);
  both("from_energy", elements_of<problems::FromEnergy<L>>);
}

}  // namespace

void register_expansion() {
  for (const std::string name : {"cloth10", "cloth50", "kepler"})
    for (const int degree : {2, 4, 8, 16, 32, 64})
      benchmark::RegisterBenchmark(
          ("BM_Expansion/" + name + "/" + std::to_string(degree)).c_str(),
          [name, degree](benchmark::State& run) { expand(run, bench::problem(name), degree); });
  register_law<Spring>();
  register_law<Gravity>();
  register_law<SoftenedGravity>();
  register_law<Floor>();
  register_law<QuadraticFloor>();
  register_law<testing::AngleByHand>();
  register_law<testing::Tetrahedron>();
}

}  // namespace jetlag::bench
