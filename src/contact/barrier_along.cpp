// SPDX-License-Identifier: MIT
#include "contact/barrier_along.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/barrier_laws.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/first_change.hpp"
#include "jetlag/series/jet.hpp"

namespace jetlag {

namespace {

/// Part of the thickness by which a gap must be below it, or above, before the barrier is turned on, or off.
constexpr double hysteresis = 1e-6;
/// How far beyond its border a region still holds, in parts of the features.
constexpr double band = 1e-8;
/// Of |e1 x e2|^2 / (|E1|^2 |E2|^2), E at rest: below the first, edges are nearly parallel, and their barrier is times a factor that
/// vanishes with the angle; below the second that is 2e-13, and they have none.
constexpr double nearly_parallel_below = 1e-3, parallel_below = 1e-16;

using MotionSeries = Jet<double, Dynamic>;

/// A thing at a place, for closest() and region_of().
std::array<Vector3<double>, 4> places_of(const Stencil& stencil, const Coordinates<double>& position) {
  std::array<Vector3<double>, 4> x;
  x.fill(Vector3<double>::Zero());
  for (int i = 0; i < vertices_of(stencil.kind); ++i)
    for (int d = 0; d < position.cols(); ++d) x[i][d] = position(stencil.vertices[i], d);
  return x;
}

Closest closest_of(const Stencil& stencil, const std::array<Vector3<double>, 4>& x) {
  return closest(stencil.kind, std::span(x).first(vertices_of(stencil.kind)));
}

template <class T>
T squared_sine(const Stencil&, std::span<const Vector3<T>> x) {
  const Vector3<T> n = detail::cross<T>(x[1] - x[0], x[3] - x[2]);
  return dot(n, n);
}

}  // namespace

BarrierAlong::BarrierAlong(std::shared_ptr<const ContactBarrier> contact, const Model<double>& model,
                           std::size_t first_law)
    : contact_(std::move(contact)),
      dimension_(model.dimension()),
      first_law_(first_law),
      candidates_(contact_->surface, model, contact_->gap + contact_->thickness * (1 + 2 * hysteresis),
                  contact_->with_itself) {}

// ---- which elements there are --------------------------------------------------------------------------------

bool BarrierAlong::begin(const State<double>& state, Model<double>& model) {
  if (left_at_.rows() != state.position.rows() || left_at_ != state.position) start(state);
  return std::exchange(is_changed_, false) && make_elements(model);
}

/// From a state of which nothing is known.
void BarrierAlong::start(const State<double>& state) {
  const Coordinates<double>& x = state.position;
  AlignedVector<double> both(x.data(), x.data() + x.size());
  both.insert(both.end(), state.velocity.data(), state.velocity.data() + state.velocity.size());
  const PositionSeries at_once{state.time,
                               1.0,
                               both.data(),
                               1,
                               static_cast<std::size_t>(x.size()),
                               static_cast<std::size_t>(x.cols())};
  candidates_.forget();
  candidates_.cover(at_once, 0.0);
  pairs_.clear();
  take_candidates();
  for (Pair& pair : pairs_) {
    const double distance = closest_of(pair.stencil, places_of(pair.stencil, x)).distance;
    if (!(distance > contact_->gap) && std::isfinite(distance))
      throw std::invalid_argument("contact: " + names(pair.stencil) + " are " + shown(distance) +
                                  " m apart, no more than the gap " + shown(contact_->gap) +
                                  " m: move them apart or lower the gap");
    update(pair, x, gap_of(distance) < contact_->thickness ? Change::on : Change::off);
  }
  candidates_.forget();
  left_at_ = x;
  is_changed_ = true;
}

/// The pairs of the candidates; those that are known stay what they were.
void BarrierAlong::take_candidates() {
  if (looks_ == candidates_.looks()) return;
  looks_ = candidates_.looks();
  std::vector<Pair> pairs;
  pairs.reserve(candidates_.list().size());
  auto known = pairs_.begin();
  for (const Stencil& stencil : candidates_.list()) {
    while (known != pairs_.end() && known->stencil < stencil) ++known;
    if (known != pairs_.end() && known->stencil == stencil)
      pairs.push_back(*known);
    else
      pairs.push_back({.stencil = stencil});
  }
  pairs_ = std::move(pairs);
}

/// What a pair is at a position to which a step has led: on its way a change may have been found. Rounding does not decide
/// again what it was: what is beyond its border by the hysteresis, was so.
void BarrierAlong::update(Pair& pair, const Coordinates<double>& position, Change change) const {
  const auto x = places_of(pair.stencil, position);
  const std::span<const Vector3<double>> all(x);
  const Closest now = closest_of(pair.stencil, x);
  const bool was_on = pair.is_on, tends_on = was_on || change == Change::on;
  pair.is_on = change != Change::off &&
               gap_of(now.distance) < contact_->thickness * (tends_on ? 1 + hysteresis : 1 - hysteresis);
  if (!pair.is_on) return;
  const bool is_new = !was_on || change == Change::region;
  if (is_new || !holds_at(pair.stencil.kind, pair.support, all, band))
    pair.support = support_at(pair.stencil.kind, all, now, band);
  if (pair.stencil.kind != StencilKind::edge_edge) return;
  const double sine = squared_sine(pair.stencil, all), most = parallel_below(pair.stencil);
  const auto is_below = [&](double part, bool was_below) {
    return sine < part * most * (is_new ? 1.0 : was_below ? 1 + hysteresis : 1 - hysteresis);
  };
  pair.lie = is_below(jetlag::parallel_below, pair.lie == Lie::parallel) ? Lie::parallel
             : is_below(nearly_parallel_below, pair.lie != Lie::any)     ? Lie::nearly_parallel
                                                                         : Lie::any;
}

double BarrierAlong::parallel_below(const Stencil& stencil) const {
  const auto square = [&](int a, int b) {
    return (contact_->rest.row(a) - contact_->rest.row(b)).squaredNorm();
  };
  return square(stencil.vertices[0], stencil.vertices[1]) * square(stencil.vertices[2], stencil.vertices[3]);
}

/// Pairs of one region are one element, with their number as a factor. Whether the model is another.
bool BarrierAlong::make_elements(Model<double>& model) const {
  std::map<BarrierElement, int> elements;
  for (const Pair& pair : pairs_)
    if (pair.is_on && pair.lie != Lie::parallel)
      ++elements[barrier_element(pair.stencil, pair.support, pair.lie == Lie::nearly_parallel)];
  bool changed = false;
  const std::size_t laws = barrier_laws(dimension_).size();
  std::vector<std::vector<int>> particles(laws);
  std::vector<std::vector<double>> parameters(laws);
  for (const auto& [element, number] : elements) {
    const auto law = static_cast<std::size_t>(element.law);
    const auto& members = element.members;
    particles[law].insert(particles[law].end(), members.begin(), std::ranges::find(members, -1));
    parameters[law].insert(parameters[law].end(), {number * contact_->stiffness, contact_->thickness,
                                                   contact_->gap, contact_->power});
    if (element.law >= first_nearly_parallel)
      parameters[law].push_back(nearly_parallel_below * parallel_below(element.edges()));
  }
  for (std::size_t law = 0; law < laws; ++law) {
    const auto& now = model.law(first_law_ + law).elements();
    if (now.particles == particles[law] && now.parameters == parameters[law]) continue;
    model = model.with(first_law_ + law, std::move(particles[law]), std::move(parameters[law]));
    changed = true;
  }
  return changed;
}

// ---- how far a step may go -----------------------------------------------------------------------------------

double BarrierAlong::up_to_change(const PositionSeries& position, double h, Report& report) {
  h = candidates_.cover(position, h);
  if (!candidates_.are_finite()) return h;  // a matter of the method
  take_candidates();
  for (Pair& pair : pairs_) {
    pair.change = Change::none;
    h = up_to_change(pair, position, h);
    if (h > 0) continue;
    report = {Outcome::step_underflow,
              "the gap between " + names(pair.stencil) + " at t = " + shown(position.time) +
                  " is below the rounding of their positions; take a stiffer or thicker contact",
              pair.stencil.vertices[0]};
    return 0.0;
  }
  if (contact_->record) foresee(position, h);
  return h;
}

double BarrierAlong::up_to_change(Pair& pair, const PositionSeries& position, double h) {
  const double gap = gap_of(distance_at_start(pair.stencil, position));
  const double reach = contact_->gap + (pair.is_on ? gap / 2 : contact_->thickness * (1 - hysteresis));
  const auto time = first_approach(pair, position, h, reach);
  pair.is_near = pair.is_on || time.has_value();
  if (time && pair.is_on) {
    if (!(*time > 0)) return 0.0;
    h = std::min(h, *time);
  } else if (time) {
    // Found at once where rounding hides on which side of the switch it is: it turns on just after.
    constexpr double eps = std::numeric_limits<double>::epsilon();
    pair.change = Change::on;
    pair.time = std::max({*time, 8 * eps * std::abs(position.time), h * 0x1p-40});
    h = std::min(h, pair.time);
  }
  return pair.is_on ? up_to_other_region(pair, position, h) : h;
}

double BarrierAlong::distance_at_start(const Stencil& stencil, const PositionSeries& position) const {
  std::array<Vector3<double>, 4> x;
  x.fill(Vector3<double>::Zero());
  for (int i = 0; i < vertices_of(stencil.kind); ++i)
    for (int d = 0; d < dimension_; ++d) x[i][d] = position.coefficient(0, stencil.vertices[i])[d];
  return closest_of(stencil, x).distance;
}

/// The first time [s] within a step at which a pair is nearer than that [m].
std::optional<double> BarrierAlong::first_approach(const Pair& pair, const PositionSeries& position, double h,
                                                   double reach) {
  if (distance_at_start(pair.stencil, position) - stray(pair, position, h) > reach) return {};
  std::array<PathView, 4> paths;
  const auto particles = pair.stencil.particles();
  for (std::size_t i = 0; i < particles.size(); ++i)
    paths[i] = {position.coefficient(0, particles[i]),
                static_cast<std::ptrdiff_t>(position.next_order),
                position.degree,
                position.unit,
                dimension_,
                position.weights};
  ++searched_;
  return approach_.first(pair.stencil.kind, std::span(paths).first(particles.size()), h, reach);
}

/// How much nearer to each other the two sides of a pair may come within a step [m].
double BarrierAlong::stray(const Pair& pair, const PositionSeries& position, double h) const {
  const auto particles = pair.stencil.particles();
  const double* v_0 = position.coefficient(1, particles.back());
  double of_side[2] = {};
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double* v = position.coefficient(1, particles[i]);
    double square = 0;
    for (int d = 0; d < dimension_; ++d) square += (v[d] - v_0[d]) * (v[d] - v_0[d]);
    double& side = of_side[static_cast<int>(i) < first_side(pair.stencil.kind) ? 0 : 1];
    side = std::max(side, std::sqrt(square) * h / position.unit + candidates_.curve(particles[i]));
  }
  return of_side[0] + of_side[1];
}

