// SPDX-License-Identifier: MIT
#include "studies/comparison/competitors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace jetlag {

namespace {

using Json = nlohmann::ordered_json;

const Json fixed_step = {{"type", "fixed"}};

Competitor fixed(int degree) {
  return {
      "fixed degree", fmt::format("degree {}", degree), {{"type", "taylor"}, {"degree", degree}}, fixed_step};
}

Competitor random(const std::string& family, const std::string& name, int m, Json law_and_draws) {
  Json integrator = {{"type", "random_taylor"}, {"min_degree", m}, {"max_degree", std::max(16, m + 8)}};
  integrator.update(law_and_draws);
  return {family, name, integrator, fixed_step, true};
}

Competitor other(const char* family, std::string name, Json integrator, Json control) {
  const bool has_step = control == fixed_step;
  return {family, std::move(name), std::move(integrator), std::move(control), false, has_step, false};
}

Competitor clocks(const char* schedule, int degree, int digits) {
  return {schedule,
          fmt::format("degree {}, tolerance 1e-{}", degree, digits),
          {{"type", "taylor"}, {"degree", degree}},
          {{"type", "last_two"}, {"tolerance", std::pow(10.0, -digits)}},
          false,
          false,
          true,
          {{"type", schedule}}};
}

/// The geometric law with 1 - p = 1 / base, drawn in one of several ways.
Competitor geometric(const std::string& draws, int m, double base) {
  return random(draws, fmt::format("m = {}, 1/(1-p) = {:.4g}", m, base), m,
                {{"probability", 1 - 1 / base}, {"draws", draws}});
}

}  // namespace

std::vector<Competitor> competitors() {
  std::vector<Competitor> all;
  for (int degree : {2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20}) all.push_back(fixed(degree));

  // Draws of one law. m + 1 orders on average for base 2: compare with the fixed degree m + 1.
  const double golden = std::numbers::phi * std::numbers::phi;
  for (const char* draws : {"independent", "antithetic", "scrambled_ruler", "ruler"})
    for (int m : {3, 4, 5, 6, 8, 10}) all.push_back(geometric(draws, m, 2));
  for (int m : {3, 4, 5, 6, 8, 10}) all.push_back(geometric("ruler", m, 5));
  for (int m : {3, 4, 5, 6, 8, 10}) all.push_back(geometric("rotation", m, golden));

  // Other laws of the same mean, m + 1.
  for (int m : {3, 4, 6, 8}) {
    all.push_back(
        random("poisson", fmt::format("m = {}, mean 1", m), m, {{"law", "poisson"}, {"mean", 1.0}}));
    all.push_back(random("single term", fmt::format("m = {}, p = .5", m), m,
                         {{"law", "single_term"}, {"probability", 0.5}}));
  }
  for (double target : {1e-4, 1e-7, 1e-10})
    all.push_back(random("sequential", fmt::format("m = 3, target {:.0e}", target), 3,
                         {{"law", "sequential"}, {"target", target}}));

  // Steps that are chosen.
  all.push_back({"jorba_zou",
                 "jorba_zou",
                 {{"type", "taylor"}, {"degree", 20}},
                 {{"type", "jorba_zou"}},
                 false,
                 false});
  for (int m : {3, 6})
    for (int digits : {3, 5, 7, 9}) {
      const double tolerance = std::pow(10.0, -digits);
      Competitor adaptive = random("variance control", fmt::format("m = {}, tolerance {:.0e}", m, tolerance),
                                   m, {{"probability", 0.5}});
      adaptive.control = {{"type", "variance"},
                          {"step", 1e-3},
                          {"tolerance_random", tolerance},
                          {"tolerance_bias", tolerance}};
      adaptive.has_step = false;
      all.push_back(adaptive);
    }
  // A clock for each particle.
  for (int degree : {8, 12, 16})
    for (int digits : {4, 6, 8, 10, 12}) {
      all.push_back(clocks("block", degree, digits));
      if (degree == 8) all.push_back(clocks("asynchronous", degree, digits));
    }

  // What one would take otherwise.
  for (const auto& [family, type] : {std::pair("leapfrog", "leapfrog"),
                                     {"euler", "symplectic_euler"},
                                     {"euler", "euler"},
                                     {"rk4", "rk4"},
                                     {"hermite", "hermite"},
                                     {"dopri5", "dopri5"},
                                     {"dop853", "dop853"},
                                     {"gauss_radau", "gauss_radau"},
                                     {"implicit", "implicit_midpoint"},
                                     {"implicit", "newmark"},
                                     {"noise", "exponential_step"}})
    all.push_back(other(family, type, {{"type", type}}, fixed_step));
  for (const char* type : {"dopri5", "dop853", "gauss_radau"})
    for (int digits : {3, 5, 7, 9, 11}) {
      const double tolerance = std::pow(10.0, -digits);
      all.push_back(other(type, fmt::format("{}, tolerance {:.0e}", type, tolerance), {{"type", type}},
                          {{"type", "embedded"}, {"tolerance", tolerance}}));
    }
  for (const char* accuracy : {"1e-2", "1e-3", "1e-4", "1e-5"})
    all.push_back(other("hermite", fmt::format("hermite, accuracy {}", accuracy), {{"type", "hermite"}},
                        {{"type", "aarseth"}, {"accuracy", std::stod(accuracy)}}));
  all.push_back(other("implicit", "explicit_implicit, beyond their limit",
                      {{"type", "explicit_implicit"}, {"implicit", "courant"}}, fixed_step));
  for (double courant : {0.8, 0.4, 0.2, 0.1, 0.05}) {
    const Json control = {{"type", "fixed"}, {"courant", courant}};
    all.push_back(other("avi", fmt::format("avi, courant {}", courant), {{"type", "avi"}}, control));
    all.push_back(other("subcycling", fmt::format("subcycling, courant {}", courant),
                        {{"type", "subcycling"}, {"ratio", "courant"}}, control));
  }
  for (const auto& [type, digits] :
       {std::pair("qss1", 2), {"qss1", 3}, {"qss2", 3}, {"qss2", 5}, {"qss3", 4}, {"qss3", 6}})
    all.push_back(other("qss", fmt::format("{}, quantum 1e-{}", type, digits), {{"type", type}},
                        {{"type", "quantum"}, {"quantum", std::pow(10.0, -digits)}}));
  // Noise of the size of the method's own error; orders of the methods.
  all.push_back(other("noise", "conrad, rk4",
                      {{"type", "conrad"}, {"inner", {{"type", "rk4"}}}, {"order", 4}, {"sigma", 1.0}},
                      fixed_step));
  all.push_back(other("noise", "random_step, leapfrog",
                      {{"type", "random_step"}, {"inner", {{"type", "leapfrog"}}}, {"order", 2}},
                      fixed_step));
  for (Competitor& competitor : all)
    if (competitor.family == "noise") competitor.random = true;
  return all;
}

}  // namespace jetlag
