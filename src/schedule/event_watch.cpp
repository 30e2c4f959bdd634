// SPDX-License-Identifier: MIT
#include "schedule/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "jetlag/base/rounded_time.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/series/calculus/roots.hpp"

namespace jetlag {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A step to a change shorter than this part of the time, 2^16 ulps, is next to none: that an impact is late by up to
/// one ulp gives a ball on the floor speed again, g ulp each time, and keeps up flights of r / (1 - r) ulps. As many
/// such steps in a row are Zeno's.
constexpr double instant = 0x1p-36;
constexpr int most_instants = 100;

int sign(double x) { return (x > 0) - (x < 0); }

/// The sign of the first coefficient from c_k on that is not zero: for k = 0 that of the polynomial right after 0, for
/// k = 1 where it goes.
int first_sign(const std::vector<double>& c, std::size_t k) {
  for (; k < c.size(); ++k)
    if (c[k] != 0) return sign(c[k]);
  return 0;
}

/// sum_k |c_k| s^k
double size_of(const std::vector<double>& c, double s) {
  double sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + std::abs(c[k]);
  return sum;
}

}  // namespace

EventWatch::EventWatch(const RunOptions& options, const State<double>& start) : hits_(options.hits) {
  for (const Event& event : options.events) {
    const std::string name = "event " + std::to_string(events_.size()) + " (" + event.name + ")";
    event.g.require_fit(name, static_cast<int>(start.position.rows()),
                        static_cast<int>(start.position.cols()));
    events_.push_back({.event = event, .g = ObservableSeries(event.g), .name = name});
  }
}

// ---- one event in one step --------------------------------------------------------------------------------

bool EventWatch::Watched::keeps_sign(const PieceView& piece, const State<double>& state) {
  if (on_event) return false;
  const int all_along = g.sign_along(piece);
  if (all_along == 0 || (before != 0 && before != all_along) || sign(g(state)) != all_along) return false;
  before = side = all_along;
  stays = false;
  return true;
}

bool EventWatch::Watched::counts(const Crossing& at) const {
  return event.direction == Direction::any || at.rising == (event.direction == Direction::rising);
}

/// The series that holds t: of two that meet there the earlier one.
const LocalSeries& EventWatch::Watched::series_at(double t) const {
  const auto found = std::ranges::lower_bound(series, t, {}, &LocalSeries::end);
  return found == series.end() ? series.back() : *found;
}

/// On the event c_0 is what rounding has left of zero. Where the flight does not rise far above it, to 2^20 |c_0|
/// before it ends, the flight is taken to begin at zero: else c_0 would drive it, and a ball at rest would tremble or
/// sink in. Elsewhere c_0 stands, so that it does not add up from flight to flight; a way back over zero at once is no
/// crossing.
/// Where g begins at zero otherwise the sign kept from before tells whether it crosses.
void EventWatch::Watched::find_crossings() {
  std::vector<double>& c = series.front().c;
  const double c_0 = c[0];
  if (on_event) {
    c[0] = 0;
    const double h = time_between(series.front().begin, series.front().end);
    const auto changes = h > 0 ? sign_changes(c, h) : std::vector<SignChange>();
    const double top = std::abs(accurate_value(c, changes.empty() ? h : 0.5 * changes.front().s));
    if (top >= 0x1p20 * std::abs(c_0)) c[0] = c_0;
  }
  side = first_sign(c, on_event ? 1 : 0);
  if (side == 0) side = before;
  crossings = jetlag::crossings(series, before);
  if (on_event && sign(c[0]) * side < 0 && !crossings.empty()) crossings.erase(crossings.begin());
}

/// The series that g goes on with at t: of two that meet there the later one.
const LocalSeries& EventWatch::Watched::series_from(double t) const {
  const auto beyond = std::ranges::upper_bound(series, t, {}, &LocalSeries::begin);
  return beyond == series.begin() ? *beyond : *std::prev(beyond);
}

