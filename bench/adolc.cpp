// SPDX-License-Identifier: MIT
// How does the expansion compare with ADOL-C on the same equations?

#include "adolc.hpp"

#include "benchmarks.hpp"

#if defined(JETLAG_HAVE_ADOLC)

#include <adolc/adolc.h>

#include <array>
#include <map>
#include <stdexcept>

#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"

namespace jetlag::bench {

namespace {

constexpr unsigned orders = 64;

/// Entries of ADOL-C's buffers for one order, generously: what does not fit into them it writes to files.
unsigned room(const Problem& problem) {
  return static_cast<unsigned>(128 * element_count(problem.system) + 64 * problem.system.particles() + 1024);
}

using Difference = std::array<adouble, 3>;

adouble squared_norm(const Difference& d) { return d[0] * d[0] + d[1] * d[1] + d[2] * d[2]; }

/// The factor of d in the force on participant 0, written with as few operations as possible.
adouble spring(const Difference& d, const double* parameters, double, double) {
  return parameters[0] - parameters[0] * parameters[1] / sqrt(squared_norm(d));
}
adouble gravity(const Difference& d, const double* parameters, double mass, double other_mass) {
  const adouble square = squared_norm(d);
  return parameters[0] * mass * other_mass / (square * sqrt(square));
}

auto* strength_of(const std::string& law) {
  if (law == Spring::name) return &spring;
  if (law == Gravity::name) return &gravity;
  throw std::invalid_argument("AdolC: no law '" + law + "'");
}

}  // namespace

AdolC::AdolC(const Problem& problem, short tape)
    : tape_(tape), unknowns_(3 * problem.system.particles()), rows_(2 * unknowns_) {
  const System<double>& system = problem.system;
  std::vector<adouble> x(unknowns_), v(unknowns_), force(unknowns_);
  trace_on(tape_, 0, room(problem), room(problem), room(problem), orders * room(problem));
  for (int row = 0; row < unknowns_; ++row) x[row] <<= problem.start.position(row / 3, row % 3);
  for (int row = 0; row < unknowns_; ++row) v[row] <<= problem.start.velocity(row / 3, row % 3);
  for (adouble& f : force) f = 0.0;
  for (const auto& elements : system.elements()) {
    const auto strength = strength_of(elements.law.name);
    const std::size_t width = elements.law.parameters.size();
    for (std::size_t e = 0; e < elements.count(); ++e) {
      const int own = elements.particles[2 * e], other = elements.particles[2 * e + 1];
      Difference d;
      for (int c = 0; c < 3; ++c) d[c] = x[3 * other + c] - x[3 * own + c];
      const adouble s =
          strength(d, &elements.parameters[e * width], system.mass()[own], system.mass()[other]);
      for (int c = 0; c < 3; ++c) {
        const adouble f = s * d[c];
        force[3 * own + c] += f;
        force[3 * other + c] -= f;
      }
    }
  }
  double ignored;
  for (adouble& velocity : v) velocity >>= ignored;
  for (int row = 0; row < unknowns_; ++row) {
    const double mass = system.mass()[row / 3];
    if (mass != 1.0) force[row] /= mass;
    force[row] >>= ignored;
  }
  trace_off();
}

void AdolC::expand(const State<double>& state, int degree) {
  if (degree != degree_) {
    degree_ = degree;
    coefficients_.assign(rows_.size() * (degree + 1), 0.0);
    for (std::size_t row = 0; row < rows_.size(); ++row) rows_[row] = series_of(static_cast<int>(row)).data();
  }
  for (int row = 0; row < unknowns_; ++row) {
    rows_[row][0] = state.position(row / 3, row % 3);
    rows_[unknowns_ + row][0] = state.velocity(row / 3, row % 3);
  }
  forode(tape_, 2 * unknowns_, 1.0, 0, degree - 1, rows_.data());
  for (int row = 0; row < unknowns_; ++row) rows_[row][degree] = rows_[unknowns_ + row][degree - 1] / degree;
}

AdolC& adolc(const std::string& name) {
  static auto recordings = [] {
    std::map<std::string, AdolC> all;
    short tape = 0;
    for (const char* each : {"kepler", "cloth10", "cloth50"})
      all.try_emplace(each, bench::problem(each), ++tape);
    return all;
  }();
  return recordings.at(name);
}

namespace {

void expand_adolc(benchmark::State& run, const std::string& name, int degree) {
  const Problem problem = bench::problem(name);
  AdolC& series = adolc(name);
  for (auto _ : run) {
    series.expand(problem.start, degree);
    benchmark::DoNotOptimize(series.series(0, 0).data());
    benchmark::ClobberMemory();
  }
  count_elements(run, problem);
}

}  // namespace

void register_adolc() {
  for (const std::string name : {"cloth10", "cloth50", "kepler"})
    for (const int degree : {2, 4, 8, 16, 32, 64}) {
      if (name == "cloth50" && degree > 16) continue;  // more than a second for each expansion
      benchmark::RegisterBenchmark(("BM_ExpansionAdolC/" + name + "/" + std::to_string(degree)).c_str(),
                                   expand_adolc, name, degree);
    }
  for (const std::string name : {"cloth10", "cloth50"})
    benchmark::RegisterBenchmark(("engine/adolc/" + name).c_str(), expand_adolc, name, 16);
}

}  // namespace jetlag::bench

#else

namespace jetlag::bench {
void register_adolc() {}
}  // namespace jetlag::bench

#endif
