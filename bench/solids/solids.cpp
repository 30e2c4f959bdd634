// SPDX-License-Identifier: MIT
// What does a tetrahedron cost, and what a triangle of cloth? And where does Taylor's method win over leapfrog that is written
// by hand for this law alone?
//
//   BM_Solid/<law>/<elements>/<degree>     the expansion of a box of cubes, each cut in six; of a square sheet of triangles
//   BM_SolidAdolC/<degree>                 the same of neo_hookean by ADOL-C: y' = f(y), recorded once, by its driver forode
//   BM_Inclusion/<cells>/<stiff>           a cube of cells^3 with stiff^3 of them 10000 times stiffer: lockstep_over_block:
//                                          time; elements_over: element coefficients; errors of both [m]
//   BM_Beam/<method>/<steps>               a beam of 1152 neo-Hookean tetrahedra through 1 s; error: of the worst coordinate [m]

#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <string>
#include <type_traits>

#include "../benchmarks.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/hinges.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "leapfrog_by_hand.hpp"

#if defined(JETLAG_HAVE_ADOLC)
#include <adolc/adolc.h>
#endif

namespace jetlag::bench {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// E = 1e5 Pa, nu = 0.3, rho = 1000 kg/m^3.
template <ForceLaw L>
Problem body(const Mesh& mesh) {
  const auto [lambda, mu] = lame(1e5, 0.3);
  Problem problem{System<double>(3, lumped_masses(mesh.position, mesh.tetrahedra, 1000.0)),
                  {0.0, mesh.position, Coordinates<double>::Zero(mesh.position.rows(), 3)}};
  if constexpr (L::material.size() == 2)
    problem.system.add_at_rest<L>(mesh.tetrahedra, mesh.position, {{lambda, mu}});
  return problem;
}

/// side^3 cubes of 0.1 m, moved a little.
template <ForceLaw L>
Problem cube(int side) {
  const double length = 0.1 * side;
  Problem problem = body<L>(box({length, length, length}, {side, side, side}));
  for (int i = 0; i < problem.system.particles(); ++i) {
    const Eigen::RowVector3d x = problem.start.position.row(i);
    problem.start.position.row(i) += 0.02 * Eigen::RowVector3d(x[1] * x[2], x[0] * x[0], -x[0] * x[1]);
    problem.start.velocity.row(i) = Eigen::RowVector3d(x[2] * x[2], 0.7 * x[2], -x[2] * x[0]);
  }
  return problem;
}

/// side^2 cells of a cloth of 1 m, 2 kg/m^2, E t = 100 N/m: membranes, or the edges between them.
template <ForceLaw L>
Problem cloth(int side) {
  const Mesh mesh = sheet({1, 1}, {side, side}, SheetPattern::crisscross);
  constexpr double thickness = 1e-3;
  Problem problem{System<double>(3, lumped_masses(mesh.position, mesh.triangles, 2000.0, thickness)),
                  {0.0, mesh.position, Coordinates<double>::Zero(mesh.position.rows(), 3)}};
  if constexpr (std::is_same_v<L, Membrane>) {
    const auto [lambda, mu] = plane_stress(lame(1e5, 0.3));
    problem.system.add_at_rest<L>(mesh.triangles, mesh.position, {{lambda, mu, thickness}});
  } else {
    std::array<double, L::material.size()> material{1e-4};
    problem.system.add_at_rest<L>(hinges_of(mesh.triangles), mesh.position, {material});
  }
  for (int i = 0; i < problem.system.particles(); ++i) {
    const Eigen::RowVector3d x = problem.start.position.row(i);
    problem.start.position(i, 2) = 0.1 * x[0] * x[1];
    problem.start.velocity.row(i) = Eigen::RowVector3d(0.1 * x[1], 0, x[0] * x[0]);
  }
  return problem;
}

void expand(benchmark::State& run, Problem (*make)(int), int side, int degree) {
  const Problem problem = make(side);
  Expansion<double> series(problem.system, degree);
  for (auto _ : run) {
    series.start(problem.start);
    series.grow_to(degree);
    benchmark::ClobberMemory();
  }
  count_elements(run, problem);
}

// ---- the peer ----------------------------------------------------------------------------------------------

#if defined(JETLAG_HAVE_ADOLC)

constexpr short tape = 40;  // others use the first ones

/// Records x' = v, v' = F/m of neo-Hookean tetrahedra, with as few operations as possible.
void record(const Problem& problem) {
  const Elements<double>& all = problem.system.elements().at(0);
  const int unknowns = 3 * problem.system.particles();
  std::vector<adouble> x(unknowns), v(unknowns), force(unknowns);
  const auto room = static_cast<unsigned>(2000 * all.count() + 4096);
  trace_on(tape, 0, room, room, room, 32 * room);
  for (int row = 0; row < unknowns; ++row) x[row] <<= problem.start.position(row / 3, row % 3);
  for (int row = 0; row < unknowns; ++row) v[row] <<= problem.start.velocity(row / 3, row % 3);
  for (adouble& f : force) f = 0.0;
  for (std::size_t e = 0; e < all.count(); ++e) {
    const int* at = &all.particles[4 * e];
    const double* p = &all.parameters[9 * e];
    adouble d[3][3], c[3][3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) d[i][k] = x[3 * at[i] + k] - x[3 * at[3] + k];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const adouble *a = d[(i + 2) % 3], *b = d[(i + 1) % 3];
        c[i][k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
      }
    const adouble delta = d[0][0] * c[0][0] + d[0][1] * c[0][1] + d[0][2] * c[0][2];
    const adouble pull = (p[8] - p[7] * log(delta / p[6])) / delta;
    const double stiffness[3][3] = {{p[0], p[1], p[2]}, {p[1], p[3], p[4]}, {p[2], p[4], p[5]}};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const adouble f = pull * c[i][k] - stiffness[i][0] * d[0][k] - stiffness[i][1] * d[1][k] -
                          stiffness[i][2] * d[2][k];
        force[3 * at[i] + k] += f;
        force[3 * at[3] + k] -= f;
      }
  }
  double ignored;
  for (adouble& velocity : v) velocity >>= ignored;
  for (int row = 0; row < unknowns; ++row) {
    force[row] /= problem.system.mass()[row / 3];
    force[row] >>= ignored;
  }
  trace_off();
}

