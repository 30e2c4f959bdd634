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
// Where particles have clocks of their own, `change` takes the place of begin, and `find_changes` that of up_to_change.
//
// A method that does not follow them refuses such a system: Model's constructor does.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/model/model.hpp"
#include "jetlag/model/path_view.hpp"

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

/// Where particles go from a time on, each on its own series and for as long as it stays on that.
class MotionAhead {
 public:
  explicit MotionAhead(double time) : time_(time) {}
  virtual ~MotionAhead() = default;

  double time() const { return time_; }  // [s]
  /// About that time. A view of what lives as long as this.
  virtual PathView path(int particle) const = 0;
  /// What is left of the step that it is in, or is about to begin [s]; infinity of fixed ones.
  virtual double left(int particle) const = 0;

 protected:
  void set_time(double time) { time_ = time; }

 private:
  double time_;
};

/// All on one clock.
class SeriesAhead final : public MotionAhead {
 public:
  SeriesAhead(const PositionSeries& series, int dimension, double h)
      : MotionAhead(series.time), series_(series), dimension_(dimension), h_(h) {}

  PathView path(int particle) const override {
    return {series_.coefficient(0, particle),
            static_cast<std::ptrdiff_t>(series_.next_order),
            series_.degree,
            series_.unit,
            dimension_,
            series_.weights};
  }
  double left(int) const override { return h_; }

 private:
  PositionSeries series_;
  int dimension_;
  double h_;
};

/// A particle that may not stay on its series so long [s].
struct ShorterStep {
  int particle;
  double h;
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

  // Of particles with clocks of their own; begin as above.

  virtual bool follows_clocks() const { return false; }

  /// Some are about to begin new steps: elements may change all of whose moving particles are among them. Moves `model`;
  /// whether they are others than before.
  virtual bool change(const MotionAhead&, std::span<const int> /*due*/, Model<double>& /*model*/) {
    return false;
  }

  /// They have new series: adds the particles that may not stay on theirs, with how long they may. False: `report` says why
  /// the motion cannot go on.
  virtual bool find_changes(const MotionAhead&, std::span<const int> /*updated*/,
                            std::vector<ShorterStep>& /*shorter*/, Report& /*report*/) {
    return true;
  }

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
  bool follow_clocks() const;
  bool change(const MotionAhead& motion, std::span<const int> due);
  bool find_changes(const MotionAhead& motion, std::span<const int> updated,
                    std::vector<ShorterStep>& shorter, Report& report);

 private:
  Model<double> model_;
  std::vector<std::unique_ptr<ElementsAlong>> parts_;
};

}  // namespace jetlag
