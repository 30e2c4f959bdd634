// SPDX-License-Identifier: MIT
#include "jetlag/motion/observable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jetlag/base/rounded_time.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/first_change.hpp"
#include "jetlag/series/calculus/roots.hpp"
#include "motion/terms.hpp"

namespace jetlag {

namespace {

template <class Rows>
double entry(const Rows& rows, const Input& input) {
  return rows(input.participant, input.component);
}

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
  find_linear_terms();
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

ObservableSeries::Course ObservableSeries::Course::from(double t) const {
  Course later{rows, t};
  for (auto& row : later.rows) taylor_shift(row, t - begin);
  return later;
}

/// The coefficients of g from the beginning of a course on, up to the first one that is not finite where there are three: near a
/// singularity the last ones overflow, and those before serve on an interval that is short enough.
std::vector<double> ObservableSeries::expand(const Course& course) {
  const Program& program = blocks_.program();
  std::size_t known = 1;
  for (const auto& row : course.rows) known = std::max(known, row.size());
  orders_ = static_cast<int>(program.is_static        ? 1
                             : program.histories == 0 ? known
                                                      : std::max(2 * known - 1, std::size_t{41}));
  blocks_.reserve(orders_);
  std::vector<double> c;
  for (int k = 0; k < orders_; ++k) {
    for (std::size_t i = 0; i < course.rows.size(); ++i) {
      const std::vector<double>& row = course.rows[i];
      *blocks_.at(0, program.inputs[i].place, k) = k < static_cast<int>(row.size()) ? row[k] : 0.0;
    }
    blocks_.run(0, k);
    c.push_back(coefficient(k));
  }
  const auto infinite = std::ranges::find_if(c, [](double x) { return !std::isfinite(x); });
  const auto finite = infinite - c.begin();
  if (finite > 2) c.resize(static_cast<std::size_t>(finite));
  return c;
}

/// The time from the beginning of the last expansion to the first change of a choice in g; h if there is none.
double ObservableSeries::first_change(double h) {
  std::vector<double> c(orders_);
  const auto look = [&](Place place, int at_zero) {
    for (int k = 0; k < orders_; ++k) c[k] = *blocks_.at(0, place, k);
    if (const auto s = jetlag::first_change<double>(c, at_zero, h)) h = *s;
  };
  for (const auto& [place, at_zero, argument] : blocks_.program().conditions) {
    if (argument) look(*argument, 0);
    look(place, at_zero);
  }
  return h;
}

bool ObservableSeries::conditions_converge(double h) {
  return std::ranges::all_of(blocks_.program().conditions, [&](const auto& condition) {
    std::vector<double> c;
    for (int k = 0; k < orders_ && std::isfinite(*blocks_.at(0, condition.place, k)); ++k)
      c.push_back(*blocks_.at(0, condition.place, k));
    return c.empty() || Terms(c, h).converge();  // one that does not exist decides nothing
  });
}

/// g of the motion at a time of a course.
double ObservableSeries::value(const Course& course, double t) {
  for (std::size_t i = 0; i < course.rows.size(); ++i)
    *blocks_.at(0, blocks_.program().inputs[i].place, 0) = accurate_value(course.rows[i], t - course.begin);
  blocks_.run(0, 0);
  return coefficient(0);
}

bool ObservableSeries::is_right(const Course& course, const LocalSeries& series, double s) {
  const double t = series.begin + s;
  s = t - series.begin;  // exact: of a time that exists
  const double truth = value(course, t);
  return !std::isfinite(truth) ||
         std::abs(truth - accurate_value(series.c, s)) <= same_value * Terms(series.c, s).sum;
}

namespace {
constexpr std::size_t most_series = 10000;
constexpr int most_halvings = 30;

/// What a series changes in 2^10 roundings of its time, within which it follows a change of a choice.
double change_by_rounding(const LocalSeries& series) {
  const double h = 0x1p-42 * std::abs(series.begin);
  return Terms(series.c, h).sum - std::abs(series.c[0]);
}

void push(LocalSeries series, std::vector<LocalSeries>& all) {
  if (!all.empty() && series.join == LocalSeries::Join::value) {
    const LocalSeries& last = all.back();
    const double h = last.end - last.begin;
    const double size = std::max(Terms(last.c, h).sum, Terms(series.c, series.end - series.begin).sum);
    const double late = last.to_change ? change_by_rounding(series) : 0;
    if (std::abs(accurate_value(last.c, h) - series.c[0]) > same_value * size + late)
      series.join = LocalSeries::Join::jump;
  }
  const Terms terms(series.c, series.end - series.begin);
  while (series.c.size() > 1 && terms.term[series.c.size() - 1] < 0x1p-60 * terms.sum) series.c.pop_back();
  all.push_back(std::move(series));
}
}  // namespace

/// Follows g by its values from a singular point, at which it begins, to where it has a series; false where it has none.
bool ObservableSeries::passes(Course& course, double end, std::vector<LocalSeries>& all) {
  const double beyond = course.begin + std::ldexp(end - course.begin, -most_halvings);
  if (!(course.begin < beyond && beyond < end)) return false;
  Course later = course.from(beyond);
  if (!std::isfinite(value(course, beyond)) || !std::isfinite(expand(later).back())) return false;
  append_values(course, beyond, all);
  course = std::move(later);
  return true;
}

void ObservableSeries::append(Course course, double end, int halvings, std::vector<LocalSeries>& all) {
  while (true) {
    LocalSeries series{course.begin, end, expand(course)};
    const bool exists = std::isfinite(series.c.back());
    if (!exists && !std::isnan(series.c[0]) && passes(course, end, all)) continue;
    if (!exists || all.size() >= most_series) {
      if (exists) series.c = {std::numeric_limits<double>::quiet_NaN()};
      return all.push_back(std::move(series));
    }
    const double h = time_between(course.begin, end);
    const double change = h > 0 ? first_change(h) : h;
    if (change < h)
      series.end = std::clamp(time_after(course.begin, change),
                              std::nextafter(course.begin, std::numeric_limits<double>::infinity()), end);
    series.to_change = change < h;
    const double length = series.end - series.begin;
    const bool polynomial = blocks_.program().histories == 0 || length <= 0;
    const double inner = change < h ? length * (1 - 0x1p-20) : length;  // at a change g goes another way
    if (!polynomial &&
        !(Terms(series.c, length).converge() && conditions_converge(length) &&
          ((change < h && series.begin + inner >= series.end) || is_right(course, series, inner)) &&
          is_right(course, series, 0.29 * length) && is_right(course, series, 0.5 * length) &&
          is_right(course, series, 0.77 * length))) {
      const double middle = course.begin + 0.5 * length;
      if (halvings < most_halvings && course.begin < middle && middle < series.end) {
        append(course, middle, halvings + 1, all);
        append(course.from(middle), series.end, halvings + 1, all);
      } else {  // wide enough to tell a zero from a jump
        series.end = std::max(series.end, course.begin + std::ldexp(end - course.begin, -most_halvings));
        append_values(course, series.end, all);
      }
    } else {
      push(series, all);
    }
    if (!(series.end < end) || !all.back().is_finite()) return;
    course = course.from(series.end);
  }
}

std::vector<LocalSeries> ObservableSeries::along(const PieceView& piece) {
  if (piece.unit != 1)
    throw std::invalid_argument(
        "an observable is followed in seconds, in which the coefficients of this motion over- or underflow: "
        "measure "
        "its time in another unit");
  std::vector<LocalSeries> all;
  if (std::vector<double> c = combined(piece); !c.empty()) {
    push({piece.begin, piece.end, std::move(c)}, all);
    return all;
  }
  Rows rows;
  for (const auto& [place, input] : blocks_.program().inputs) {
    std::vector<double>& row = rows.emplace_back();
    if (input.kind == Input::Kind::time)
      row = {piece.begin, 1.0};
    else
      for (const auto& coefficient : input.kind == Input::Kind::position ? piece.position : piece.velocity)
        row.push_back(entry(coefficient, input));
  }
  append({std::move(rows), piece.begin}, piece.end, 0, all);
  return all;
}

/// Where there is no series: g by its values at the ends (where it has a pole there, one double inside), and the place between
/// them where its sign changes, from or to zero as well.
void ObservableSeries::append_values(const Course& course, double end, std::vector<LocalSeries>& all) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto beside_pole = [&](double t, double inside) {
    const double here = value(course, t);
    return std::isinf(here) ? value(course, std::nextafter(t, inside)) : here;
  };
  const double first = beside_pole(course.begin, end), last = beside_pole(end, course.begin);
  double a = first, b = last;
  if (!std::isfinite(a) || !std::isfinite(b)) return all.push_back({course.begin, end, {nan}});
  if (sign(a) == sign(b)) return push({course.begin, end, {a, (b - a) / (end - course.begin)}}, all);
  double size = std::max(std::abs(a), std::abs(b));  // of g about here: these may be zero and next to it
  for (const double t : {course.begin - (end - course.begin), end + (end - course.begin)})
    if (const double beside = std::abs(value(course, t)); std::isfinite(beside))
      size = std::max(size, beside);
  double low = course.begin, high = end;
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high)) {
    const double here = value(course, middle);
    if (std::isnan(here)) return all.push_back({low, end, {nan}});
    const bool before = sign(here) == sign(a);
    (before ? low : high) = middle;
    (before ? a : b) = here;
  }
  const bool to_zero = std::max(std::abs(a), std::abs(b)) < 0.5 * size;
  push({course.begin, high, {first}}, all);
  push({high, end, {last}, to_zero ? LocalSeries::Join::zero : LocalSeries::Join::jump}, all);
}

double LocalSeries::at(double t) const { return accurate_value(c, time_between(begin, t)); }

bool LocalSeries::is_finite() const { return std::isfinite(rounding_of(c, 2 * (end - begin))); }

}  // namespace jetlag
