// SPDX-License-Identifier: MIT
#pragma once
// Elements that come and go with the motion, as those between bodies that touch, or between the neighbours of a fluid.
//
// What a system says of them is a ChangingElements: the laws, and how to follow a motion. Who runs the system follows one
// motion with a ModelAlong, which holds the epoch of the model with the elements that there are now:
//
//     begin          the elements at a state; of the state to which the last step has led, those that were left there
//     up_to_change   how far a step may go with them, seen from the series of the positions
//     take           how far it goes
//
// A method that does not follow them refuses such a system: Model's constructor does.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/model/model.hpp"

namespace jetlag {

/// Where the series of the positions stand: coefficient k of component c of particle i, times unit^k, is
/// first[k * next_order + i * next_particle + c], k <= degree; a term k of the motion carries the weight weights[k].
struct PositionSeries {
  double time, unit;  // [s]
  const double* first;
  int degree;
  std::size_t next_order, next_particle;
  const double* weights = nullptr;  // null: 1

  const double* coefficient(int k, int particle) const {
    return first + k * next_order + particle * next_particle;
  }
};

/// One motion, and which elements it meets.
class ElementsAlong {
 public:
  virtual ~ElementsAlong() = default;

  /// Moves `model` to the epoch with the elements at a state; whether they are others than before. What is remembered of the
  /// motion holds for a state that begins where the last step was taken to; any other begins anew.
  virtual bool begin(const State<double>& state, Model<double>& model) = 0;

  /// The longest part of a step of h [s] in which these elements are the right ones, > 0; or 0, and `report` says why there is
  /// none. position: the series about that state.
  virtual double up_to_change(const PositionSeries& position, double h, Report& report) = 0;

  /// Whether a step of h [s] on the series that are taken in the end, as with the weights of what was drawn, is one in which
  /// nothing passes through anything. If not, a shorter one may be tried; a step that is given may not, and `report` says why it
  /// fails.
  virtual bool is_safe(const PositionSeries& position, double h, bool is_given, Report& report) = 0;

  /// The step that was looked at last is taken as far as h [s], to these positions.
  virtual void take(double h, const Coordinates<double>& position) = 0;

  virtual std::unique_ptr<ElementsAlong> clone() const = 0;
};

class ChangingElements {
 public:
  virtual ~ChangingElements() = default;

  /// first_law: the number of the first of its laws in the model.
  virtual std::unique_ptr<ElementsAlong> follow(const Model<double>& model, std::size_t first_law) const = 0;
};

/// The model of a system along one motion.
class ModelAlong {
 public:
  /// Keeps no reference to the system.
  explicit ModelAlong(const System<double>& system);
  ModelAlong(const ModelAlong& other);
  ModelAlong& operator=(const ModelAlong&) = delete;
  ModelAlong(ModelAlong&&) = default;

  /// With the elements that there are now.
  const Model<double>& model() const { return model_; }
  /// Whether no elements come and go.
  bool none() const { return parts_.empty(); }

  // As ElementsAlong has them, for all of its kinds.
  bool begin(const State<double>& state);
  double up_to_change(const PositionSeries& position, double h, Report& report);
  bool is_safe(const PositionSeries& position, double h, bool is_given, Report& report);
  void take(double h, const Coordinates<double>& position);

 private:
  Model<double> model_;
  std::vector<std::unique_ptr<ElementsAlong>> parts_;
};

}  // namespace jetlag