/// The last sign up to t that the series give g: that after the last crossing or jump, or from the beginning on.
int EventWatch::Watched::sign_after(double t) const {
  int after = side;
  double since = series.front().begin;
  const auto goes_on_with = [&](int sign, double from) {
    after = sign;
    since = from;
  };
  for (const LocalSeries& local : series) {
    const int goes = first_sign(local.c, 0);
    if (local.join == LocalSeries::Join::jump && local.begin <= t)
      goes_on_with(goes, local.begin);
    else if (&local != &series.front() && local.begin < t && goes != 0)
      goes_on_with(goes, local.begin);
  }
  if (!crossings.empty() && crossings.back().time >= since) after = crossings.back().rising ? 1 : -1;
  return after;
}

/// g of the motion carried on a little beyond t, the end of what is known.
EventWatch::Watched::Ahead EventWatch::Watched::ahead(double t, const PieceView& piece) {
  const double later = std::max(t + 0x1p-16 * (t - piece.begin), std::nextafter(t, infinity));
  return {later, g(piece.at(later))};
}

/// Where g goes from zero at t: the sign that its series has a little further on, unless g there is another value; 0 where it
/// stays at zero.
int EventWatch::Watched::sign_from_zero(double t, const Ahead& ahead) const {
  const LocalSeries& local = series_from(t);
  const double s = ahead.time - local.begin, expected = accurate_value(local.c, s);
  const bool same = !(std::abs(ahead.value - expected) > rounding_of(local.c, s));
  return same ? sign(expected) : sign(ahead.value);
}

/// Whether the last crossing has not gone beyond rounding up to t; then it is left to the next step.
bool EventWatch::Watched::take_back_crossing_at(double t, double rounding) {
  if (crossings.empty()) return false;
  const double middle = crossings.back().time + 0.5 * (t - crossings.back().time);
  if (std::abs(series_at(middle).at(middle)) > rounding) return false;
  crossings.pop_back();
  return true;
}

/// Makes the crossings up to t agree with the state there. Where they do not, by rounding: a crossing that has not gone
/// beyond rounding since is left to the next step; otherwise there is one more, at t.
void EventWatch::Watched::settle(double t, const State<double>& state, const PieceView& piece) {
  std::erase_if(crossings, [t](const Crossing& at) { return at.time > t; });
  const int after = sign_after(t);
  const double value = g(state);
  before = sign(value);
  stays = false;
  if (value != 0 && (after == 0 || before == after)) return;
  // A difference is rounding where both are small beside what g is about here; elsewhere g jumps at t.
  const Ahead next = ahead(t, piece);
  const LocalSeries& local = series_at(t);
  const double rounding = 2 * (std::abs(series_from(t).at(t)) + std::abs(value));
  if (rounding > 0x1p-20 * std::max(size_of(local.c, t - local.begin), std::abs(next.value))) return;
  if (value == 0) before = sign_from_zero(t, next);
  stays = before == 0;
  if (stays) {
    take_back_crossing_at(t, rounding);
    before = sign_after(t);
  } else if (after != 0 && before != after && !take_back_crossing_at(t, rounding)) {
    crossings.push_back({t, before > 0});
  }
}

// ---- all events in one step -------------------------------------------------------------------------------

/// The end of the step, or the time at which the first event takes the run out of it.
double EventWatch::last_time(double end) const {
  double last = end;
  for (const Watched& watched : events_)
    for (const Crossing& at : watched.crossings)
      if (watched.leaves() && watched.counts(at)) last = std::min(last, at.time);
  return last;
}

/// What counts, in order of time, at the same time in order of number.
std::vector<EventWatch::Hit> EventWatch::all_hits() const {
  std::vector<Hit> hits;
  for (int i = 0; i < static_cast<int>(events_.size()); ++i)
    for (const Crossing& at : events_[i].crossings)
      if (events_[i].counts(at))
        hits.insert(std::ranges::upper_bound(hits, at.time, {}, [](const Hit& hit) { return hit.at.time; }),
                    {i, at});
  return hits;
}

void EventWatch::hand_out(const Hit& hit, const State<double>& state) {
  EventHit seen{hit.event, hit.at.time, hit.at.rising, state};
  if (events_[hit.event].event.callback) events_[hit.event].event.callback(seen);
  if (hits_) hits_->push_back(std::move(seen));
}