/// A pair that acts: the switch where it turns off, the borders of its region, and of how its edges lie.
double BarrierAlong::up_to_other_region(Pair& pair, const PositionSeries& position, double h) const {
  const Stencil& stencil = pair.stencil;
  std::array<Vector3<MotionSeries>, 4> x;
  std::vector<double> c(position.degree + 1);
  for (int i = 0; i < vertices_of(stencil.kind); ++i)
    for (int d = 0; d < 3; ++d) {
      for (int n = 0; n <= position.degree; ++n)
        c[n] = d < dimension_ ? position.coefficient(n, stencil.vertices[i])[d] *
                                    (position.weights ? position.weights[n] : 1.0)
                              : 0.0;
      x[i][d] = MotionSeries::from(c);
    }
  const std::span<const Vector3<MotionSeries>> all(x.data(),
                                                   static_cast<std::size_t>(vertices_of(stencil.kind)));
  double most = h / position.unit;
  const auto stays = [&](const MotionSeries& condition, Change change) {
    if (!(condition[0] >= 0)) return;  // left behind by rounding: the end of the step tells
    std::optional<double> first;
    find_first_change<double>(
        std::span<const double>(condition.coefficients().data(), condition.degree() + 1), 1, most, first);
    if (!first) return;
    pair.change = change;
    pair.time = *first * position.unit;
  };
  const double off = contact_->gap + contact_->thickness * (1 + hysteresis);
  const auto region = region_of<MotionSeries>(stencil.kind, pair.support, all, band);
  stays(MotionSeries(off * off) - region.square, Change::off);
  for (const MotionSeries& condition : region.conditions) stays(condition, Change::region);
  if (stencil.kind == StencilKind::edge_edge) {
    const MotionSeries sine = squared_sine(stencil, all);
    const double scale = parallel_below(stencil);
    if (pair.lie == Lie::any)
      stays(sine - MotionSeries(nearly_parallel_below * scale * (1 - hysteresis)), Change::region);
    if (pair.lie == Lie::nearly_parallel) {
      stays(MotionSeries(nearly_parallel_below * scale * (1 + hysteresis)) - sine, Change::region);
      stays(sine - MotionSeries(jetlag::parallel_below * scale * (1 - hysteresis)), Change::region);
    }
    if (pair.lie == Lie::parallel)
      stays(MotionSeries(jetlag::parallel_below * scale * (1 + hysteresis)) - sine, Change::region);
  }
  return std::min(h, most * position.unit);
}

