// SPDX-License-Identifier: MIT
#include "problems/particles.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "jetlag/forces/floor.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "problems/laws.hpp"

namespace jetlag {
template RecordedLaw record_law<problems::SineOfAngle>(int);
template RecordedLaw record_law<problems::HenonHeiles>(int);
}  // namespace jetlag

namespace jetlag::problems {

namespace {

/// A spring that collapses exactly: a harmonic motion about 1 or -1, on whichever side the mass is. It crosses at asin(5/6)
/// and a half turn of 2 (pi - atan(sqrt(.44))) later, and is at 1 - cos t + sqrt(.44) sin t after that.
double collapsed_at_ten() {
  const double speed = std::sqrt(0.44),
               since = 10 - std::asin(5.0 / 6) - 2 * (std::numbers::pi - std::atan(speed));
  return 1 - std::cos(since) + speed * std::sin(since);
}

}  // namespace

Problem oscillator(double omega, double x, double v) {
  System<double> system(1, {1.0});
  system.add<Tether>({{0}}, {{omega * omega}});
  return {std::move(system),
          {0.0, Coordinates<double>::Constant(1, 1, x), Coordinates<double>::Constant(1, 1, v)}};
}

Problem circular_oscillator(double omega) {
  System<double> system(2, {1.0});
  system.add<Tether>({{0}}, {{omega * omega}});
  return {std::move(system), {0.0, Coordinates<double>{{1.0, 0.0}}, Coordinates<double>{{0.0, omega}}}};
}

Problem pendulum() {
  System<double> system(1, {1.0});
  system.add<SineOfAngle>({{0}}, {{}});
  return {std::move(system), {0.0, Coordinates<double>{{1.3}}, Coordinates<double>{{0.0}}}};
}

Problem free_fall() {
  System<double> system(3, {2.0});
  system.add<UniformField>({{0}}, {{0.5, -0.25, -9.75}});
  return {std::move(system),
          {0.0, Coordinates<double>{{1.0, 2.0, 3.0}}, Coordinates<double>{{-1.0, 0.5, 4.0}}}};
}

Problem dumbbell(double stiffness, double mass_0, double mass_1) {
  System<double> system(1, {mass_0, mass_1});
  system.add<Spring>({{0, 1}}, {{stiffness, 1.0}});
  return {std::move(system), {0.0, Coordinates<double>{{0.0}, {1.2}}, Coordinates<double>::Zero(2, 1)}};
}

Problem henon_heiles(const std::array<double, 2>& q, const std::array<double, 2>& p) {
  System<double> system(2, {1.0});
  system.add<HenonHeiles>({{0}}, {{}});
  return {std::move(system), {0.0, Coordinates<double>{{q[0], q[1]}}, Coordinates<double>{{p[0], p[1]}}}};
}

Problem collapsing_spring(double delta) {
  System<double> system(2, {1.0, 1.0});
  system.fix(0);
  system.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  Problem problem{std::move(system),
                  {0.0, Coordinates<double>{{0, 0}, {1, 0}}, Coordinates<double>{{0, 0}, {-1.2, delta}}}};
  problem.until = 10;
  if (delta == 0) problem.end = Coordinates<double>{{0, 0}, {collapsed_at_ten(), 0}};
  return problem;
}

/// A fall to the speed v, s'' = g - w^2 s for 2 (pi - atan(v w / g)) / w, and back to where it was.
Problem bounces() {
  constexpr double g = 9.81, w = 100;
  const double v = std::sqrt(2 * g),
               between = 2 * v / g + 2 * (std::numbers::pi - std::atan(v * w / g)) / w;  // [s]
  System<double> system(2, {1.0});
  system.add<UniformField>({{0}}, {{0.0, -g, 0.0}});
  system.add<Floor>({{0}}, {{w * w, 0.0, 0.0, 1.0, 0.0}});
  Problem problem{std::move(system), {0.0, Coordinates<double>{{0, 1}}, Coordinates<double>{{0.1, 0}}}};
  problem.until = 10 * between;
  problem.end = Coordinates<double>{{between, 1}};
  return problem;
}

Problem lorenz_motion() {
  System<double> system(3, {1.0});
  system.add<LorenzForce>({{0}}, {{}});
  Problem problem{std::move(system),
                  {0.0, Coordinates<double>{{-10, -1, 40}},
                   Coordinates<double>{{10 * (-1 + 10), -10 * (28 - 40) + 1, 10 - 8.0 / 3.0 * 40}}}};
  problem.until = 10;
  problem.end = Coordinates<double>{
      {4.228562964151610546011453, 0.7458347709009345752019322, 27.28032962198835979290540}};
  return problem;
}

}  // namespace jetlag::problems
