// SPDX-License-Identifier: MIT
// Source of the ends: Taylor series in 75-digit arithmetic, each repeated at a second order.
#include "problems/hard_cases.hpp"

#include <tuple>
#include <utility>

#include "problems/chains.hpp"
#include "problems/particles.hpp"
#include "problems/planets.hpp"

namespace jetlag::problems {

namespace {

/// The same with its end at `until`: positions of the last particle, others where they began.
Problem until(Problem problem, double time, double x, double y) {
  problem.until = time;
  problem.end = problem.start.position;
  problem.end->bottomRows(1) << x, y;
  return problem;
}

}  // namespace

std::vector<Problem> hard_cases() {
  std::vector<Problem> all;
  const auto add = [&](const std::string& name, const std::string& difficulty, Problem problem) {
    problem.name = name;
    problem.description = difficulty;
    all.push_back(std::move(problem));
  };
  for (const auto& [e, digits, time, x, y] :
       {std::tuple(0.9, "0.9", 20.0, -1.295266250987574367717139, 0.4003938963792321527297696),
        {0.99, "0.99", 100.0, -0.9388973273317407724449242, -0.1408830418653664609724341},
        {0.999, "0.999", 100.0, -0.9573122285019766715756194, -0.04467131067346635677615}})
    add(std::string("H1 planet, e = ") + digits, "a close passage in each period",
        until(planet(e), time, x, y));
  add("H2 three bodies from rest", "encounters of 4e-4, chaos", three_bodies());
  add("H3 masses 1 and 1e-6", "a fast light mass on a slow heavy one", light_mass());
  add("H3 springs 1 and 1e6", "a stiff spring after a soft one", stiff_spring());
  add("H4 Henon-Heiles, chaotic", "disturbances grow 7.6e4 times",
      until(henon_heiles({0, 0}, {0.56, 0.08}), 100, -0.1897889011958567181822281,
            0.1082076197948636723753129));
  const std::string collapses = "the force turns round in an instant";
  for (const auto& [delta, digits, x, y] :
       {std::tuple(1e-1, "0.1", 0.52966029309327483381507699, -0.82583380869474958566542626),
        {1e-3, "1e-3", 1.263029561342757868655169, -0.084835542224449331469822793},
        {1e-6, "1e-6", 1.2661229803496504181608035, -0.00020477246036047531671662606}})
    add(std::string("H5 spring collapses, ") + digits, collapses, until(collapsing_spring(delta), 10, x, y));
  add("H5 spring collapses, 0", collapses, collapsing_spring(0));
  add("H6 stiff and soft mass", "multiples of steps resonate", resonant_chain());
  add("H7 Lorenz", "chaos; forces depend on velocities", lorenz_motion());
  add("H8 Pleiades", "seven bodies, close passages", pleiades());
  add("H9 Arenstorf", "passages of the moon; forces depend on velocities", arenstorf_orbit());
  add("H10 stiff and soft springs", "fast oscillations exchange energy slowly", stiff_and_soft_springs());
  add("H11 contact", "a mass bounces on a stiff floor", bounces());
  return all;
}

}  // namespace jetlag::problems
