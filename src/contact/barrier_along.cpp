// SPDX-License-Identifier: MIT
// Which pairs of a surface push each other.
#include "contact/barrier_along.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "contact/barrier_laws.hpp"
#include "jetlag/base/text.hpp"

namespace jetlag {

using namespace barrier_switch;

namespace {

/// The vertices of a stencil; on a line or in the plane the other components are 0.
template <class At>
std::array<Vector3<double>, 4> vertices_at(const Stencil& stencil, int dimension, const At& at) {
  std::array<Vector3<double>, 4> x;
  x.fill(Vector3<double>::Zero());
  for (int i = 0; i < vertices_of(stencil.kind); ++i)
    for (int d = 0; d < dimension; ++d) x[i][d] = at(stencil.vertices[i])[d];
  return x;
}

Closest closest_of(const Stencil& stencil, const std::array<Vector3<double>, 4>& x) {
  return closest(stencil.kind, std::span(x).first(vertices_of(stencil.kind)));
}

}  // namespace

BarrierAlong::BarrierAlong(std::shared_ptr<const ContactBarrier> contact, const Model<double>& model,
                           std::size_t first_law)
    : contact_(std::move(contact)),
      dimension_(model.dimension()),
      first_law_(first_law),
      candidates_(contact_->surface, model, contact_->gap + contact_->thickness * (1 + 4 * hysteresis),
                  contact_->with_itself),
      is_due_(model.fixed()) {}

// ---- which elements there are --------------------------------------------------------------------------------

bool BarrierAlong::begin(const State<double>& state, Model<double>& model) {
  time_ = state.time;
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
  candidates_.cover(SeriesAhead(at_once, dimension_, 0.0), 0.0);
  pairs_.clear();
  looks_ = 0;
  take_candidates();
  for (Pair& pair : pairs_) {
    const Places places = vertices_at(pair.stencil, dimension_, [&](int i) { return x.row(i); });
    const double distance = closest_of(pair.stencil, places).distance;
    if (!(distance > contact_->gap) && std::isfinite(distance))
      throw std::invalid_argument("contact: " + names_of(pair.stencil) + " are " + shown(distance) +
                                  " m apart, no more than the gap " + shown(contact_->gap) +
                                  " m: move them apart or lower the gap");
    update(pair, places, gap_of(distance) < contact_->thickness ? Change::on : Change::off);
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
    pairs.back().safe_until = Pair().safe_until;
  }
  pairs_ = std::move(pairs);
  first_of_.clear();
  asleep_.clear();
  awake_.resize(pairs_.size());
  std::iota(awake_.begin(), awake_.end(), 0);
}

/// Of particles with clocks of their own.
void BarrierAlong::list_pairs_of_particles() {
  if (!first_of_.empty()) return;
  first_of_.assign(left_at_.rows() + 1, 0);
  for (const Pair& pair : pairs_)
    for (const int i : pair.stencil.particles()) ++first_of_[i + 1];
  std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  pairs_of_.resize(first_of_.back());
  std::vector<int> next(first_of_.begin(), first_of_.end() - 1);
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    for (const int i : pairs_[p].stencil.particles()) pairs_of_[next[i]++] = static_cast<int>(p);
}

/// What a pair is at a place to which a step has led: on its way a change may have been found. Rounding does not decide
/// again what it was: what is beyond its border by the hysteresis, was so.
void BarrierAlong::update(Pair& pair, const Places& x, Change change) const {
  constexpr double here = arrived * hysteresis;
  const std::span<const Vector3<double>> all(x);
  const Closest now = closest_of(pair.stencil, x);
  const bool was_on = pair.is_on, tends_on = was_on || change == Change::on;
  pair.is_on =
      change != Change::off && gap_of(now.distance) < contact_->thickness * (tends_on ? 1 + here : 1 - here);
  if (!pair.is_on) return;
  const bool is_new = !was_on || change == Change::region;
  if (is_new || !holds_at(pair.stencil.kind, pair.support, all, arrived * band))
    pair.support = support_at(pair.stencil.kind, all, now, arrived * band);
  if (pair.stencil.kind != StencilKind::edge_edge) return;
  const double sine = squared_sine(all), most = parallel_below(pair.stencil);
  const auto is_below = [&](double part, bool was_below) {
    return sine < part * most * (is_new ? 1.0 : was_below ? 1 + here : 1 - here);
  };
  pair.lie = is_below(barrier_switch::parallel_below, pair.lie == Lie::parallel) ? Lie::parallel
             : is_below(nearly_parallel_below, pair.lie != Lie::any)             ? Lie::nearly_parallel
                                                                                 : Lie::any;
}

/// Whether an update would change how it acts.
bool BarrierAlong::acts_otherwise(Pair pair, const Places& x) const {
  const auto before = std::tuple(pair.is_on, pair.support, pair.lie);
  update(pair, x, Change::none);
  return before != std::tuple(pair.is_on, pair.support, pair.lie);
}

/// Whether it acts otherwise than before.
bool BarrierAlong::update_noting(Pair& pair, const Places& x, Change change) {
  const auto before = std::tuple(pair.is_on, pair.support, pair.lie);
  update(pair, x, change);
  const bool changed = before != std::tuple(pair.is_on, pair.support, pair.lie);
  is_changed_ |= changed;
  return changed;
}

void BarrierAlong::take(double h, const Coordinates<double>& position) {
  const double reached = h * (1 + 1e-9) + rounding_of_time(time_);
  for (const int p : awake_)
    if (Pair& pair = pairs_[p]; pair.is_near)
      update_noting(pair, vertices_at(pair.stencil, dimension_, [&](int i) { return position.row(i); }),
                    pair.change != Change::none && pair.time <= reached ? pair.change : Change::none);
  left_at_ = position;
  if (contact_->record) record_step(h, position);
}

/// Pairs that have been looked at closely and all of whose particles are due: the place tells what they are, and whoever has come
/// near a switch to which it was to go is there.
bool BarrierAlong::change(const MotionAhead& motion, std::span<const int> due, Model<double>& model) {
  if (first_of_.empty()) return false;  // before the first series
  ++look_;
  for (const int i : due) is_due_[i] = true;
  for (const int i : due)
    for (int p = first_of_[i]; p < first_of_[i + 1]; ++p) {
      Pair& pair = pairs_[pairs_of_[p]];
      if (!pair.is_near || std::exchange(pair.look, look_) == look_) continue;
      if (!std::ranges::all_of(pair.stencil.particles(), [&](int m) { return is_due_[m]; })) continue;
      update_noting(pair, vertices_at(pair.stencil, dimension_, [&](int m) { return motion.path(m).c_0; }),
                    pair.change == Change::on ? Change::on : Change::none);
    }
  for (const int i : due) is_due_[i] = false;  // fixed ones always are, and never among these
  if (is_changed_ && contact_->record) record_changes();
  return std::exchange(is_changed_, false) && make_elements(model);
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

}  // namespace jetlag
