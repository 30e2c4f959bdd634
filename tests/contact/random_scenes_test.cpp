// SPDX-License-Identifier: MIT
// Nothing passes through anything: triangles, edges and points that fly at each other at 1e-3 to 1e5 m/s, in scenes at random.
// Along the polynomials of every step every pair of features is looked at for a crossing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "jetlag/contact/approach.hpp"
#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/contact/stencil.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "support/random.hpp"

namespace jetlag::testing::random_scenes_test {
namespace {

/// Bodies that start on spheres, each 0.9 m farther out than the one before, and fly to the middle, the outer ones faster.
struct Scene {
  System<double> system;
  Surface surface;
  State<double> start;
  double speed;  // [m/s]
};

Scene random_scene(std::uint64_t seed) {
  constexpr int triangles = 3, edges = 2, points = 2, particles = 3 * triangles + 2 * edges + points;
  Uniform draw(seed);
  std::vector<std::array<int, 3>> faces;
  std::vector<std::array<int, 2>> segments;
  std::vector<int> single;
  std::vector<double> mass;
  for (int i = 0; i < particles; ++i) mass.push_back(std::pow(10.0, draw(-1, 1)));
  Scene scene{System<double>(3, mass),
              {},
              {0, Coordinates<double>(particles, 3), Coordinates<double>(particles, 3)},
              std::pow(10.0, draw(-3, 5))};
  int first = 0;
  for (int body = 0; first < particles; ++body) {
    const int size = body < triangles ? 3 : body < triangles + edges ? 2 : 1;
    if (size == 3) faces.push_back({first, first + 1, first + 2});
    if (size == 2) segments.push_back({first, first + 1});
    if (size == 1) single.push_back(first);
    Eigen::RowVector3d center(draw(-1, 1), draw(-1, 1), draw(-1, 1));
    center *= (1 + 0.9 * body) / center.norm();
    for (const int end = first + size; first < end; ++first)
      for (int d = 0; d < 3; ++d) {
        scene.start.position(first, d) = center[d] + draw(-.4, .4);
        scene.start.velocity(first, d) =
            scene.speed * (-center[d] / (1 + 0.9 * body) * (1.5 + 0.5 * body) + draw(-.1, .1));
      }
  }
  scene.surface = Surface(faces, segments, single);
  // Every other scene is held together, by springs that turn a body about as often as it meets others.
  if (seed % 2 == 0)
    for (const auto& [a, b] : scene.surface.edges()) {
      const double length = (scene.start.position.row(a) - scene.start.position.row(b)).norm();
      scene.system.add<Spring>({{a, b}}, {{100 * scene.speed * scene.speed, length}});
    }
  add(scene.system,
      ContactBarrier{
          .surface = scene.surface, .rest = scene.start.position, .thickness = 0.05, .stiffness = 1000});
  return scene;
}

std::vector<Stencil> all_pairs(const Surface& surface) {
  std::vector<Stencil> all;
  const auto apart = [](const auto& a, const auto& b) {
    return std::ranges::none_of(a, [&](int i) { return std::ranges::find(b, i) != b.end(); });
  };
  for (const int p : surface.vertices())
    for (const auto& t : surface.triangles())
      if (apart(std::array{p}, t)) all.push_back({StencilKind::vertex_face, {p, t[0], t[1], t[2]}});
  for (const auto& e : surface.edges())
    for (const auto& f : surface.edges())
      if (e < f && apart(e, f)) all.push_back({StencilKind::edge_edge, {e[0], e[1], f[0], f[1]}});
  return all;
}

/// Whether any two features meet in a step.
class Watch {
 public:
  explicit Watch(const Surface& surface) : pairs_(all_pairs(surface)) {}

  bool sees_crossing(const PieceView& piece) {
    const double h = piece.end - piece.begin;
    for (const Stencil& pair : pairs_) {
      std::array<PathView, 4> path;
      std::array<Eigen::Vector3d, 4> x;
      double far = 0;  // how far the four go in the step, together
      for (int i = 0; i < 4; ++i) {
        const double* c = piece.position.row(0, pair.vertices[i]);
        path[i] = {c, static_cast<std::ptrdiff_t>(piece.position.numbers_of_each()),
                   static_cast<int>(piece.position.size()) - 1, piece.unit};
        x[i] = {c[0], c[1], c[2]};
        double power = 1;
        for (int n = 1; n <= path[i].degree; ++n) {
          power *= h / piece.unit;
          const double* term = c + n * path[i].stride;
          far += power * (std::abs(term[0]) + std::abs(term[1]) + std::abs(term[2]));
        }
      }
      if (closest(pair.kind, x).distance > far + 1e-9) continue;
      if (approach_.first(pair.kind, path, h, 0)) return true;
    }
    return false;
  }

