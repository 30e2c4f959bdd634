// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/result_folder.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"
#include "pictures/film.hpp"
#include "pictures/gnuplot.hpp"
#include "pictures/support.hpp"
#include "scenes/reader.hpp"
#include "studies/paper/struck_body.hpp"
#include "studies/studies.hpp"

namespace jetlag {

namespace paper_figures {  // batches compile studies together
namespace {

struct Arguments {
  std::string mesh;
  std::filesystem::path folder = "out/paper_figures";
  int members = 40;
  double ellipse_step = 0.0025, step = 0.003, until = 12.0;
};

// ---- figure 1 --------------------------------------------------------------------------------------------

/// The scene "ellipse" of one seed, at five times.
std::vector<Frame> ellipse_frames(const std::string& seed, const Arguments& arguments, bool expected) {
  std::vector<std::string> settings = {"until=2", "output.frames=4", "output.energy=false",
                                       "control.step=" + number(arguments.ellipse_step), "seed=" + seed};
  if (expected)
    settings = {"until=2", "output.frames=4", R"(integrator={"type": "taylor", "degree": 20})",
                R"(control={"type": "jorba_zou"})"};
  std::vector<Frame> frames;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const RunResult result = run_scene(load_scene("ellipse", settings), hooks);
  if (result.summary.outcome != Outcome::success) frames.clear();
  return frames;
}

/// 1, 2 or 5 times a power of ten, at most x and at least 1.
double round_number(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  return std::max(1.0, power * (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1));
}

/// The points of all members in one panel a time, the springs of the exact motion above them. What separates the points
/// from the exact motion is enlarged so that at the end the spread is a quarter of a spring.
void draw_spread(const std::filesystem::path& picture, const Shape& shape,
                 const std::vector<std::vector<Frame>>& members, const std::vector<Frame>& exact,
                 double last_spread) {
  double length = 0;
  for (const auto& [a, b] : shape.lines)
    length += (exact[0].position.row(a) - exact[0].position.row(b)).norm() /
              static_cast<double>(shape.lines.size());
  const double enlarged = round_number(0.25 * length / last_spread);
  const Camera camera(shape);
  Window window;
  std::vector<double> times;
  for (std::size_t f = 1; f < exact.size(); ++f) {
    times.push_back(exact[f].time);
    for (const auto& point : camera.all(exact[f].position)) window.include(point);
  }
  Strip strip(
      fmt::format("points: all members, their errors {} times enlarged; lines: the exact motion", enlarged),
      window, times);
  const Support support(shape, exact.front());
  for (std::size_t panel = 0; panel < times.size(); ++panel) {
    const auto place = [&](const Eigen::Vector3d& point) { return strip.place(panel, point); };
    support.draw(strip, panel, camera);
    for (const auto& frames : members)
      for (const auto& point : camera.all(exact[panel + 1].position + enlarged * (frames[panel + 1].position -
                                                                                  exact[panel + 1].position)))
        strip.canvas.dot(place(point), 1.0, colour(0xee6677));
    const auto points = camera.all(exact[panel + 1].position);
    for (const auto& [a, b] : shape.lines)
      strip.canvas.line(place(points[static_cast<std::size_t>(a)]),
                        place(points[static_cast<std::size_t>(b)]), mixed(ink, white, 0.35), 0.8);
  }
  strip.canvas.save(picture);
}

void figure_1(const Arguments& arguments) {
  const Scene scene = load_scene("ellipse");
  const std::vector<Frame> exact = ellipse_frames("1", arguments, true);
  std::vector<std::vector<Frame>> members;
  int failed = 0;
  for (int seed = 1; seed <= arguments.members; ++seed) {
    members.push_back(ellipse_frames(std::to_string(seed), arguments, false));
    if (members.back().empty()) {
      members.pop_back();
      ++failed;
    }
  }
  fmt::print("figure 1: the ellipse, a degree for each particle (3,6,.5), step {} s, {} members, {} failed\n",
             arguments.ellipse_step, arguments.members, failed);
  fmt::print("{:>8} {:>16} {:>22} {:>22}\n", "time [s]", "spread [m]", "mean - exact [m]",
             "spread / sqrt(members)");
  if (members.size() < 2) {
    fmt::print("too few are left for a spread: take a shorter --ellipse-step\n");
    return;
  }
  std::string csv = "time,spread,error_of_the_mean\n";
  double last_spread = 0;
  for (std::size_t f = 1; f < exact.size(); ++f) {
    const auto n = static_cast<double>(members.size());
    Coordinates<double> mean = Coordinates<double>::Zero(exact[f].position.rows(), 2), squares = mean;
    for (const auto& frames : members) mean += frames[f].position / n;
    for (const auto& frames : members) squares += (frames[f].position - mean).cwiseAbs2();
    const double points = static_cast<double>(mean.rows()),
                 spread = std::sqrt(squares.sum() / std::max(1.0, n - 1) / points),
                 bias = std::sqrt((mean - exact[f].position).squaredNorm() / points);
    fmt::print("{:>8.3g} {:>16.3g} {:>22.3g} {:>22.3g}\n", exact[f].time, spread, bias,
               spread / std::sqrt(n));
    last_spread = spread;
    csv += number(exact[f].time) + ',' + number(spread) + ',' + number(bias) + '\n';
  }
  write_file(arguments.folder / "figure1.csv", csv);
  if (can_draw() && last_spread > 0)
    draw_spread(arguments.folder / "figure1.png", scene.shape, members, exact, last_spread);
}

// ---- figures 2 and 3 -------------------------------------------------------------------------------------

struct Curve {
  std::string name;
  std::vector<EnergyRow> energies;
};

/// The body at rest, without gravity, struck: all velocities normal with deviation 1 m/s.
Scene body_scene(int min_degree, int max_degree, double friction, const Arguments& arguments) {
  const Json scene = {{"dimension", 3},
                      {"particles", struck_body(arguments.mesh)},
                      {"forces",
                       {{{"type", "spring"}, {"pairs", "edges"}, {"stiffness", 5000.0}},
                        {{"type", "drag"}, {"coefficient", friction}}}},
                      {"integrator",
                       {{"type", "random_taylor"},
                        {"min_degree", min_degree},
                        {"max_degree", max_degree},
                        {"probability", 0.5}}},
                      {"control", {{"type", "fixed"}, {"step", arguments.step}}},
                      {"until", arguments.until},
                      {"output", {{"frames", 240}, {"pictures", false}}}};
  return read_scene(scene.dump(), "paper figures", ".");
}

Curve energies(int min_degree, int max_degree, double friction, const Arguments& arguments) {
  const RunResult result = run_scene(body_scene(min_degree, max_degree, friction, arguments));
  const double initial = result.energies.front().energy.total(), last = result.energies.back().energy.total();
  fmt::print("  ({},{},.5), friction {:<4g}  E/E0 at the end {:>10.4g}   rate {:>+8.3f} /s   {}\n",
             min_degree, max_degree, friction, last / initial,
             std::log(last / initial) / result.energies.back().time, to_string(result.summary.outcome));
  return {fmt::format("({},{},.5), friction {:g}", min_degree, max_degree, friction), result.energies};
}

void draw_curves(const std::filesystem::path& folder, const char* name, const char* title,
                 const std::vector<Curve>& curves, bool logarithmic) {
  std::string csv = "time", data, plots;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    csv += ",\"" + curves[c].name + '"';
    constexpr unsigned colours[] = {0x4477aa, 0xee6677, 0x228833, 0xaa3377};
    plots += fmt::format("{}'data.csv' using 1:{} with lines lw 2.5 lc rgb 0x{:06x} title {}",
                         c == 0 ? "" : ", ", c + 2, colours[c % 4], gnuplot::quoted(curves[c].name));
  }
  std::size_t rows = 0;
  for (const Curve& curve : curves) rows = std::max(rows, curve.energies.size());
  for (std::size_t r = 0; r < rows; ++r) {
    std::string line;
    double time = 0;
    for (const Curve& curve : curves) {
      line += ',';
      if (r >= curve.energies.size()) continue;
      time = curve.energies[r].time;
      line += number(curve.energies[r].energy.total() / curve.energies.front().energy.total());
    }
    data += number(time) + line + '\n';
  }
  write_file(folder / (std::string(name) + ".csv"), csv + '\n' + data);
  if (!can_draw()) return;
  gnuplot::draw(
      folder / (std::string(name) + ".svg"), {1000, 520, 18},
      std::string("set datafile separator comma\nset border 3\nset tics nomirror\nset grid\n") +
          (logarithmic ? "set logscale y\nset format y '10^{%T}'\n" : "") + "set title " +
          gnuplot::quoted(title) +
          " noenhanced\nset xlabel 'time [s]'\nset ylabel 'energy / initial energy'\nset key noenhanced\n"
          "set yrange [" +
          (logarithmic ? "1e-16" : "0") + ":*]\nplot " + plots,
      data);
}

int run_figures(const Arguments& arguments) {
  for (const auto& [option, value] : {std::pair("--step", arguments.step),
                                      {"--until", arguments.until},
                                      {"--ellipse-step", arguments.ellipse_step}})
    if (!std::isfinite(value))
      throw SceneError(fmt::format("{}: got {}; must be a finite number > 0", option, value));
  body_scene(4, 16, 0.0, arguments);  // refuses a mesh before anything is written
  const ResultFolder held(arguments.folder);
  figure_1(arguments);
  const std::string body = arguments.mesh.empty() ? "generated body" : arguments.mesh;
  fmt::print("figure 2: energy of the {}, step {} s\n", body, arguments.step);
  draw_curves(arguments.folder, "figure2", "figure 2: min = 4, max = 16, p = .5",
              {energies(4, 16, 0.0, arguments), energies(4, 16, 0.2, arguments)}, false);
  fmt::print("figure 3: energy of the {}, step {} s\n", body, arguments.step);
  draw_curves(arguments.folder, "figure3", "figure 3: air friction 3 against 30",
              {energies(4, 16, 3.0, arguments), energies(4, 16, 30.0, arguments)}, true);
  fmt::print("pictures and tables are in {}{}\n", arguments.folder.string(),
             can_draw() ? "" : " (no pictures: gnuplot is not in PATH)");
  return 0;
}

}  // namespace
}  // namespace paper_figures

Command paper_figures_study() {
  using namespace paper_figures;
  return command<Arguments>("paper_figures", "the paper's figures 1 to 3, with numbers", run_figures,
                            [](Arguments& a) -> std::vector<Option> {
                              return {{"--mesh", &a.mesh, "a Medit mesh in place of the generated body"},
                                      {"--members", &a.members, "members of figure 1", Between{2, 10'000}},
                                      {"--ellipse-step", &a.ellipse_step, "step of figure 1 [s]", Positive{}},
                                      {"--step", &a.step, "step of figures 2 and 3 [s]", Positive{}},
                                      {"--until", &a.until, "end of figures 2 and 3 [s]", Positive{}},
                                      {"--out", &a.folder, "folder for tables and pictures"}};
                            });
}

}  // namespace jetlag
