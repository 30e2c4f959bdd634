// SPDX-License-Identifier: MIT
#pragma once
// The table of `./run bench engine`: what is measured, beside the goals set for it.

#include <iosfwd>
#include <optional>
#include <string>

namespace jetlag::bench {

inline constexpr int engine_degrees[] = {8, 16, 32, 64};
inline constexpr int engine_sides[] = {14, 42, 130, 410};  // cloths of 1e3, 1e4, 1e5, 1e6 springs

/// Small systems, the goals for a step in dependent multiply-adds, and those for a member and step of ensembles of 8 and of many.
struct SmallSystem {
  const char *name, *title;
  double step, of_eight, of_many;
  int many;
};
inline constexpr SmallSystem small_systems[] = {
    {"pendulum", "pendulum", 150, 40, 30, 256},
    {"planet", "planet about a sun that is held", 220, 45, 36, 256},
    {"henon_heiles", "Henon and Heiles", 140, 30, 25, 256},
    {"sun_jupiter_saturn", "Sun, Jupiter, Saturn", 420, 300, 270, 32},
    {"solar", "outer Solar System", 1000, 1200, 900, 32}};

/// Bodies of which each attracts each, and the goals for a step in dependent multiply-adds.
struct ManyBodies {
  const char *name, *title;
  double step;
};
inline constexpr ManyBodies many_bodies[] = {{"bodies32", "32 bodies", 3.6e4},
                                             {"bodies128", "128 bodies", 1.57e6}};

/// Runs of some 1e5 steps, with and without dense output and events.
struct LongRun {
  const char *name, *title;
  double until;
};
inline constexpr LongRun long_runs[] = {{"pendulum", "pendulum", 3e4},
                                        {"planar_kepler", "two bodies in a plane", 1.7e4}};

class Reporter;

/// Prints the rows that were measured in this run; nothing if none was.
void print_engine(const Reporter& reporter, std::ostream& out);

}  // namespace jetlag::bench
