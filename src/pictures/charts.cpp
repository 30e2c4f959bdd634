// SPDX-License-Identifier: MIT
// Charts with axes: the energy of a run, and motions along a line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "pictures/axes.hpp"
#include "pictures/film.hpp"
#include "pictures/gnuplot.hpp"

namespace jetlag {

namespace axes {

const std::string style = fmt::format(
    "set datafile separator comma\n"
    "set border 3 linecolor rgb 0x{0:06x} linewidth 1\n"
    "set tics nomirror out textcolor rgb 0x{0:06x}\n"
    "set grid ytics linecolor rgb 0xe6e9ed linewidth 1 linetype 1\n"
    "set key textcolor rgb 0x{1:06x} noenhanced\n",
    pencil.code(), ink.code());

std::string label(const std::string& what, const std::string& text) {
  return fmt::format("set {} {} textcolor rgb 0x{:06x} noenhanced\n", what, gnuplot::quoted(text),
                     ink.code());
}

std::string heading(const std::string& title) {
  return fmt::format(
      "set label {} at screen 0.02, screen 0.94 font ',24' textcolor rgb 0x{:06x} noenhanced\n",
      gnuplot::quoted(title), ink.code());
}

}  // namespace axes

using axes::heading, axes::label, axes::style;

namespace {

/// One curve of data.csv.
std::string curve(int column, const std::string& title, const Colour& colour, double thickness) {
  return fmt::format("'data.csv' using 1:{} with lines linewidth {} linecolor rgb 0x{:06x} title {}", column,
                     thickness, colour.code(), gnuplot::quoted(title));
}

/// From the least to the largest number in the last column of a table, and 0. Fields may be empty: where the
/// energy starts from 0 it has no relative error, and a table without any has no range.
std::optional<double> range_of_last_column(const std::string& table) {
  double least = 0, largest = 0;
  bool found = false;
  for (std::size_t end = table.find('\n'); (end = table.find('\n', end + 1)) != std::string::npos;) {
    const std::size_t start = table.rfind(',', end) + 1;
    if (start == end) continue;
    const double value = std::strtod(table.c_str() + start, nullptr);
    least = std::min(least, value);
    largest = std::max(largest, value);
    found = true;
  }
  if (!found) return {};
  return largest - least;
}

/// Not more than five steps of 1, 2 or 5 times a power of ten.
std::string steps(double range) {
  if (!(range > 0.0 && std::isfinite(range))) return "set ytics autofreq\n";
  const double power = std::pow(10.0, std::floor(std::log10(range / 5)));
  const double share = range / 5 / power;
  return "set ytics " + number(power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10)) + "\n";
}

}  // namespace

void draw_energy(const std::filesystem::path& csv, const std::filesystem::path& picture,
                 const std::string& title) {
  const std::string table = read_file(csv);
  const std::optional<double> errors = range_of_last_column(table);
  const std::string time_axis =
      "set bmargin at screen 0.15\nset format x '%g'\n" + label("xlabel", "time [s]");
  std::string commands =
      style + heading(title) +
      "set multiplot\nset key at screen 0.98, screen 0.89 right horizontal\n"
      "set lmargin at screen 0.14\nset rmargin at screen 0.97\nset tmargin at screen 0.83\n" +
      (errors ? "set bmargin at screen 0.46\nset format x ''\n" : time_axis) + label("ylabel", "energy [J]") +
      "plot " + curve(2, "kinetic", colour(0xef9050), 2) + ", " + curve(3, "potential", colour(0x4477aa), 2) +
      ", " + curve(4, "total", ink, 2.5) + "\n";
  if (errors)
    commands += "unset label\nunset key\nset tmargin at screen 0.39\nset format y '%.3g'\n" + time_axis +
                steps(*errors) + label("ylabel", "relative error") + "plot " +
                curve(5, "", colour(0xd94a3d), 2) + "\n";
  gnuplot::draw(picture, {1000, 680, 18}, commands + "unset multiplot\n", table);
}

void draw_lines(const std::filesystem::path& picture, const Shape& shape, const std::vector<Frame>& frames,
                const std::string& title) {
  std::string table;
  for (const Frame& frame : frames) {
    table += number(frame.time);
    for (int i = 0; i < shape.particles; ++i) table += ',' + number(frame.position(i, 0));
    table += '\n';
  }
  constexpr int few = 6;
  const Palette palette{
      {colour(0x4477aa), colour(0x66a5ad), colour(0xccbb44), colour(0xee6677), colour(0xaa3377)}};
  std::string curves;
  for (int i = 0; i < shape.particles; ++i) {
    const Colour own = shape.particles <= few ? body_colour(static_cast<std::size_t>(i))
                                              : palette(double(i) / (shape.particles - 1));
    curves += (i == 0 ? "" : ", \\\n  ") + curve(i + 2, "", own, shape.particles <= few ? 2.5 : 1.6);
  }
  const std::string commands = style + heading(title) + "unset key\nset tmargin at screen 0.86\n" +
                               label("xlabel", "time [s]") + label("ylabel", "position [m]") +
                               "set autoscale fix\nset offsets graph 0, 0, 0.04, 0.04\nplot " + curves;
  gnuplot::draw(picture, {1200, 620, 20}, commands, table);
}

}  // namespace jetlag
