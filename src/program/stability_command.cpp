// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/result_folder.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/truncation/poisson.hpp"
#include "jetlag/truncation/stability.hpp"
#include "pictures/colours.hpp"
#include "pictures/gnuplot.hpp"
#include "program/commands.hpp"

namespace jetlag {

namespace {

struct StabilityArguments {
  int min = 3, max = 6;
  double probability = 0.5, mean = 1.0;
  std::vector<double> tail;
  std::string law = "geometric", velocity = "own_series";
  std::filesystem::path folder = "out/stability";
  struct {
    bool min = false, max = false, probability = false, mean = false, tail = false;
  } given;
};

struct Question {
  Growth growth;
  const char *column, *what;
};
constexpr std::array questions = {
    Question{Growth::of_mean, "mean", "T_N, the mean of many runs"},
    Question{Growth::mean_square, "mean_square", "mean square, independent draws"},
    Question{Growth::almost_sure, "almost_sure", "almost sure, and the ruler"}};

/// Options that say nothing of the law that is asked for must be left out.
void require_options_of_law(const StabilityArguments& arguments) {
  const auto& given = arguments.given;
  const bool tail = arguments.law == "tail";
  for (const auto& [option, stray] : {std::pair("--min", given.min && tail),
                                      {"--max", given.max && tail},
                                      {"--probability", given.probability && arguments.law != "geometric"},
                                      {"--mean", given.mean && arguments.law != "poisson"},
                                      {"--tail", given.tail && !tail}})
    if (stray) throw SceneError(fmt::format("{}: must be left out with --law {}", option, arguments.law));
}

TruncationLaw law_of(const StabilityArguments& arguments) {
  if (arguments.law == "tail") {
    if (arguments.tail.empty())
      throw SceneError("--tail: must be given with --law tail: P(K >= 0), P(K >= 1), ...");
    try {
      return {"tail", arguments.tail};
    } catch (const std::invalid_argument& error) {
      throw SceneError(fmt::format("--tail: got {}; must be P(K >= 0) = 1, P(K >= 1), ... ({})",
                                   fmt::join(arguments.tail, ","), error.what()));
    }
  }
  if (arguments.max < arguments.min)
    throw SceneError(fmt::format("--max: got {}; must be at least --min = {}", arguments.max, arguments.min));
  if (arguments.law == "poisson") {
    try {
      return poisson(arguments.min, arguments.max, arguments.mean);
    } catch (const std::invalid_argument& error) {
      throw SceneError(fmt::format("--mean: got {}; must be > 0 ({})", arguments.mean, error.what()));
    }
  }
  try {
    return geometric(arguments.min, arguments.max, arguments.probability);
  } catch (const std::invalid_argument& error) {
    throw SceneError(
        fmt::format("--probability: got {}; must be a number from 0 to 1, below 1 unless --max = --min ({})",
                    arguments.probability, error.what()));
  }
}

/// The growth of the pair of eigenvalues z, conj z.
double growth_at(const TruncationLaw& law, Growth of, VelocitySeries velocity, std::complex<double> z) {
  if (velocity == VelocitySeries::own_series || std::abs(z) == 0) return growth(law, of, z);
  return growth(law, of, velocity, {std::abs(z), -2 * z.real()}, 1.0);
}

/// Rows of equal real part: real, imaginary, and the growths that are known. Over [-reach, 0.25 reach] x [-reach, reach];
/// with `derivative`, an oscillator has no eigenvalue to the right of 0.
struct Map {
  std::string csv, grid;  // the grid has an empty line after each row, for gnuplot

