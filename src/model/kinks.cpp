// SPDX-License-Identifier: MIT
#include "jetlag/model/kinks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace jetlag {

Kinks::Kinks(const Model<double>& model) : dimension_(model.dimension()), fixed_(model.fixed()) {
  for (const auto& law : model.laws())
    if (law->elements().law.kink != nullptr &&
        std::ranges::any_of(law->elements().particles, [&](int i) { return !fixed_[i]; }))
      laws_.push_back(law);
  if (laws_.empty()) return;
  place_.assign(model.particles(), -1);
  forget();
}

void Kinks::forget() { tracks_.assign(place_.size(), {{}, {}, 0, -1, 0, 0}); }

Eigen::Vector3d Kinks::kink(const Element& e, const double* x) const {
  return e.law().kink(x, e.of->elements().parameters.data() + e.number * e.law().parameters.size());
}

Eigen::Vector3d Kinks::kink(const Element& e, double s, const Paths& now) const {
  double x[3 * most_participants];
  double* next = x;
  for (int i : particles_of(e)) {
    now.at(i, s, next);
    next += dimension_;
  }
  return kink(e, x);
}

/// The length of an element's kink, of the tracks of its particles.
double Kinks::length(const Element& e, double now) const {
  double x[3 * most_participants];
  double* next = x;
  for (int i : particles_of(e)) {
    const Track& track = tracks_[i];
    for (int c = 0; c < dimension_; ++c) next[c] = track.x[c] + track.v[c] * (now - track.begin);
    next += dimension_;
  }
  return kink(e, x).norm();
}

/// What the room of each particle of an element takes of its kink: together they take half.
double Kinks::part(const Element& e, double length) const { return 0.5 * length / e.law().participants; }

/// How fast the tracks may use the kink up: by the speeds as the last particle sees them, or if there may be something
/// outside that they all approach, by their own.
double Kinks::speed(const Element& e) const {
  const auto particles = particles_of(e);
  const bool outside = e.law().is_external();
  double sum = 0;
  for (std::size_t p = 0; p + (outside ? 0 : 1) < particles.size(); ++p) {
    double square = 0;
    for (int c = 0; c < dimension_; ++c) {
      const double v = tracks_[particles[p]].v[c] - (outside ? 0.0 : tracks_[particles.back()].v[c]);
      square += v * v;
    }
    sum += std::sqrt(square);
  }
  return sum;
}

/// Half of the kink is for the time in which the tracks may use it up, the other half for the rooms of its particles in
/// equal parts, or less for this one where another has reached farther in the step that it is in.
Kinks::Share Kinks::share(const Element& e, int particle, double length) const {
  double room = 0.5 * length;
  for (int i : particles_of(e))
    if (i != particle && !fixed_[i]) room -= std::max(part(e, length), tracks_[i].reached);
  return {room, 0.5 * length / speed(e)};
}

/// Room for a particle about its new track.
void Kinks::look(int particle, double now) {
  Track& own = tracks_[particle];
  for_each_element(particle, [&](const Element& e) {
    const double length = this->length(e, now);
    const Share share = this->share(e, particle, length);
    own.room = std::min(own.room, share.room);
    own.until = std::min(own.until, now + share.time);
    for (int i : particles_of(e)) {
      if (i == particle) continue;
      tracks_[i].room = std::min(tracks_[i].room, part(e, length));
      tracks_[i].until = std::min(tracks_[i].until, now + share.time);
    }
  });
}

/// The first time s [s] within h at which an element is farther than `depth` beyond a kink, just after it; h if there is
/// none. An element that begins nearer than that is on no side yet: it must be on one, four times as far away.
///
/// The series about a place at the distance r from a point where the force is singular ends where the motion is 2 r away
/// from it, or nearly so: the nearest singular time is complex, r over the speed from here. Of a motion straight away from
/// it that singularity is absent, but rounding puts it back, and not where a computed coefficient happens to vanish.
Kinks::Crossing Kinks::first_beyond(const Element& e, double h, double depth, const Paths& now) const {
  constexpr int parts = 8;
  Eigen::Vector3d side = kink(e, 0.0, now);
  const double length = side.norm();
  const bool undecided = !(length > depth), is_point = e.law().has_point_kinks(),
             near_point = is_point && length < 1000 * depth;
  const double far = undecided ? 4 * depth : 2 * length;
  const auto beyond = [&](const Eigen::Vector3d& way) {
    return ((undecided || is_point) && way.norm() > far) ||
           (!undecided && way.dot(side) < 0 && way.norm() > depth);
  };
  double before = 0;
  for (int part = 1; part <= parts; ++part) {
    double after = h * part / parts;
    const Eigen::Vector3d way = kink(e, after, now);
    if (beyond(way)) {
      for (double middle = std::midpoint(before, after); before < middle && middle < after;
           middle = std::midpoint(before, after))
        (beyond(kink(e, middle, now)) ? after : before) = middle;
      return {after, is_point};
    }
    if (undecided || !(way.norm() > depth)) continue;
    side = way;
    before = after;
  }
  return {h, near_point};
}

std::vector<Kinks::Step> Kinks::shorten(std::span<Step> steps, double depth, const Paths& now) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Step> others;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const int i = steps[k].particle;
    place_[i] = static_cast<int>(k);
    Track& track = tracks_[i] = {{}, {}, now.now(), infinity, infinity, 0};
    now.at(i, 0.0, track.x);
    now.velocity(i, track.v);
  }
  for (const Step& step : steps)  // fixed particles have no steps of their own
    for_each_element(step.particle, [&](const Element& e) {
      for (int i : particles_of(e))
        if (fixed_[i]) now.at(i, 0.0, tracks_[i].x);
    });
  for (const Step& step : steps) look(step.particle, now.now());

  std::vector<int> doubtful;
  std::vector<double> h(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) h[k] = steps[k].h;
  for (const Step& step : steps) {
    const Track& track = tracks_[step.particle];
    if (step.curve < track.room && now.now() + step.h <= track.until) continue;
    for_each_element(step.particle, [&](const Element& e) {
      const Share share = this->share(e, step.particle, length(e, now.now()));
      if (step.curve < share.room && step.h <= share.time) return;
      const Crossing crossing = first_beyond(e, step.h, depth, now);
      for (int i : particles_of(e)) {
        if (fixed_[i]) continue;
        doubtful.push_back(i);
        if (place_[i] >= 0 && crossing.near_point) steps[place_[i]].near_point = true;
        if (!(crossing.end < step.h)) continue;
        if (place_[i] >= 0)
          h[place_[i]] = std::min(h[place_[i]], crossing.end);
        else
          others.push_back({i, crossing.end, 0.0});
      }
    });
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    tracks_[steps[k].particle].reached = steps[k].curve;
    steps[k].h = h[k];
    place_[steps[k].particle] = -1;
  }
  for (int i : doubtful) doubt(i);
  return others;
}

}  // namespace jetlag