void expand_adolc(benchmark::State& run, int degree) {
  const Problem problem = cube<NeoHookean>(5);
  static const bool recorded = [&] {
    record(problem);
    return true;
  }();
  benchmark::DoNotOptimize(recorded);
  const int unknowns = 3 * problem.system.particles();
  std::vector<double> coefficients(2 * unknowns * (degree + 1));
  std::vector<double*> rows;
  for (int row = 0; row < 2 * unknowns; ++row) rows.push_back(&coefficients[row * (degree + 1)]);
  for (auto _ : run) {
    for (int row = 0; row < unknowns; ++row) {
      rows[row][0] = problem.start.position(row / 3, row % 3);
      rows[unknowns + row][0] = problem.start.velocity(row / 3, row % 3);
    }
    forode(tape, 2 * unknowns, 1.0, 0, degree - 1, rows.data());
    for (int row = 0; row < unknowns; ++row) rows[row][degree] = rows[unknowns + row][degree - 1] / degree;
    benchmark::ClobberMemory();
  }
  // Both must have found the same motion, to ten digits of the largest coefficient.
  Expansion<double> series(problem.system, degree);
  series.start(problem.start);
  series.grow_to(degree);
  double largest = 0, apart = 0;
  for (int row = 0; row < unknowns; ++row) {
    const double own = series.position(degree)(row / 3, row % 3);
    largest = std::max(largest, std::abs(own));
    apart = std::max(apart, std::abs(own - rows[row][degree]));
  }
  if (!(apart <= 1e-10 * largest)) run.SkipWithError("ADOL-C finds other coefficients");
  count_elements(run, problem);
}

