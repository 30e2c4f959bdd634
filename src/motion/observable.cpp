// SPDX-License-Identifier: MIT
#include "jetlag/motion/observable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "jetlag/base/rounded_time.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/roots.hpp"

namespace jetlag {

namespace {

double entry(const Coordinates<double>& rows, const Input& input) {
  return rows(input.participant, input.component);
}

int sign(double x) { return (x > 0) - (x < 0); }

/// |c_k| h^k, and their sum.
struct Terms {
  Terms(const std::vector<double>& c, double h) {
    double power = 1;
    for (const double x : c) {
      term.push_back(std::abs(x) * power);
      sum += term.back();
      power *= h;
    }
  }
  /// Whether the last two are below rounding; two, because one may vanish by symmetry.
  bool converge() const {
    const std::size_t n = term.size() - 1;
    return n == 0 || term[n] + term[n - 1] <= std::numeric_limits<double>::epsilon() * sum;
  }
  std::vector<double> term;
  double sum = 0;
};

}  // namespace

void Observable::require_fit(const std::string& who, int particles, int dimension) const {
  for (const Node& node : tape_.nodes) {
    if (node.kind != Node::Kind::input || node.input.kind == Input::Kind::time) continue;
    const Input::Kind kind = node.input.kind;
    const int particle = node.input.participant, component = node.input.component;
    if (particle < 0 || particle >= particles || component < 0 || component >= dimension)
      throw std::invalid_argument(who + " reads " + (kind == Input::Kind::position ? "x(" : "v(") +
                                  std::to_string(particle) + ", " + std::to_string(component) +
                                  "), but there are " + std::to_string(particles) + " particles in " +
                                  std::to_string(dimension) + " dimensions");
  }
}

ObservableSeries::ObservableSeries(const Observable& g)
    : blocks_(Program(g.tape()), 1, {}, scalar_kernels<double>()) {
  blocks_.reserve(1);
}

double ObservableSeries::coefficient(int k) {
  const Place place = blocks_.program().outputs[0];
  return k > 0 && place.space == Place::Space::statics ? 0.0 : *blocks_.at(0, place, k);
}

double ObservableSeries::operator()(const State<double>& state) {
  for (const auto& [place, input] : blocks_.program().inputs)
    *blocks_.at(0, place, 0) = input.kind == Input::Kind::time       ? state.time
                               : input.kind == Input::Kind::position ? entry(state.position, input)
                                                                     : entry(state.velocity, input);
  blocks_.run(0, 0);
  return coefficient(0);
}

std::vector<LocalSeries> ObservableSeries::along(const Piece& piece) {
  if (piece.unit != 1)
    throw std::invalid_argument(
        "an observable is followed in seconds, in which the coefficients of this motion over- or underflow: "
        "measure "
        "its time in another unit");
  Rows rows;
  for (const auto& [place, input] : blocks_.program().inputs) {
    std::vector<double>& row = rows.emplace_back();
    if (input.kind == Input::Kind::time)
      row = {piece.begin, 1.0};
    else
      for (const auto& coefficient : input.kind == Input::Kind::position ? piece.position : piece.velocity)
        row.push_back(entry(coefficient, input));
  }
  std::vector<LocalSeries> all;
  append(std::move(rows), piece.begin, piece.end, 0, all);
  return all;
}

void ObservableSeries::append(Rows rows, double begin, double end, int halvings,
                              std::vector<LocalSeries>& all) {
  const Program& program = blocks_.program();
  std::size_t known = 1;
  for (const auto& row : rows) known = std::max(known, row.size());
  const bool linear = program.histories == 0;
  const int size = static_cast<int>(program.is_static ? 1
                                    : linear          ? known
                                                      : std::max(2 * known - 1, std::size_t{41}));
  blocks_.reserve(size);
  LocalSeries series{begin, end, {}};
  for (int k = 0; k < size; ++k) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      *blocks_.at(0, program.inputs[i].place, k) = k < static_cast<int>(rows[i].size()) ? rows[i][k] : 0.0;
    blocks_.run(0, k);
    series.c.push_back(coefficient(k));
  }

  // Near a singularity the last coefficients overflow: those before serve, on an interval that is short enough.
  const auto infinite = std::ranges::find_if(series.c, [](double x) { return !std::isfinite(x); });
  const auto finite = static_cast<std::size_t>(infinite - series.c.begin());
  const bool exists = finite == series.c.size() || finite > 2;
  if (exists) series.c.resize(finite);
  const Terms terms(series.c, end - begin);
  const double middle = begin + 0.5 * (end - begin);
  constexpr int most_halvings = 30;
  if (!linear && exists && !terms.converge() && halvings < most_halvings && begin < middle && middle < end) {
    Rows later = rows;
    for (auto& row : later) taylor_shift(row, middle - begin);
    append(std::move(rows), begin, middle, halvings + 1, all);
    append(std::move(later), middle, end, halvings + 1, all);
    return;
  }
  while (series.c.size() > 1 && terms.term[series.c.size() - 1] < 0x1p-60 * terms.sum) series.c.pop_back();
  all.push_back(std::move(series));
}

double LocalSeries::at(double t) const { return accurate_value(c, time_between(begin, t)); }

bool LocalSeries::is_finite() const { return std::isfinite(rounding_of(c, 2 * (end - begin))); }

std::vector<Crossing> crossings(std::span<LocalSeries> series) {
  std::vector<Crossing> found;
  std::optional<double> before;  // the value at the end of the series before
  for (auto& [begin, end, c] : series) {
    if (before && sign(*before) != sign(c[0])) c[0] = *before;
    const double h = time_between(begin, end);
    if (h > 0)
      for (const auto& [s, rising] : sign_changes(c, h)) found.push_back({time_after(begin, s), rising});
    before = accurate_value(c, h);
  }
  return found;
}

std::vector<Crossing> crossings(const Piece& piece, const Observable& g) {
  const Coordinates<double>& x = piece.position.at(0);
  g.require_fit("the observable", static_cast<int>(x.rows()), static_cast<int>(x.cols()));
  std::vector<LocalSeries> series = ObservableSeries(g).along(piece);
  for (const LocalSeries& part : series)
    if (!part.is_finite())
      throw std::invalid_argument("crossings: the observable has no series at t = " + shown(part.begin));
  return crossings(series);
}

}  // namespace jetlag
