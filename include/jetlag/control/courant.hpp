// SPDX-License-Identifier: MIT
#pragma once
// The Courant limit: no step beyond what is stable for the stiffest oscillation of a scene.

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "jetlag/control/control.hpp"
#include "jetlag/control/damping_bound.hpp"
#include "jetlag/control/frequency_bound.hpp"
#include "jetlag/model/model.hpp"
#include "jetlag/truncation/stability.hpp"
#include "jetlag/truncation/stable_rays.hpp"

namespace jetlag {

/// The rate c / m [1/s] at which laws with a damping c slow every particle that is not fixed, if it is the same for all of
/// them: then each oscillation is q'' = -omega^2 q - (c/m) q'. Otherwise 0.
double common_damping(const Model<double>& model);

/// The Courant limit omega h [1]: how long a step may be for all oscillations of frequencies up to omega [rad/s] and of
/// this damping [1/s] to be stable in mean square. 0 where there is none, as for degree 6 without damping.
double courant_limit(const TruncationLaw& law, VelocitySeries velocity, double omega, double damping);

/// Throws std::invalid_argument unless safety is in (0, 1] and limit > 0.
void require_courant(double safety, double limit);

/// How much a bound that is of one state is raised, for what grows until it is taken anew.
constexpr double courant_growth = 1.05;

/// safety * h [s] for each of some modes, h the largest stable step: infinity where nothing bounds it. Where all particles
/// that are not fixed are slowed alike h is limit / omega; otherwise that of StableRays, from the least damping of all to a
/// bound of it. With velocities from the derivative dampings that are not alike are not counted.
///
/// Limits where all are slowed alike take long to find: they are found for octaves of frequencies below the fastest, and kept
/// while that grows or falls little.
class CourantSteps {
 public:
  /// Throws std::invalid_argument for forces whose damping is that of a state with velocities from the derivative: the matrix
  /// of such a step is no polynomial of that of the motion, and nothing is known of modes that are not common to all forces.
  CourantSteps(const Model<double>& model, const TruncationLaw& law, VelocitySeries velocity, double safety);

  /// omega [rad/s] and damping [1/s]: bounds, of one shape; those of a state are raised by courant_growth.
  /// Throws std::invalid_argument as require_courant.
  std::vector<double> operator()(const std::vector<double>& omega, const std::vector<double>& damping);

  /// Throws std::invalid_argument where no modes at all have a stable step.
  void require_stable();

 private:
  bool is_damped() const { return least_ > 0; }

  TruncationLaw law_;
  VelocitySeries velocity_;
  double least_, safety_, growth_, growth_of_damping_, fastest_ = 0;
  std::map<int, double> limits_;    // by octave below the fastest
  std::optional<StableRays> rays_;  // where not all are slowed alike
};

/// safety * h for each particle by its own bounds, infinity where it has none [s]: for clocks of their own. It presumes that a
/// neighbourhood oscillates as if all of it took such steps. Shape (particles).
/// Throws std::invalid_argument as require_courant and require_bounded.
std::vector<double> courant_steps_of_particles(const Model<double>& model, const TruncationLaw& law,
                                               VelocitySeries velocity, double safety);

/// The same at a state, for all laws; bounds that are of this state alone are raised by courant_growth.
/// Throws std::invalid_argument as require_courant and courant_step at a state.
std::vector<double> courant_steps_of_particles(const Model<double>& model, const State<double>& state,
                                               const TruncationLaw& law, VelocitySeries velocity,
                                               double safety);

/// safety * h by the bounds of all at a state [s], infinity where nothing bounds it.
/// Throws std::invalid_argument as CourantSteps, require_finite_tangents and require_damping.
double courant_step(const Model<double>& model, const State<double>& state, const TruncationLaw& law,
                    VelocitySeries velocity, double safety);

/// Another control, cropped at  safety * limit / omega, or where forces damp otherwise than drag at what CourantSteps says.
///
/// Where laws have no stiffness, or act on velocities without a damping, the bounds are those of the present state, times
/// courant_growth. They are taken at the first step
/// and again every `refresh` steps, by the tangents of all elements. Five steps of a power iteration, warm, would cost a
/// third; they would be an estimate from below, which does not see what stiffens elsewhere.
class Courant final : public Control {
 public:
  /// limit: see courant_limit (2 for leapfrog). safety: in (0, 1]. Throws std::invalid_argument, also for a limit of 0.
  Courant(std::unique_ptr<Control> inner, double safety, double limit, double omega);

  /// For the states to come. refresh: >= 1 [steps]. Throws std::invalid_argument as above.
  Courant(std::unique_ptr<Control> inner, double safety, const Model<double>& model, const TruncationLaw& law,
          VelocitySeries velocity, int refresh = usual_refresh);
  static constexpr int usual_refresh = 50;

  int orders_read(const TruncationLaw& law, VelocitySeries velocity) const override {
    return inner_->orders_read(law, velocity);
  }
  ~Courant() override;
  double propose(const Prospect& prospect) override;
  bool is_given() const override { return inner_->is_given(); }
  double past_kinks() const override { return inner_->past_kinks(); }
  std::optional<CourantFrequency> courant_frequency() const override { return frequency_; }
  std::unique_ptr<Control> clone() const override;

 private:
  struct OfStates;
  Courant(const Courant& other);

  std::unique_ptr<Control> inner_;
  double largest_step_;
  CourantFrequency frequency_;
  std::unique_ptr<OfStates> of_states_;  // null: the largest step is that of all states
};

}  // namespace jetlag
