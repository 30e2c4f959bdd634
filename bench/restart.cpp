// SPDX-License-Identifier: MIT
// What does the tape save over evaluating the force anew for every coefficient?
//
//   BM_Restart    the law on Jet<double, k> for k = 0, 1, ...: what one writes without a tape
//   BM_RestartTape   the tape and its kernels, begun anew for every coefficient: the same machine code as
//                    BM_Expansion, so that nothing but O(N^3) against O(N^2) is compared

// g++ 12 takes the convolutions of jets of different degrees, equal as machine code, for one function, and
// then warns that the shorter jets are too short for the longer ones.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif

#include "restart.hpp"

#include <cstring>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "benchmarks.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/series/eigen.hpp"

namespace jetlag::bench {

namespace {

/// Adds coefficient K of the forces: the law on jets of degree K, all of whose terms are known.
/// Jets that hold no more than a number are built once, outside the loop.
template <class Law, int K>
void add_forces(JetRestart::Motion& motion, const Elements<double>& elements) {
  using J = Jet<double, K>;
  constexpr int dimension = JetRestart::dimension;
  constexpr int width = static_cast<int>(Law::parameters.size());
  Participants<J, dimension, 2> p;
  std::array<J, width> parameters;
  for (std::size_t e = 0; e < elements.count(); ++e) {
    const int* members = &elements.particles[2 * e];
    for (int i = 0; i < 2; ++i) {
      p.mass[i][0] = motion.mass[members[i]];
      for (int c = 0; c < dimension; ++c)
        std::memcpy(&p.position[i][c][0], motion.position[members[i]][c].data(), (K + 1) * sizeof(double));
    }
    for (int j = 0; j < width; ++j) parameters[j][0] = elements.parameters[e * width + j];
    const Vector<J, dimension> f =
        std::apply([&](const auto&... c) { return Law::template force<J, dimension>(p, c...); }, parameters);
    for (int c = 0; c < dimension; ++c) {
      motion.force[members[0]][c] += f[c][K];
      motion.force[members[1]][c] -= f[c][K];
    }
  }
}

}  // namespace

template <class Law>
const JetRestart::Orders& JetRestart::orders() {
  static constexpr Orders table = []<std::size_t... K>(std::index_sequence<K...>) {
    return Orders{&add_forces<Law, static_cast<int>(K)>...};
  }(std::make_index_sequence<max_degree - 1>{});
  return table;
}

const JetRestart::Orders& JetRestart::orders_of(const std::string& law) {
  if (law == Spring::name) return orders<Spring>();
  if (law == Gravity::name) return orders<Gravity>();
  throw std::invalid_argument("JetRestart: no law '" + law + "'");
}

JetRestart::JetRestart(const System<double>& system) : elements_(system.elements()) {
  if (system.dimension() != dimension) throw std::invalid_argument("JetRestart: only in space");
  motion_.mass = system.mass();
  motion_.position.resize(system.particles());
  motion_.force.resize(system.particles());
  for (int i = 0; i < system.particles(); ++i)
    inverse_mass_.push_back(system.fixed()[i] ? 0.0 : 1.0 / system.mass()[i]);
  for (const auto& elements : elements_) laws_.push_back(&orders_of(elements.law.name));
}

void JetRestart::expand(const State<double>& state, int degree) {
  const std::size_t particles = inverse_mass_.size();
  for (std::size_t i = 0; i < particles; ++i)
    for (int c = 0; c < dimension; ++c) {
      motion_.position[i][c][0] = state.position(i, c);
      motion_.position[i][c][1] = state.velocity(i, c);
    }
  for (int k = 0; k + 2 <= degree; ++k) {
    for (auto& f : motion_.force) f.fill(0.0);
    for (std::size_t e = 0; e < elements_.size(); ++e) (*laws_[e])[k](motion_, elements_[e]);
    for (std::size_t i = 0; i < particles; ++i)
      for (int c = 0; c < dimension; ++c)
        motion_.position[i][c][k + 2] = motion_.force[i][c] * inverse_mass_[i] / ((k + 1) * (k + 2));
  }
}

namespace {

void restart_jet(benchmark::State& run, const std::string& name, int degree) {
  const Problem problem = bench::problem(name);
  JetRestart series(problem.system);
  for (auto _ : run) {
    series.expand(problem.start, degree);
    benchmark::DoNotOptimize(series.series(0, 0).data());
    benchmark::ClobberMemory();
  }
  count_elements(run, problem);
}

void restart_tape(benchmark::State& run, const std::string& name, int degree) {
  const Problem problem = bench::problem(name);
  Expansion<double> series(problem.system, degree);
  for (auto _ : run) {
    for (int known = 2; known <= degree; ++known) {
      series.start(problem.start);
      series.grow_to(known);
    }
    benchmark::DoNotOptimize(series.position(degree).data());
    benchmark::ClobberMemory();
  }
  count_elements(run, problem);
}

}  // namespace

void register_restart() {
  for (const std::string name : {"cloth10", "kepler"})
    for (const int degree : {2, 4, 8, 16, 32}) {
      const std::string tail = "/" + name + "/" + std::to_string(degree);
      benchmark::RegisterBenchmark(("BM_Restart" + tail).c_str(), restart_jet, name, degree);
      benchmark::RegisterBenchmark(("BM_RestartTape" + tail).c_str(), restart_tape, name, degree);
    }
}

}  // namespace jetlag::bench
