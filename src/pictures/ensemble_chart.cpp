// SPDX-License-Identifier: MIT
// An ensemble as a picture: a band about the truth, and whether its width is honest.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "jetlag/base/text.hpp"
#include "jetlag/output/ensemble_table.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "pictures/axes.hpp"
#include "pictures/gnuplot.hpp"

namespace jetlag {

namespace {

/// Whether the band is too narrow to be seen beside the motion, and all times have a reference to measure it from.
bool is_narrow(const EnsembleResult& result, std::size_t watched) {
  double width = 0, least = INFINITY, most = -INFINITY;
  for (const EnsembleFrame& frame : result.frames) {
    const double reference = frame.reference[watched];
    if (!std::isfinite(reference)) return false;
    const auto& q = frame.samples[watched].quantiles;
    width = std::max(width, q.back() - q.front());
    least = std::min(least, reference);
    most = std::max(most, reference);
  }
  return width < (most - least) / 50;
}

std::string plotted(double value) { return std::isfinite(value) ? number(value) : "NaN"; }
/// For logarithmic axes.
std::string positive(double value) { return value > 0 ? plotted(value) : "NaN"; }

std::string line(int column, const std::string& title, const Colour& colour, double width,
                 const std::string& dash = "") {
  return fmt::format("'data.csv' using 1:{} with lines linewidth {} {} linecolor rgb 0x{:06x} title {}",
                     column, width, dash, colour.code(), gnuplot::quoted(title));
}
std::string band(int low, int high, const std::string& title, const Colour& colour) {
  return fmt::format("'data.csv' using 1:{}:{} with filledcurves linecolor rgb 0x{:06x} title {}", low, high,
                     colour.code(), gnuplot::quoted(title));
}

}  // namespace

void draw_ensemble(const std::filesystem::path& picture, const EnsembleResult& result, std::size_t watched,
                   const std::string& title) {
  const bool narrow = is_narrow(result, watched);
  std::string table;
  bool reference = false, errors = false, deterministic = false;
  for (const EnsembleFrame& frame : result.frames) {
    const double truth = frame.reference[watched], origin = narrow ? truth : 0.0;
    table += plotted(frame.time);
    for (const double quantile : frame.samples[watched].quantiles) table += ',' + plotted(quantile - origin);
    table += ',' + plotted(truth - origin);
    const Calibration& c = frame.calibration;
    for (const double value : {c.spread, c.mean_error, c.deterministic_error}) table += ',' + positive(value);
    table += '\n';
    reference |= std::isfinite(truth);
    errors |= c.mean_error > 0;
    deterministic |= c.deterministic_error > 0;
  }
  const Quantity& quantity = result.quantities[watched];
  const std::string name = quantity.particle < 0
                               ? "energy"
                               : fmt::format("{} of particle {}", name_of(quantity), quantity.particle);
  const std::string unit = quantity.particle < 0 ? "[J]" : quantity.of_velocity ? "[m/s]" : "[m]";
  const Colour blue = colour(0x4477aa), red = colour(0xd94a3d);
  std::string commands =
      axes::style + axes::heading(fmt::format("{}: {} members", title, result.members)) +
      "set style fill solid noborder\nset multiplot\nset autoscale fix\n"
      "set lmargin at screen 0.14\nset rmargin at screen 0.97\n"
      "set zero 0\nset key at screen 0.98, screen 0.89 right vertical maxrows 1 samplen 2\n"
      "set tmargin at screen 0.83\nset bmargin at screen 0.49\nset format x ''\nset format y '%g'\n"
      "set offsets graph 0, graph 0, graph 0.05, graph 0.05\n" +
      axes::label("ylabel", narrow ? fmt::format("{} - reference {}", name, unit) : name + " " + unit) +
      "plot " + band(2, 6, "5 to 95 %", mixed(blue, white, 0.75)) + ", " +
      band(3, 5, "25 to 75 %", mixed(blue, white, 0.45)) + ", " + line(4, "median", blue, 2);
  if (reference) commands += ", " + line(7, "reference", ink, 1.5, "dashtype 2");
  commands +=
      "\nunset label\nset offsets 0, 0, 0, 0\nset key at screen 0.98, screen 0.45 right horizontal samplen "
      "2\n"
      "set tmargin at screen 0.39\nset bmargin at screen 0.14\nset format x '%g'\nset format y '%.0e'\nunset "
      "mytics\n" +
      axes::label("xlabel", "time [s]") + axes::label("ylabel", "RMS over positions [m]");
  const bool any = std::ranges::any_of(result.frames, [](const auto& f) { return f.calibration.spread > 0; });
  if (!any) {
    commands += "set yrange [0:1]\nset format y ''\n" +
                fmt::format("set label 'no spread' at graph 0.5, graph 0.5 center textcolor rgb 0x{:06x}\n",
                            ink.code()) +
                "plot NaN notitle\n";
  } else {
    commands += "set logscale y\nplot " + line(8, "spread", blue, 2.5);
    if (errors) commands += ", " + line(9, "error of mean", ink, 2);
    if (deterministic)
      commands += ", " + line(10, fmt::format("error, degree {}", result.deterministic_degree), red, 2);
    commands += '\n';
  }
  gnuplot::draw(picture, {1000, 720, 18}, commands + "unset multiplot\n", table);
}

}  // namespace jetlag