#endif

// ---- against leapfrog by hand -----------------------------------------------------------------------------

constexpr double until = 1.0;  // [s]

/// Clamped where z = 0, 0.4 x 0.4 x 1.2 m. Its leapfrog limit is 5.7658e-3 s, its first period 2.2 s.
const Problem& beam() {
  static const Problem problem = [] {
    Problem beam = body<NeoHookean>(box({0.4, 0.4, 1.2}, {4, 4, 12}));
    for (int i = 0; i < beam.system.particles(); ++i) {
      const Eigen::RowVector3d x = beam.start.position.row(i);
      if (x[2] == 0)
        beam.system.fix(i);
      else
        beam.start.velocity.row(i) = Eigen::RowVector3d(2 * x[2] * x[2], 0.7 * x[2], -x[0] * x[2]);
    }
    return beam;
  }();
  return problem;
}

Coordinates<double> beam_by_taylor(int degree, int steps) {
  State<double> state = beam().start;
  Lockstep(taylor(beam().system, degree, std::make_unique<FixedStep>(until / steps))).run(state, until, {});
  return state.position;
}

double error_of(const Coordinates<double>& position) {
  static const Coordinates<double> truth = beam_by_taylor(20, 800);
  return (position - truth).cwiseAbs().maxCoeff();
}

void beam_by_hand(benchmark::State& run, int steps) {
  LeapfrogByHand leapfrog(beam());
  Coordinates<double> end;
  for (auto _ : run) end = leapfrog.run(until / steps, steps);
  run.counters["error"] = error_of(end);
}

void beam_by_series(benchmark::State& run, int degree, int steps) {
  Coordinates<double> end;
  for (auto _ : run) end = beam_by_taylor(degree, steps);
  run.counters["error"] = error_of(end);
}

// ---- a stiff core -----------------------------------------------------------------------------------------

struct Ended {
  double seconds;  // of the processor
  std::uint64_t element_coefficients;
  Coordinates<double> position;
};
Ended ended(const Problem& problem, Schedule&& schedule, double t) {
  State<double> state = problem.start;
  const std::clock_t start = std::clock();
  schedule.run(state, t, {});
  return {static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, schedule.work().element_coefficients,
          state.position};
}

/// Degree 4, each step at 0.8 of its limit: block steps by the limits of the particles, beside one clock.
void inclusion(benchmark::State& run, int side, int core) {
  const int first = (side - core) / 2;
  const Mesh mesh = box({1, 1, 1}, {side, side, side});
  Problem problem{System<double>(3, lumped_masses(mesh.position, mesh.tetrahedra, 1000.0)),
                  {0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)}};
  const auto [lambda, mu] = lame(1e5, 0.3);
  std::vector<std::array<double, 2>> material;
  for (const auto& t : mesh.tetrahedra) {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      double middle = 0;
      for (const int i : t) middle += side * mesh.position(i, axis) / 4;
      inside = inside && first < middle && middle < first + core;
    }
    const double times = inside ? 1e4 : 1.0;
    material.push_back({times * lambda, times * mu});
  }
  problem.system.add_at_rest<NeoHookean>(mesh.tetrahedra, mesh.position, material);
  for (int i = 0; i < problem.system.particles(); ++i) {
    const Eigen::RowVector3d x = mesh.position.row(i);
    problem.start.velocity.row(i) =
        0.1 * Eigen::RowVector3d(std::sin(3 * x[1]), x[0] * x[2], std::cos(2 * x[0]));
  }
  constexpr int degree = 4;
  constexpr double courant = 0.8, any_step = 1.0;
  const double soft_limit = 2 / (138.8 * side / 4),
               t = 4 * soft_limit;  // four of its steps, a few of leapfrog's
  const auto law = fixed_degree(degree);
  const auto one_clock = [&](int order) {
    return Lockstep(std::make_unique<RandomTaylor>(
        problem.system, fixed_degree(order),
        std::make_unique<Courant>(std::make_unique<FixedStep>(any_step), courant,
                                  Model<double>(problem.system), law, VelocitySeries::own_series)));
  };
  const auto block = [&] {
    BlockSteps::Options options;
    options.tolerance = 1.0;
    options.max_step = courant * soft_limit;
    options.courant = courant;
    return BlockSteps(problem.system, degree, options);
  };
  const Ended truth = ended(problem, one_clock(8), t);
  double one = infinity, many = infinity;
  for (auto _ : run) {
    const Ended a = ended(problem, one_clock(degree), t), b = ended(problem, block(), t);
    one = std::min(one, a.seconds);
    many = std::min(many, b.seconds);
    run.counters["elements_over"] =
        static_cast<double>(a.element_coefficients) / static_cast<double>(b.element_coefficients);
    run.counters["error_lockstep"] = (a.position - truth.position).cwiseAbs().maxCoeff();
    run.counters["error_block"] = (b.position - truth.position).cwiseAbs().maxCoeff();
  }
  run.counters["lockstep_over_block"] = one / many;
}