  Map(const TruncationLaw& law, VelocitySeries velocity, const std::vector<Question>& known, double reach) {
    constexpr int half = 100;
    csv = "real,imaginary";
    for (const Question& question : known) csv += fmt::format(",{}", question.column);
    csv += '\n';
    const int right = velocity == VelocitySeries::own_series ? half / 4 : 0;
    for (int column = -half; column <= right; ++column) {
      std::vector<std::string> above;
      for (int row = 0; row <= half; ++row) {  // below is the same
        const std::complex<double> z(reach * column / half, reach * row / half);
        std::string growths;
        for (const Question& question : known)
          growths += ',' + number(std::clamp(growth_at(law, question.growth, velocity, z), -10.0, 10.0));
        above.push_back(growths);
      }
      std::string lines;
      for (int row = -half; row <= half; ++row)
        lines +=
            number(reach * column / half) + ',' + number(reach * row / half) + above[std::abs(row)] + '\n';
      csv += lines;
      grid += lines + '\n';
    }
  }
};

void draw(const std::filesystem::path& picture, const std::string& title, const std::vector<Question>& known,
          const Map& map, double reach) {
  std::string commands = fmt::format(
      "set datafile separator comma\nset contour base\nset cntrparam levels discrete 0\nunset surface\n"
      "set border linecolor rgb 0x{0:06x}\nset tics nomirror out textcolor rgb 0x{0:06x}\n"
      "set grid linecolor rgb 0xe6e9ed linewidth 1 linetype 1\n"
      "set key at screen 0.72, screen 0.11 right top vertical textcolor rgb 0x{1:06x} noenhanced\n"
      "set bmargin at screen 0.2\nset tmargin at screen 0.93\n"
      "set title {2} font ',20' textcolor rgb 0x{1:06x} noenhanced\n"
      "set xlabel 'real part of z = lambda h' textcolor rgb 0x{1:06x}\n"
      "set ylabel 'imaginary part' textcolor rgb 0x{1:06x}\n",
      pencil.code(), ink.code(), gnuplot::quoted(title));
  for (std::size_t i = 0; i < known.size(); ++i)
    commands += fmt::format("set table $edge{0}\nsplot 'data.csv' using 1:2:{1}\nunset table\n", i, 3 + i);
  commands += fmt::format(
      "set datafile separator whitespace\nset size ratio -1\nset xrange [{}:{}]\nset yrange [{}:{}]\n"
      "set xzeroaxis linecolor rgb 0x{:06x} linetype 1\nset yzeroaxis linecolor rgb 0x{:06x} linetype "
      "1\nplot ",
      -reach, 0.25 * reach, -reach, reach, pencil.code(), pencil.code());
  for (std::size_t i = 0; i < known.size(); ++i)
    commands += fmt::format("{}$edge{} using 1:2 with lines linewidth 3 linecolor rgb 0x{:06x} title {}",
                            i == 0 ? "" : ", ", i, body_colour(i).code(), gnuplot::quoted(known[i].what));
  gnuplot::draw(picture, {900, 1040, 18}, commands, map.grid);
}

int run(const StabilityArguments& arguments) {
  require_options_of_law(arguments);
  const TruncationLaw law = law_of(arguments);
  const bool own = arguments.velocity == "own_series";
  const VelocitySeries velocity = own ? VelocitySeries::own_series : VelocitySeries::derivative;
  const std::string title =
      fmt::format("{}, degrees {} to {}{}, velocity {}", arguments.law, law.min_degree(), law.max_degree(),
                  arguments.law == "geometric" ? fmt::format(", p = {}", arguments.probability)
                  : arguments.law == "poisson" ? fmt::format(", mean {}", arguments.mean)
                                               : std::string(),
                  arguments.velocity);
  std::printf("%s; mean degree %.6g\n", title.c_str(), law.mean());
  std::printf("the largest %s up to which nothing grows:\n", own ? "|lambda| h" : "omega h");
  std::printf("  %-32s %16s %16s\n", "", own ? "real axis" : "critical damping",
              own ? "imaginary axis" : "no damping");
  std::vector<Question> known;
  double reach = 0;
  for (const Question& question : questions) {
    if (!own && question.growth == Growth::almost_sure && !law.is_fixed()) {
      std::printf("  %-32s %16s %16s\n", question.what, "not known", "not known");
      continue;
    }
    const auto limit = [&](double damping) {
      return stability_limit(law, question.growth, velocity, {1.0, damping});
    };
    const double real = own ? stability_limit(law, question.growth, -1.0) : limit(2.0),
                 imaginary = limit(0.0);
    std::printf("  %-32s %16.9f %16.9f\n", question.what, real, imaginary);
    reach = std::max({reach, real, imaginary});
    known.push_back(question);
  }
  std::printf("0: grows at every step, however short\n");

  reach = std::ceil(2.4 * reach + 1) / 2;
  const Map map(law, velocity, known, reach);
  const ResultFolder held(arguments.folder);
  const std::filesystem::path csv = arguments.folder / "stability.csv",
                              picture = arguments.folder / "stability.svg";
  write_file(csv, map.csv);
  std::printf("%s\n", shown_name(csv.string()).c_str());
  if (gnuplot::program().empty()) {
    std::printf("no picture: gnuplot is not in PATH\n");
    return 0;
  }
  draw(picture, title, known, map, reach);
  std::printf("%s\n", shown_name(picture.string()).c_str());
  return 0;
}

}  // namespace

Command stability_command() {
  return command<StabilityArguments>(
      "stability", "where series of a random degree are stable: limits and a picture", run,
      [](StabilityArguments& a) -> std::vector<Option> {
        const auto watched = [](Option option, bool& given) {
          option.given = &given;
          return option;
        };
        return {watched({"--min", &a.min, "the smallest degree", Between{1, 256}}, a.given.min),
                watched({"--max", &a.max, "the largest degree", Between{1, 256}}, a.given.max),
                watched({"--probability", &a.probability, "of stopping at each degree", Between{0, 1}},
                        a.given.probability),
                {"--law", &a.law, "of the degree", OneOf{"geometric", "poisson", "tail"}},
                watched({"--mean", &a.mean, "with poisson: of the degrees beyond --min"}, a.given.mean),
                watched({"--tail", &a.tail, "with tail: P(K >= 0), P(K >= 1), ..."}, a.given.tail),
                {"--velocity", &a.velocity, "its series", OneOf{"own_series", "derivative"}},
                {"--out", &a.folder, "folder for stability.csv and stability.svg"}};
      });
}

}  // namespace jetlag