 private:
  std::vector<Stencil> pairs_;
  Approach approach_;
};

using Make = std::unique_ptr<Schedule> (*)(const Scene&, std::uint64_t seed);

std::unique_ptr<Schedule> one_clock(const Scene& scene, TruncationLaw law, std::unique_ptr<Control> control,
                                    std::uint64_t seed = 1) {
  RandomTaylor::Options options;
  options.shared_draw = true;
  options.seed = seed;
  return std::make_unique<Lockstep>(
      std::make_unique<RandomTaylor>(scene.system, std::move(law), std::move(control), options));
}

struct Method {
  const char* name;
  Make make;
  bool must_arrive;  // and not only say that it does not
  double
      energy;  // what it may err by, relative: each step by the tolerance, in barriers and springs that hold all of it
  double
      momentum;  // likewise, of the sum of masses times the speed; with one clock forces are in pairs, but for rounding
};

const Method methods[] = {
    {"degree20",
     [](const Scene& s, std::uint64_t) {
       return one_clock(s, fixed_degree(20), std::make_unique<JorbaZou>());
     },
     true, 1e-11, 1e-13},
    {"loose",
     [](const Scene& s, std::uint64_t) {
       return one_clock(s, fixed_degree(6), std::make_unique<LastTwo>(1e-3));
     },
     true, 2e-2, 1e-13},
    {"random",
     [](const Scene& s, std::uint64_t seed) {
       return one_clock(s, geometric(6, 12, 0.5), std::make_unique<LastTwo>(1e-6), seed);
     },
     true, 5e-3, 1e-13},
    {"given",
     [](const Scene& s, std::uint64_t) {
       return one_clock(s, fixed_degree(8), std::make_unique<FixedStep>(2e-3 / s.speed));
     },
     false, 0, 1e-13},
    {"blocks",
     [](const Scene& s, std::uint64_t) -> std::unique_ptr<Schedule> {
       BlockSteps::Options options;
       options.tolerance = 1e-6;
       return std::make_unique<BlockSteps>(s.system, 12, options);
     },
     true, 1e-4, 1e-4},
    {"free",
     [](const Scene& s, std::uint64_t) -> std::unique_ptr<Schedule> {
       Asynchronous::Options options;
       options.tolerance = 1e-6;
       return std::make_unique<Asynchronous>(s.system, 12, options);
     },
     true, 1e-4, 1e-4},
};

class RandomScenes : public ::testing::TestWithParam<Method> {};

/// JETLAG_RANDOM_SCENES: how many of them instead of a few.
TEST_P(RandomScenes, NothingPassesThroughAnything) {
  const Method& method = GetParam();
  const char* wanted = std::getenv("JETLAG_RANDOM_SCENES");
  const std::uint64_t scenes = wanted ? std::strtoull(wanted, nullptr, 10) : 12;
  for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
    const Scene scene = random_scene(seed);
    SCOPED_TRACE(::testing::Message() << "scene " << seed << " at " << scene.speed << " m/s");
    Watch watch(scene.surface);
    RunOptions options;
    options.max_steps = 100'000;
    bool crossed = false;
    options.observer.after_step = [&](const StepView& step) {
      crossed = watch.sees_crossing(step.motion());
      return !crossed;
    };
    State<double> state = scene.start;
    EnergyMeter energy(scene.system);
    const double before = energy(state).total();
    const Report report = method.make(scene, seed)->run(state, 4 / scene.speed, options);
    ASSERT_FALSE(crossed) << "by t = " << state.time;
    if (method.must_arrive) {
      ASSERT_EQ(report.outcome, Outcome::success) << report.message;
      EXPECT_NEAR(energy(state).total() / before, 1, method.energy);
    }
    const double size =
        scene.speed * std::accumulate(scene.system.mass().begin(), scene.system.mass().end(), 0.0);
    EXPECT_LE((momentum(scene.system, state) - momentum(scene.system, scene.start)).norm(),
              method.momentum * size);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, RandomScenes, ::testing::ValuesIn(methods),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace jetlag::testing::random_scenes_test