template <ForceLaw L>
void register_cloth(const std::string& elements) {
  for (const int degree : {4, 8, 16})
    benchmark::RegisterBenchmark(
        ("BM_Solid/" + std::string(L::name) + "/" + elements + "/" + std::to_string(degree)).c_str(), expand,
        cloth<L>, 19, degree);
}

template <ForceLaw L>
void register_law() {
  for (const int side : {5, 10})
    for (const int degree : {4, 8, 16, 32})
      benchmark::RegisterBenchmark(("BM_Solid/" + std::string(L::name) + "/" +
                                    std::to_string(6 * side * side * side) + "/" + std::to_string(degree))
                                       .c_str(),
                                   expand, cube<L>, side, degree);
}

}  // namespace

void register_solids() {
  register_law<NeoHookean>();
  register_law<Stvk>();
  register_law<StableNeoHookean>();
  register_law<PolynomialNeoHookean>();
  register_law<Corotated>();
  register_cloth<Membrane>("722");
  register_cloth<Bending>("1045");
  register_cloth<Hinge>("1045");
  for (const auto& [side, core] : {std::pair{8, 2}, {12, 2}, {12, 3}, {24, 3}})
    benchmark::RegisterBenchmark(
        ("BM_Inclusion/" + std::to_string(side) + "/" + std::to_string(core)).c_str(), inclusion, side, core)
        ->Unit(benchmark::kMillisecond);
#if defined(JETLAG_HAVE_ADOLC)
  for (const int degree : {8, 16})
    benchmark::RegisterBenchmark(("BM_SolidAdolC/" + std::to_string(degree)).c_str(), expand_adolc, degree);
#endif
  for (const int steps : {193, 386, 771, 1542, 3469, 13874, 55500})
    benchmark::RegisterBenchmark(("BM_Beam/leapfrog_by_hand/" + std::to_string(steps)).c_str(), beam_by_hand,
                                 steps)
        ->Unit(benchmark::kMillisecond);
  const std::map<int, std::vector<int>> steps_of_degree = {
      {4, {193, 289}}, {8, {121, 161, 241}}, {12, {84, 121, 181}}, {16, {84, 121, 181}}, {20, {61, 88, 131}}};
  for (const auto& [degree, all] : steps_of_degree)
    for (const int steps : all)
      benchmark::RegisterBenchmark(
          ("BM_Beam/taylor_" + std::to_string(degree) + "/" + std::to_string(steps)).c_str(), beam_by_series,
          degree, steps)
          ->Unit(benchmark::kMillisecond);
}

}  // namespace jetlag::bench
