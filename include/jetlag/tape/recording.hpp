// SPDX-License-Identifier: MIT
#pragma once
// Recording: a law called once with the scalar `Recorded` leaves its operations on a tape.
//
//   Recording recording;
//   Recorded x = recording.input({Input::Kind::position, 0, 0});
//   Tape tape = recording.finish({-4.0 * (x * x)});          // two operations: square, scale
//
// Common subexpressions are recorded once, x * x becomes a square, a product with a value that has no series
// becomes a scaling. A recorded value has no number to compare, and a comparison has no answer yet: it is recorded
// too, for `select`, `min`, `max`, `abs`. `if` on it does not compile.

#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "jetlag/series/comparisons.hpp"
#include "jetlag/series/eigen.hpp"
#include "jetlag/tape/tape.hpp"

namespace jetlag {

class Recording;

/// The recording scalar: a plain number until it meets a value of a recording.
class Recorded {
 public:
  Recorded() = default;
  Recorded(double value) : value_(value) {}  // implicit: numbers are constants of the law
  Recorded(Recording* recording, int node) : recording_(recording), node_(node) {}

  Recording* recording() const { return recording_; }
  int node() const { return node_; }
  double value() const { return value_; }  // of a plain number
  bool is_number() const { return recording_ == nullptr; }
  bool is_number(double x) const { return is_number() && value_ == x; }

  Recorded& operator+=(const Recorded& v);
  Recorded& operator-=(const Recorded& v);
  Recorded& operator*=(const Recorded& v);
  Recorded& operator/=(const Recorded& v);

 private:
  Recording* recording_ = nullptr;
  int node_ = -1;
  double value_ = 0.0;
};

template <>
inline constexpr bool is_series<Recorded> = true;

class Recording {
 public:
  Recording() = default;
  Recording(const Recording&) = delete;  // recorded values point here
  Recording& operator=(const Recording&) = delete;

  Recorded input(Input input);
  Recorded parameter(int number);

  /// The node of a value; a plain number becomes a constant of the tape.
  int node_of(const Recorded& x);
  /// Whether x has no series. Throws std::invalid_argument for a value of another recording.
  bool is_static(const Recorded& x) const;

  /// x as a choice between two values of which one has no series, as 2 max(d, 0) is; nothing if x is none.
  struct Choice {
    int rule;  // Select or BySign
    Recorded by, first, second;
  };
  std::optional<Choice> choice_beside_constant(const Recorded& x);
  /// The same choice between two other values.
  Recorded choose(const Choice& as, const Recorded& first, const Recorded& second);

  /// A new operation, or the one recorded before with the same rule and operands.
  Recorded operation(int rule, std::vector<int> operands, bool is_static);

  /// Whether an operation has been recorded before.
  bool knows(int rule, std::vector<int> operands) const;

  /// Two operations that read each other: a(u..., b), b(u..., a). Recorded as neighbours.
  std::pair<Recorded, Recorded> coupled(int rule_a, int rule_b, std::vector<int> u, bool is_static);

  /// What has been recorded so far; operations come after what they read, but for coupled ones.
  const std::vector<Node>& nodes() const { return tape_.nodes; }

  /// The tape that computes the outputs, without what they do not need.
  Tape finish(const std::vector<Recorded>& outputs);

 private:
  int append(Node node);

