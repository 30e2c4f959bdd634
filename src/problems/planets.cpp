// SPDX-License-Identifier: MIT
// Source of the ends: Taylor series in 75-digit arithmetic, each repeated at a second order.
#include "problems/planets.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "jetlag/forces/gravity.hpp"
#include "problems/laws.hpp"

namespace jetlag::problems {

System<double> attracting(int dimension, const std::vector<double>& mass, double constant) {
  System<double> system(dimension, mass);
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < system.particles(); ++i)
    for (int j = 0; j < i; ++j) pairs.push_back({j, i});
  system.add<Gravity>(pairs, {{constant}});
  return system;
}

Problem planet(double e) {
  System<double> system = attracting(2, {1.0, 1.0});
  system.fix(0);
  State<double> start = at_origin(system);
  start.position(1, 0) = 1.0 - e;
  start.velocity(1, 1) = std::sqrt((1.0 + e) / (1.0 - e));
  Problem problem{std::move(system), std::move(start)};
  problem.largest_step = 2 * std::numbers::pi / 14.7964875;
  return problem;
}

Problem perturbed_planet() {
  System<double> system(2, {1.0});
  system.add<PerturbedKepler>({{0}}, {{0.015}});
  return {std::move(system), {0.0, Coordinates<double>{{0.4, 0.0}}, Coordinates<double>{{0.0, 2.0}}}};
}

Problem falling_together(double distance) {
  System<double> system = attracting(2, {1.0, 3.0});
  State<double> start = at_origin(system);
  start.position(1, 0) = distance;
  return {std::move(system), std::move(start)};
}

/// pi/2 sqrt(distance^3 / (2 * 4)).
double time_of_collision(double distance) {
  return std::numbers::pi / 2 * std::sqrt(distance * distance * distance / 8.0);
}

Problem inclined_pair() {
  return {attracting(3, {3.0, 1.0}),
          {0.0, Coordinates<double>{{-0.2, 0.1, 0.05}, {0.6, -0.3, -0.15}},
           Coordinates<double>{{0.1, 0.3, -0.2}, {-0.3, -0.9, 0.6}}}};
}

Problem light_body() {
  return {attracting(2, {1.0, 1e-9}),
          {0.0, Coordinates<double>{{0, 0}, {0.5, 0}}, Coordinates<double>{{0, 0}, {0, std::sqrt(3.0)}}}};
}

Problem three_bodies() {
  Problem problem{attracting(2, {3, 4, 5}),
                  {0.0, Coordinates<double>{{1, 3}, {-2, -1}, {1, -1}}, Coordinates<double>::Zero(3, 2)}};
  problem.until = 20;
  problem.end = Coordinates<double>{{3.00429263669639920544772, 0.51192523502468586559768},
                                    {-1.38862653751089539245553, -0.47047605025272216812795},
                                    {-0.69167434200912320931042, 0.06922569918736621514375}};
  return problem;
}

Problem figure_eight() {
  const double x = 0.97000436, y = -0.24308753, u = -0.93240737, v = -0.86473146;
  Problem problem{attracting(2, {1, 1, 1}),
                  {0.0, Coordinates<double>{{x, y}, {-x, -y}, {0, 0}},
                   Coordinates<double>{{-u / 2, -v / 2}, {-u / 2, -v / 2}, {u, v}}}};
  problem.until = 6.32591398;
  return problem;
}

Problem pleiades() {
  Problem problem{attracting(2, {1, 2, 3, 4, 5, 6, 7}),
                  {0.0, Coordinates<double>{{3, 3}, {3, -3}, {-1, 2}, {-3, 0}, {2, 0}, {-2, -4}, {2, 4}},
                   Coordinates<double>{{0, 0}, {0, 0}, {0, 0}, {0, -1.25}, {0, 1}, {1.75, 0}, {-1.5, 0}}}};
  problem.until = 3;
  problem.end = Coordinates<double>{{0.370613914397051290093951, -3.94343758551739205527788},
                                    {3.23728409205723309280333, -3.27138097397254992802068},
                                    {-3.22255903241832334710013, 5.22508184345654419243874},
                                    {0.659709145577530835934996, -2.59061243497746951081119},
                                    {0.342558170715657979037736, 1.198213693392274637514},
                                    {1.56217210140063101604571, -0.242968234493582340916112},
                                    {-0.700309292221249538514733, 1.09144924042897974788206}};
  return problem;
}

Problem outer_solar_system(int bodies) {
  const std::vector<double> mass{1.00000597682,      0.000954786104043,  0.000285583733151,
                                 0.0000437273164546, 0.0000517759138449, 1 / 1.3e8};
  const Coordinates<double> position{{0, 0, 0},
                                     {-3.5023653, -3.8169847, -1.5507963},
                                     {9.0755314, -3.0458353, -1.6483708},
                                     {8.3101420, -16.2901086, -7.2521278},
                                     {11.4707666, -25.7294829, -10.8169456},
                                     {-15.5387357, -25.2225594, -3.1902382}},
      velocity{{0, 0, 0},
               {0.00565429, -0.00412490, -0.00190589},
               {0.00168318, 0.00483525, 0.00192462},
               {0.00354178, 0.00137102, 0.00055029},
               {0.00288930, 0.00114527, 0.00039677},
               {0.00276725, -0.00170702, -0.00136504}};
  return {attracting(3, {mass.begin(), mass.begin() + bodies}, 2.95912208286e-4),
          {0.0, position.topRows(bodies), velocity.topRows(bodies)}};
}

Problem bodies_at_rest(int bodies) {
  System<double> system = attracting(3, std::vector<double>(bodies, 1.0 / bodies));
  State<double> start = at_origin(system);
  std::mt19937_64 generator(1);
  for (double& x : start.position.reshaped()) x = 0x1p-53 * static_cast<double>(generator() >> 11);
  return {std::move(system), std::move(start)};
}

Problem arenstorf_orbit() {
  System<double> system(2, {1.0});
  system.add<ArenstorfForce>({{0}}, {{0.012277471}});
  Problem problem{
      std::move(system),
      {0.0, Coordinates<double>{{0.994, 0}}, Coordinates<double>{{0, -2.00158510637908252240537862224}}}};
  problem.until = 17.0652165601579625588917206249;
  problem.end = Coordinates<double>{{0.994, 0}};
  return problem;
}

}  // namespace jetlag::problems
