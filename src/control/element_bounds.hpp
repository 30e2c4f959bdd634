// SPDX-License-Identifier: MIT
#pragma once
// One number for each element that bounds its share of a symmetric operator over the masses: see
// jetlag/control/frequency_bound.hpp. By positions the tangents are -dF/dx, the numbers omega_e^2; by velocities -dF/dv and
// gamma_e.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "control/laws_with.hpp"
#include "jetlag/model/model.hpp"
#include "model/element_tangents.hpp"

namespace jetlag {

/// What a law says of its parameters that bounds its tangents in all states: `stiffness` or `damping`.
inline RecordedLaw::OfParameters RecordedLaw::* known_bound(Input::Kind by) {
  return by == Input::Kind::position ? &RecordedLaw::stiffness : &RecordedLaw::damping;
}

/// Whether a law reads these inputs and says no such bound; and whether its tangents are to be looked at: not where it says
/// that it is `unbounded`.
bool has_unknown_bound(const Model<double>::Law& law, Input::Kind by);
bool needs_tangents(const Model<double>::Law& law, Input::Kind by);

/// The first such law; null if there is none.
const RecordedLaw* first_unknown(const Model<double>& model, Input::Kind by);
const RecordedLaw* first_that_needs_tangents(const Model<double>& model, Input::Kind by);

/// The sum of known bounds / mass at each particle, and the largest sum over the participants of an element at each.
std::vector<double> known_loads(const Model<double>& model, Input::Kind by);
std::vector<double> known_bounds(const Model<double>& model, Input::Kind by);

/// 0 for none.
double largest(const std::vector<double>& bounds);

/// All elements at one state after another. The weights are those of the first state, scaled with the norms of the tangents
/// since.
class ElementBounds {
 public:
  /// On the stack: a tangent of as many participants as there may be.
  static constexpr int most_rows = 3 * most_participants;
  using Tangent =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_rows, most_rows>;

  ElementBounds(const Model<double>& model, Input::Kind by);
  ElementBounds(const ElementBounds& other);
  ElementBounds(ElementBounds&&) = default;

  struct WeightedTangents {
    std::size_t number;  // of the law
    ElementTangents tangents;
    std::vector<double> weight,
        norm;  // of each element, and Frobenius's norm of the tangent when it was found
    std::vector<double> square, size;  // that bounds its number, and the norm of `shared` when it was found
  };
  const std::vector<WeightedTangents>& laws() const { return laws_; }
  const std::vector<double>& load() const { return load_; }
  const Model<double>& model() const { return model_; }

  /// Moves on to a state. False where a tangent is not finite.
  bool take(const State<double>& state);

  /// The name of the law that was not finite.
  const std::string& culprit() const { return culprit_; }

  /// The first law with a tangent that is not symmetric and positive semidefinite to 1e-6 of its norm; null if there is none.
  const RecordedLaw* first_not_positive() const;

  /// The number of an element, 0 where nothing acts.
  double square(const WeightedTangents& law, int e) const;

  /// Bounds of the numbers around each particle. That of an element stays while it still is a bound and its tangent has not
  /// become less by a fifth; found anew it is raised by 5 %.
  std::vector<double> bounds();

  /// The largest number, to 1e-9: begins with the element that had it last, with which most need only be compared.
  double largest_square();

 private:
  bool not_finite(const WeightedTangents& law);
  Tangent shared(const WeightedTangents& law, int e) const;
  void bound_anew(WeightedTangents& law, int e) const;
  static void weigh(WeightedTangents& law, int e, double norm);

  Model<double> model_;
  Input::Kind by_;
  std::vector<double> known_load_, load_;
  std::vector<WeightedTangents> laws_;
  std::string culprit_;
  std::size_t largest_law_ = 0;
  int largest_element_ = 0;
};

}  // namespace jetlag