  Tape tape_;
  std::map<std::pair<int, std::vector<int>>, int> operations_;
  std::map<std::uint64_t, int> constants_;  // by bits
  std::map<std::tuple<int, int, int>, int> inputs_;
  std::map<int, int> parameters_;
};

namespace detail {
/// The recording among the operands; null when all are plain numbers.
template <class... U>
Recording* recording_of(const U&... u) {
  Recording* found = nullptr;
  ((found = u.recording() ? u.recording() : found), ...);
  return found;
}

/// The nodes of operands of R; those without a series get one where the rule reads it and its result has one.
template <Rule R, class... U>
std::vector<int> operands_of(Recording& recording, bool all_static, const U&... u) {
  std::vector<int> operands;
  int i = 0;
  const auto add = [&](const Recorded& x) {
    int node = recording.node_of(x);
    const Reads reads = R::reads[i++];
    if (reads == Reads::constant && !recording.is_static(x))
      throw std::invalid_argument(std::string(R::name) +
                                  ": an operand that must be constant depends on the motion");
    if (reads != Reads::constant && reads != Reads::first && recording.is_static(x) && !all_static)
      node = recording.operation(rule_id<Embed>, {node}, false).node();
    operands.push_back(node);
  };
  (add(u), ...);
  return operands;
}

/// R on plain numbers, without a recording: the same rule at order 0.
template <Rule R, class... U>
double on_numbers(const U&... u) {
  return R::coefficient(0, ConstantSeries<double>{u.value()}..., ConstantSeries<double>{0.0});
}

/// Functions that are 0 at 0 and have no series there.
template <Rule R>
constexpr bool is_root = std::same_as<R, Sqrt> || std::same_as<R, Cbrt> || std::same_as<R, Power>;

template <Rule R, class... U>
Recorded record(const U&... u);

/// A root of a choice is the choice of the roots. Where a number was chosen, as in pow(max(d, 0), 1.5), its root is a number
/// too, and no series is missing: one rule alone does not see that all coefficients to come are zero.
template <Rule R>
Recorded root_of_choice(Recording& recording, const Recording::Choice& of, const Recorded&) {
  return recording.choose(of, record<R>(of.first), record<R>(of.second));
}
template <Rule R>
Recorded root_of_choice(Recording& recording, const Recording::Choice& of, const Recorded& exponent,
                        const Recorded&) {
  return recording.choose(of, record<R>(exponent, of.first), record<R>(exponent, of.second));
}

template <Rule R, class... U>
Recorded record(const U&... u) {
  Recording* recording = recording_of(u...);
  if (!recording) return on_numbers<R>(u...);
  if constexpr (is_root<R>)
    if (const auto of = recording->choice_beside_constant(std::get<sizeof...(U) - 1>(std::tie(u...))))
      return root_of_choice<R>(*recording, *of, u...);
  const bool all_static = (recording->is_static(u) && ...);
  return recording->operation(rule_id<R>, operands_of<R>(*recording, all_static, u...), all_static);
}

template <Rule A, Rule B, class... U>
std::pair<Recorded, Recorded> record_coupled(const U&... u) {
  Recording* recording = recording_of(u...);
  if (!recording) {
    const ConstantSeries<double> none{0.0};
    const ConstantSeries<double> v{A::coefficient(0, ConstantSeries<double>{u.value()}..., none, none)};
    return {v.value, B::coefficient(0, ConstantSeries<double>{u.value()}..., v, none)};
  }
  const bool all_static = (recording->is_static(u) && ...);
  return recording->coupled(rule_id<A>, rule_id<B>, operands_of<A>(*recording, all_static, u...), all_static);
}
}  // namespace detail

/// v = R(u...), recorded.
template <Rule R, std::same_as<Recorded> S, class... U>
Recorded lift(const U&... u) {
  return detail::record<R>(Recorded(u)...);
}

/// v = A(u..., w), w = B(u..., v), recorded.
template <Rule A, Rule B, std::same_as<Recorded> S, class... U>
std::pair<S, S> lift_coupled(const U&... u) {
  return detail::record_coupled<A, B>(Recorded(u)...);
}

Recorded operator+(const Recorded& u, const Recorded& v);
Recorded operator-(const Recorded& u, const Recorded& v);
Recorded operator*(const Recorded& u, const Recorded& v);
Recorded operator/(const Recorded& u, const Recorded& v);
Recorded operator-(const Recorded& u);

/// u^v: a number or a parameter as exponent, or exp(v log(u)).   Range: u_0 > 0; any u_0 for a whole number.
Recorded pow(const Recorded& u, const Recorded& v);
/// As for jets (series/elementary.hpp).
Recorded hypot(const Recorded& x, const Recorded& y);
Recorded atan2(const Recorded& y, const Recorded& x);
inline Recorded operator+(const Recorded& u) { return u; }

inline Recorded& Recorded::operator+=(const Recorded& v) { return *this = *this + v; }
inline Recorded& Recorded::operator-=(const Recorded& v) { return *this = *this - v; }
inline Recorded& Recorded::operator*=(const Recorded& v) { return *this = *this * v; }
inline Recorded& Recorded::operator/=(const Recorded& v) { return *this = *this / v; }

// ---- choices ---------------------------------------------------------------------------------------------

/// A comparison of recorded values, decided at t = 0 by each element for itself.
class RecordedCondition {
 public:
  explicit RecordedCondition(const Recorded& holds) : holds_(holds) {}

  /// 1 or 0.
  const Recorded& holds() const { return holds_; }

  template <std::same_as<bool> B>
  operator B() const {
    static_assert(!std::same_as<B, bool>,
                  "a recorded law has no branches: use jetlag::select(condition, a, b)");
    return false;
  }

 private:
  Recorded holds_;
};

RecordedCondition operator<(const Recorded& u, const Recorded& v);
RecordedCondition operator<=(const Recorded& u, const Recorded& v);
inline RecordedCondition operator>(const Recorded& u, const Recorded& v) { return v < u; }
inline RecordedCondition operator>=(const Recorded& u, const Recorded& v) { return v <= u; }
RecordedCondition operator&&(const RecordedCondition& a, const RecordedCondition& b);
RecordedCondition operator||(const RecordedCondition& a, const RecordedCondition& b);
RecordedCondition operator!(const RecordedCondition& a);

/// a if the condition holds at t = 0, else b. The one that is not selected may be NaN.
Recorded select(const RecordedCondition& condition, const Recorded& a, const Recorded& b);

/// As for jets (series/comparisons.hpp).
Recorded min(const Recorded& u, const Recorded& v);
Recorded max(const Recorded& u, const Recorded& v);

}  // namespace jetlag

/// Those of the numbers of a law.
template <>
class std::numeric_limits<jetlag::Recorded> : public std::numeric_limits<double> {};

namespace Eigen {
template <>
struct NumTraits<jetlag::Recorded> : GenericNumTraits<jetlag::Recorded> {
  using Real = jetlag::Recorded;
  using NonInteger = jetlag::Recorded;
  using Nested = jetlag::Recorded;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 8,
    MulCost = 32
  };
  static Real dummy_precision() { return NumTraits<double>::dummy_precision(); }
};
}  // namespace Eigen