/// All changes at the end of the hits. An event that has fired and whose g is still at zero is on the event.
void EventWatch::change(const std::vector<Hit>& hits, State<double>& state) {
  std::vector<std::pair<Watched*, double>> fired;  // and g before the changes
  for (const Hit& hit : hits)
    if (Watched& watched = events_[hit.event]; watched.event.change)
      fired.emplace_back(&watched, watched.g(state));
  const double time = state.time;
  const int particles = static_cast<int>(state.position.rows()),
            dimension = static_cast<int>(state.position.cols());
  for (const auto& [watched, before] : fired) {
    watched->event.change(state);
    if (state.time != time) throw std::invalid_argument(watched->name + ": change() must keep the time");
    require_shape(state, particles, dimension);
  }
  for (Watched& watched : events_)
    if (!watched.stays) watched.before = 0;  // where it goes has been told of the motion before the change
  for (const auto& [watched, before] : fired) {
    const LocalSeries& local = watched->series_at(time);
    const double rounding = rounding_of(local.c, time - local.begin);
    watched->on_event = std::abs(watched->g(state)) <= 2 * std::abs(before) + rounding;
  }
}

Report EventWatch::look(const PieceView& piece, State<double>& state) {
  if (std::ranges::all_of(events_, [&](Watched& watched) { return watched.keeps_sign(piece, state); })) {
    instants_ = 0;
    return {};
  }
  const auto fail = [&](Outcome outcome, const std::string& message) -> Report {
    state = piece.at(piece.begin);
    return {outcome, message, -1};
  };

  double broken = infinity;  // from here on a g does not exist
  std::string broken_name;
  for (Watched& watched : events_) {
    watched.series = watched.g.along(piece);
    const auto bad = std::ranges::find_if_not(watched.series, &LocalSeries::is_finite);
    if (bad != watched.series.end() && bad->begin < broken) {
      broken = bad->begin;
      broken_name = watched.name;
    }
    watched.series.erase(bad, watched.series.end());
    watched.crossings.clear();
    if (!watched.series.empty()) watched.find_crossings();
  }
  const double last = last_time(state.time);
  if (broken < last) {
    for (const Hit& hit : all_hits())  // none of them ends the run or changes the state
      if (hit.at.time < broken) hand_out(hit, piece.at(hit.at.time));
    return fail(Outcome::non_finite, broken_name + ": g has no series at t = " + number(broken) +
                                         "; it must be smooth along the motion, up to where the run ends");
  }

  State<double> at_last = last == state.time ? state : piece.at(last);
  for (Watched& watched : events_) {
    watched.before = 0;
    const bool fires_change =
        watched.event.change && std::ranges::any_of(watched.crossings, [&](const Crossing& at) {
          return watched.counts(at) && at.time <= last;
        });
    if (fires_change)  // the change decides where the state is
      std::erase_if(watched.crossings, [last](const Crossing& at) { return at.time > last; });
    else
      watched.settle(last, at_last, piece);
    watched.on_event = false;
  }
  const std::vector<Hit> hits = all_hits();
  const bool changes =
      std::ranges::any_of(hits, [&](const Hit& hit) { return bool(events_[hit.event].event.change); });
  instants_ = changes && last - piece.begin <= instant * last ? instants_ + 1 : 0;
  if (instants_ >= most_instants)
    return fail(Outcome::step_underflow,
                events_[hits.front().event].name + " has changed the state " + std::to_string(most_instants) +
                    " times in a row with next to no time in between, at t = " + number(piece.begin) +
                    ": its changes accumulate there (Zeno); end the run by a terminal event before");

  state = std::move(at_last);
  const Hit* terminal = nullptr;
  for (const Hit& hit : hits) {
    const Event& event = events_[hit.event].event;
    if (hits_ || event.callback) hand_out(hit, hit.at.time == last ? state : piece.at(hit.at.time));
    if (event.terminal && !terminal) terminal = &hit;
  }
  if (changes) change(hits, state);
  if (terminal)
    return {Outcome::event, events_[terminal->event].name + " ended the run at t = " + number(last), -1};
  return {};
}

}  // namespace jetlag