bool BarrierAlong::is_safe(const PositionSeries& position, double h, bool is_given, Report& report) {
  if (candidates_.cover(position, h, is_given) < h) return false;
  if (!candidates_.are_finite()) return true;
  take_candidates();
  for (Pair& pair : pairs_) {
    const double gap = gap_of(distance_at_start(pair.stencil, position));
    // What is drawn at random may differ from what was looked at, but not by half of what there is.
    const double reach = contact_->gap + (is_given     ? std::min(gap, contact_->thickness) * 0x1p-20
                                          : pair.is_on ? gap / 2
                                                       : contact_->thickness / 2);
    pair.is_near = true;
    if (!first_approach(pair, position, h, reach)) continue;
    if (is_given)
      report = {Outcome::contradicted,
                names(pair.stencil) + " pass through each other in the step of " + shown(h) + " s from t = " +
                    shown(position.time) + "; take shorter steps, or a control that chooses them",
                pair.stencil.vertices[0]};
    return false;
  }
  if (contact_->record) foresee(position, h);
  return true;
}

void BarrierAlong::take(double h, const Coordinates<double>& position) {
  for (Pair& pair : pairs_) {
    if (!pair.is_near) continue;
    const auto before = std::tuple(pair.is_on, pair.support, pair.lie);
    update(pair, position,
           pair.change != Change::none && pair.time <= h * (1 + 1e-9) ? pair.change : Change::none);
    is_changed_ |= before != std::tuple(pair.is_on, pair.support, pair.lie);
  }
  left_at_ = position;
  if (contact_->record) record_step(h, position);
}

std::string BarrierAlong::names(const Stencil& stencil) const { return names_of(stencil); }

}  // namespace jetlag
