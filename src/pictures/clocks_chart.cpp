// SPDX-License-Identifier: MIT
// The clocks of a run as a picture: particles upwards, time to the right, steps as colours.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "jetlag/output/clock_table.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "pictures/canvas.hpp"
#include "pictures/film.hpp"

namespace jetlag {

namespace {

constexpr double width = 1200, left = 90, right = 30, above = 100, below = 80;
constexpr std::size_t most_lanes = 100;

/// A step as it is shown: up to the next one that was kept.
struct Bar {
  double begin, end, step;  // [s]
};

/// The bars of each particle that has any, by their number.
std::vector<std::pair<int, std::vector<Bar>>> bars_of(const ClockTable& clocks) {
  std::vector<std::vector<Bar>> bars(clocks.step().size());
  for (const Update& row : clocks.rows()) {
    auto& own = bars[row.particle];
    if (!own.empty()) own.back().end = row.begin;
    own.push_back({row.begin, row.begin + row.step, row.step});
  }
  std::vector<std::pair<int, std::vector<Bar>>> lanes;
  for (std::size_t i = 0; i < bars.size(); ++i)
    if (!bars[i].empty()) lanes.emplace_back(static_cast<int>(i), std::move(bars[i]));
  return lanes;
}

/// Evenly spaced ones, where there are too many.
template <class T>
void choose(std::vector<T>& lanes) {
  if (lanes.size() <= most_lanes) return;
  for (std::size_t i = 0; i < most_lanes; ++i) std::swap(lanes[i], lanes[i * lanes.size() / most_lanes]);
  lanes.resize(most_lanes);
}

/// The colours of steps, from the shortest (warm) to the longest (cool), over a factor of two at least: equal steps that
/// differ by roundings look equal.
class StepColours {
 public:
  explicit StepColours(const std::vector<Update>& rows) {
    for (const Update& row : rows) longest = std::max(longest, row.step);
    shortest = longest / 2;
    for (const Update& row : rows) shortest = std::min(shortest, row.step);
  }
  Colour operator()(double step) const {
    return palette(std::log(longest / step) / std::log(longest / shortest));
  }
  double shortest = 0, longest = 0;
  Palette palette{{colour(0x4477aa), colour(0x9cc5d8), colour(0xf2e3a0), colour(0xf08a4b), colour(0xc0302b)}};
};

/// One lane. Bars of less than two pixels are gathered, the shortest step gives their colour.
void draw_lane(Canvas& canvas, const std::vector<Bar>& bars, const StepColours& colours, double low,
               double high, double unit) {
  const auto box = [&](double from, double to, double step) {
    const double gap = to - from > 6 ? 1.0 : 0.0;  // between steps that can be told apart
    canvas.polygon({{from, low}, {to - gap, low}, {to - gap, high}, {from, high}}, colours(step));
  };
  double from = left + bars.front().begin * unit, shortest = bars.front().step;
  for (const Bar& bar : bars) {
    const double to = left + bar.end * unit;
    shortest = std::min(shortest, bar.step);
    if (to - from < 2.0 && &bar != &bars.back()) continue;
    box(from, to, shortest);
    from = to;
    shortest = std::numeric_limits<double>::infinity();
  }
}

void draw_legend(Canvas& canvas, const StepColours& colours) {
  constexpr int shades = 60;
  constexpr double length = 240, thickness = 12;
  const double x = width - right - length, y = canvas.height() - 44;
  for (int i = 0; i < shades; ++i)
    canvas.polygon({{x + length * i / shades, y},
                    {x + length * (i + 1) / shades, y},
                    {x + length * (i + 1) / shades, y + thickness},
                    {x + length * i / shades, y + thickness}},
                   colours.palette(1 - (i + 0.5) / shades));
  canvas.text({x - 14, y + thickness / 2}, "step", 18, pencil, Canvas::Align::right);
  canvas.text({x, y - 16}, quantity(colours.shortest, "s"), 18, pencil);
  canvas.text({x + length, y - 16}, quantity(colours.longest, "s"), 18, pencil, Canvas::Align::right);
}

}  // namespace

void draw_clocks(const std::filesystem::path& picture, const ClockTable& clocks, double until,
                 const std::string& title) {
  auto lanes = bars_of(clocks);
  choose(lanes);
  const double lane =
      std::clamp(600.0 / static_cast<double>(std::max<std::size_t>(1, lanes.size())), 6.0, 40.0);
  const double height = above + below + lane * static_cast<double>(lanes.size());
  Canvas canvas(width, height);
  canvas.text({left, height - 38}, title, 24, ink);
  const double unit = (width - left - right) / until;
  const StepColours colours(clocks.rows());
  const std::size_t labelled = std::max<std::size_t>(1, (lanes.size() + 11) / 12);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const double low = below + lane * static_cast<double>(i);
    draw_lane(canvas, lanes[i].second, colours, low + 0.06 * lane, low + 0.94 * lane, unit);
    if (i % labelled == 0)
      canvas.text({left - 12, low + lane / 2}, std::to_string(lanes[i].first), 16, pencil,
                  Canvas::Align::right);
  }
  constexpr int tics = 4;
  for (int i = 0; i <= tics; ++i) {
    const double x = left + (width - left - right) * i / tics;
    canvas.line({x, below - 4}, {x, below - 10}, pencil);
    canvas.text({x, below - 24}, quantity(until * i / tics, ""), 16, pencil,
                i == 0      ? Canvas::Align::left
                : i == tics ? Canvas::Align::right
                            : Canvas::Align::center);
  }
  canvas.text({left + (width - left - right) / 2, 22}, "time [s]", 18, ink, Canvas::Align::center);
  canvas.text({left - 12, height - above + 20}, "particle", 16, ink, Canvas::Align::right);
  if (!lanes.empty()) draw_legend(canvas, colours);
  canvas.save(picture);
}

}  // namespace jetlag
