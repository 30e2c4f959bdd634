// SPDX-License-Identifier: MIT
#include "studies/comparison/work_precision_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "jetlag/base/text.hpp"
#include "pictures/colours.hpp"
#include "pictures/gnuplot.hpp"

namespace jetlag {

namespace {

using CostAndError = std::pair<double, double>;

/// Those that are not beaten, by cost.
std::vector<CostAndError> front(std::vector<CostAndError> points) {
  std::ranges::sort(points);
  std::vector<CostAndError> best;
  for (const CostAndError& point : points)
    if (best.empty() || point.second < best.back().second) best.push_back(point);
  return best;
}

std::string block(const std::vector<CostAndError>& points) {
  std::string text;
  for (const auto& [cost, error] : points) text += number(cost) + ',' + number(error) + '\n';
  return text + "\n\n";
}

// 12 and 11 of them: no family looks like another one of the first 132.
constexpr unsigned colours[] = {0x222222, 0x4477aa, 0xee6677, 0x228833, 0xccbb44, 0x66ccee,
                                0xaa3377, 0xee7733, 0x8a9099, 0x997700, 0x0000cc, 0xcc3311};
constexpr int marks[] = {7, 5, 9, 11, 13, 15, 4, 6, 8, 10, 12};

}  // namespace

void draw_work_precision(const std::filesystem::path& picture, const std::string& title,
                         const std::vector<WorkPrecision>& points, double floor, double ceiling) {
  std::vector<std::string> families;
  for (const auto& point :
       points)  // of those that have something to show: a block without points is none for gnuplot
    if (point.error <= ceiling && std::ranges::find(families, point.family) == families.end())
      families.push_back(point.family);
  std::string data, panels[2];
  int index = 0;
  for (int panel = 0; panel < 2; ++panel)
    for (std::size_t f = 0; f < families.size(); ++f) {
      std::vector<CostAndError> all;
      for (const auto& point : points)
        if (point.family == families[f] && point.error <= ceiling)
          all.emplace_back(panel == 0 ? point.work : point.seconds, std::max(point.error, floor));
      data += block(all) + block(front(all));
      const unsigned code = colours[f % std::size(colours)];
      const int mark = marks[f % std::size(marks)];
      panels[panel] += fmt::format(
          "{}'data.csv' index {} using 1:2 with points pt {} ps 0.25 lc rgb 0x{:06x} notitle, "
          "'' index {} using 1:2 with linespoints pt {} ps 0.7 lw 2 lc rgb 0x{:06x} {}",
          f == 0 ? "" : ", \\\n  ", index, mark, code, index + 1, mark, code,
          panel == 0 ? "title " + gnuplot::quoted(families[f]) : std::string("notitle"));
      index += 2;
    }
  const auto text = [](const char* what, const std::string& words) {
    return fmt::format("set {} {} textcolor rgb 0x{:06x} noenhanced\n", what, gnuplot::quoted(words),
                       ink.code());
  };
  const std::string commands =
      "set datafile separator comma\nset logscale xy\nset format xy '10^{%T}'\n" +
      fmt::format(
          "set border 3 linecolor rgb 0x{0:06x}\nset tics nomirror textcolor rgb 0x{0:06x}\n"
          "set grid linecolor rgb 0xe6e9ed linewidth 1 linetype 1\nset key textcolor rgb 0x{1:06x} "
          "noenhanced\n",
          pencil.code(), ink.code()) +
      "set label " + gnuplot::quoted(title) +
      fmt::format(" at screen 0.02, screen 0.95 font ',22' textcolor rgb 0x{:06x} noenhanced\n", ink.code()) +
      "set multiplot\nset tmargin at screen 0.88\nset bmargin at screen 0.13\n"
      "set lmargin at screen 0.08\nset rmargin at screen 0.405\nset key at screen 0.995, screen 0.88 right "
      "top "
      "vertical maxcols 1 width -2" +
      (families.size() > 14 ? std::string(" font ',12' spacing 0.95\n") : std::string("\n")) +
      text("xlabel", "element coefficients") + text("ylabel", "position error [m]") + "plot " + panels[0] +
      "\nunset label\nunset key\nset lmargin at screen 0.455\nset rmargin at screen 0.78\nset ylabel ''\n" +
      text("xlabel", "processor time [s]") + "plot " + panels[1] + "\nunset multiplot\n";
  gnuplot::draw(picture, {1400, 620, 16}, commands, data);
}

}  // namespace jetlag
