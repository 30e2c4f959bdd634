// SPDX-License-Identifier: MIT
#pragma once
// An observable: a function of time, positions and velocities, and its Taylor series along a motion.
//
//   Observable height = [](const auto& t, const auto& x, const auto& v) { return x(0, 1) - 0.5; };
//   for (const Crossing& c : crossings(piece, height)) ...         when component 1 of particle 0 passes 1/2
//
// The function is a template over its scalar, like a force law, and is called once, with a scalar that records:
// x(i, c) and v(i, c) are component c of particle i. Only the particles that it reads cost anything.
//
// The series. Along a piece of degree N a function that is linear in time, positions and velocities is a polynomial of
// degree N, exactly. Any other is expanded to degree max(2N, 40), and anew from the middle of an interval where its
// last two terms are not below rounding at the end, or where its value there is not g: what is found is g of the method's
// own motion, not g truncated at N. Its values are looked at in three places of each series and at the end: what is narrower
// than that, and below rounding from where it is seen, is missed.
//
// Kinks and jumps. A series ends where a choice in g changes (abs, min, max, select, the root of what reaches zero), to one
// ulp of time, and another one begins. Where neither converges, in 2^-30 of a step, g is followed by its values, also from a
// singular point on which a step begins: a change of sign is sought by bisection, and is a crossing if g goes to zero there
// (cbrt), none if it jumps or has a pole.

#include <concepts>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "jetlag/motion/piece.hpp"
#include "jetlag/tape/program.hpp"
#include "jetlag/tape/recording.hpp"

namespace jetlag {

class Observable {
 public:
  /// g(t, x, v) returns a scalar; see above. Throws what g throws.
  template <class G>
    requires(!std::same_as<G, Observable>)
  Observable(const G& g) {  // implicit: a lambda is an observable
    Recording recording;
    const auto coordinates = [&recording](Input::Kind kind) {
      return [&recording, kind](int particle, int component) {
        return recording.input({kind, particle, component});
      };
    };
    const Recorded t = recording.input({Input::Kind::time, 0, 0});
    const Recorded value = g(t, coordinates(Input::Kind::position), coordinates(Input::Kind::velocity));
    tape_ = with_conditions(recording.finish({value}));
  }

  const Tape& tape() const { return tape_; }

  /// Throws std::invalid_argument, which begins with `who`, when it reads a coordinate that does not exist.
  void require_fit(const std::string& who, int particles, int dimension) const;

 private:
  Tape tape_;
};

/// c(t - begin) = sum_k c_k (t - begin)^k on [begin, end].
struct LocalSeries {
  double begin, end;
  std::vector<double> c;

  /// How it follows the one before: in one value, in another value, or with another sign, or none, by way of zero, without a
  /// series there.
  enum class Join { value, jump, zero } join = Join::value;
  bool to_change = false;  // whether it ends where a choice in g changes, a few roundings later

  double at(double t) const;
  /// Whether it exists: not where g is singular (1/x at 0), nor beyond (sqrt(x) at x < 0).
  bool is_finite() const;
};

/// Computes an observable, again and again: it holds the memory for that.
class ObservableSeries {
 public:
  explicit ObservableSeries(const Observable& g);

  /// g of a state.
  double operator()(const State<double>& state);

  /// g along a piece, see above: one series, or several that follow each other. Terms at the end that are smaller than
  /// 2^-60 of the whole are left out. Where there is no series, or more than 10000 of them, the last one is not finite.
  /// Throws std::invalid_argument for a piece whose unit of time is not 1 s.
  std::vector<LocalSeries> along(const PieceView& piece);

  /// The sign of g all along a piece where g is linear and, by more than rounding, its first term outweighs the others,
  /// |c_0| > sum_{k>0} |c_k| h^k, or it goes one way, |c_1| > sum_{k>1} k |c_k| h^(k-1), and has one sign at both ends; 0 where
  /// that does not tell.
  int sign_along(const PieceView& piece) const;

 private:
  /// What a linear g reads: g = constant + sum of weight times input.
  struct Term {
    Input input;
    double weight;
  };
  void find_linear_terms();
  std::vector<double> combined(const PieceView& piece);

  using Rows = std::vector<std::vector<double>>;  // the polynomial of each input
  /// The motion of the inputs from a time on.
  struct Course {
    Rows rows;
    double begin;
    Course from(double t) const;
  };
  void append(Course course, double end, int halvings, std::vector<LocalSeries>& all);
  bool passes(Course& course, double end, std::vector<LocalSeries>& all);
  void append_values(const Course& course, double end, std::vector<LocalSeries>& all);
  std::vector<double> expand(const Course& course);
  bool conditions_converge(double h);
  double first_change(double h);
  bool is_right(const Course& course, const LocalSeries& series, double s);
  double value(const Course& course, double t);
  double coefficient(int k);

  Blocks<double> blocks_;
  int orders_ = 0;  // of the last expansion
  bool is_linear_ = false;
  double constant_ = 0;
  std::vector<Term> terms_;  // of a linear g
};

/// A time at which an observable changes sign.
struct Crossing {
  double time;  // [s] the first double at or after the change
  bool rising;  // from negative to positive
  friend bool operator==(const Crossing&, const Crossing&) = default;
};

/// All crossings in (begin, end] of finite series that follow each other, in order: the polynomial changes sign between
/// the double before `time` and `time`, in exact arithmetic. See series/calculus/roots.hpp for roots close together and touches.
/// Where g is zero for a while, or where two series join, the signs before and after tell: g crosses where it leaves zero to
/// the other side than it came from. A jump is none, and after it g begins anew.
/// before: the sign from which g has come to zero, where it begins there; 0: it is left, not crossed.
/// Neighbours that join in one value do so to rounding only. Where a later one begins on another side than the earlier one
/// has ended, which would hide a crossing or repeat it, its coefficient 0 becomes the value at that end, or zero.
std::vector<Crossing> crossings(std::span<LocalSeries> series, int before = 0);

/// As above for an observable along a piece. Throws std::invalid_argument when it reads a coordinate that does not
/// exist, and where its series is not finite.
std::vector<Crossing> crossings(const PieceView& piece, const Observable& g);

}  // namespace jetlag
