// SPDX-License-Identifier: MIT
#pragma once
// What a scene asks a run to leave behind.

namespace jetlag {

struct OutputOptions {
  int frames = 100;      // besides the first; evenly spaced in time; 0: none are written
  bool energy = true;    // energy.csv, and the energy in the summary
  bool pictures = true;  // through gnuplot, where it is there
  bool clocks = false;   // clocks.csv, clocks.svg, and step and degree in the frames
};

/// The keys of "output" in a scene that are true or false, and what they ask for.
struct OutputKey {
  const char* name;
  bool OutputOptions::* asked;
  const char* what;  // in Markdown
};
inline constexpr OutputKey output_keys[] = {
    {"energy", &OutputOptions::energy, "`energy.csv`, `energy.svg`, and the energy in the summary"},
    {"pictures", &OutputOptions::pictures, "through gnuplot, where it is there"},
    {"clocks", &OutputOptions::clocks,
     "who was updated when: `clocks.csv`, `clocks.svg`, `step` and `degree` in the frames"}};

}  // namespace jetlag
