// SPDX-License-Identifier: MIT
#pragma once
// Kinks: where the force of an element has a kink or jumps, as at the surface of a floor and where the ends of a spring
// meet (forces/force.hpp). The series of a step knows the side on which the step begins, and no sign of the other is in
// it: a falling mass has the series of free fall down to the surface, and through it. So a step ends just beyond a kink.
//
// Looking at every element at every step would cost too much. A particle that is looked at gets a track, the straight line
// on which it moves, and room about it. The tracks of the particles of an element keep half of its kink until `until`, and
// their rooms together are no larger than that half: before one of them leaves its room, or the time is over, the element
// cannot have reached its kink. Neighbours move with each other, so that rooms last. The path of an element is followed
// only where even a new room is too small for a step: at eighths of it, then by bisection. A kink that is crossed and
// crossed back within an eighth of a step may be missed.

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "jetlag/model/model.hpp"

namespace jetlag {

/// Where particles are, and where their series lead them from now on.
class Paths {
 public:
  virtual ~Paths() = default;

  /// [s]
  virtual double now() const = 0;
  /// The position of a particle s [s] from now, and its velocity now. Room for 3 components.
  virtual void at(int particle, double s, double* x) const = 0;
  virtual void velocity(int particle, double* v) const = 0;
};

/// What rounding may hide of a place [m] among positions of this size, computed in some hundred operations.
constexpr double depth_of_rounding(double size) {
  return 512 * std::numeric_limits<double>::epsilon() * size;
}

class Kinks {
 public:
  Kinks() = default;

  explicit Kinks(const Model<double>& model);

  /// Whether no moving particle has an element with a kink.
  bool none() const { return laws_.empty(); }

  /// For particles that have been moved by others: nothing is known of them any more.
  void forget();

  /// What is known of the particles.
  struct Track {
    double x[3], v[3], begin;  // position [m] at a time [s] and velocity [m/s]
    double room;               // [m]; below 0: none
    double until;              // [s]
    double reached;            // how far off the track the step leads that the particle is in [m]
  };
  /// Goes on with the particles of another motion of the same system; nothing is known of them where `tracks` is empty.
  void exchange(std::vector<Track>& tracks) {
    std::swap(tracks, tracks_);
    if (tracks_.empty()) forget();
  }

  /// A step that a particle is about to take from now on.
  struct Step {
    int particle;
    double h;      // [s]
    double curve;  // a bound of how far it leads from the straight line of the velocity now [m]

    /// Whether it begins within a thousand depths of a kink that is a point, as where the ends of a spring meet, or has
    /// been shortened there. The distance at which it is passed may be as small, and then the force turns in no time; and
    /// near it orders of the series may be rounding. So no order of it may take over, whatever the length of the step.
    bool near_point = false;
  };

  /// Takes a step, now [s], from a position and a velocity, shape (dimension), that stays in the room of its particle; false
  /// where it may not, and nothing is taken.
  bool take(const Step& step, double now, const double* x, const double* v) {
    const Track& track = tracks_[step.particle];
    double off = 0, change = 0;
    for (int c = 0; c < dimension_; ++c) {
      const double dx = x[c] - (track.x[c] + track.v[c] * (now - track.begin)), dv = v[c] - track.v[c];
      off += dx * dx;
      change += dv * dv;
    }
    const double reached = std::sqrt(off) + std::sqrt(change) * step.h + step.curve;
    if (!(reached < track.room && now + step.h <= track.until)) return false;
    tracks_[step.particle].reached = reached;
    return true;
  }

  /// Whether a particle has no room: the step that it is in may cross a kink.
  bool in_doubt(int particle) const { return tracks_[particle].room < 0; }
  void doubt(int particle) { tracks_[particle].room = -1; }

  /// Takes steps that may leave their rooms. A step in which an element comes farther than `depth` [m] > 0 beyond a kink is
  /// shortened to end there; of two particles that go apart, where they are twice as far away. Returns the other moving
  /// particles of such elements that are in a step and not in `steps`: how soon they meet the kink. The same for any order
  /// of steps.
  std::vector<Step> shorten(std::span<Step> steps, double depth, const Paths& now);

 private:
  using Law = Model<double>::Law;
  struct Element {
    const Law* of;
    int number;
    const RecordedLaw& law() const { return of->elements().law; }
  };

  template <class F>
  void for_each_element(int particle, F use) const {
    for (const auto& law : laws_)
      for (const int e : law->of(particle)) use(Element{law.get(), e});
  }
  std::span<const int> particles_of(const Element& e) const { return e.of->particles_of(e.number); }
  /// What an element leaves to a particle that is looked at: room, for a time.
  struct Share {
    double room, time;
  };
  struct Crossing {
    double end;  // [s] from now
    bool near_point;
  };
  Eigen::Vector3d kink(const Element& e, const double* x) const;
  Eigen::Vector3d kink(const Element& e, double s, const Paths& now) const;
  double length(const Element& e, double now) const;
  double part(const Element& e, double length) const;
  double speed(const Element& e) const;
  Share share(const Element& e, int particle, double length) const;
  void look(int particle, double now);
  Crossing first_beyond(const Element& e, double h, double depth, const Paths& now) const;

  int dimension_ = 0;
  std::vector<bool> fixed_;
  std::vector<std::shared_ptr<const Law>> laws_;  // those with kinks that move
  std::vector<Track> tracks_;                     // of the particles
  std::vector<int> place_;                        // in the steps to be shortened; -1 elsewhere
};

}  // namespace jetlag
