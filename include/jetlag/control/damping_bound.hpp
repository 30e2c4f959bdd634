// SPDX-License-Identifier: MIT
#pragma once
// Bounds of how fast forces take velocities away, as frequency_bound.hpp bounds oscillations.
//
// With the tangent by velocities C_e = -dF/dv of an element in the place of K_e,
//
//     gamma_e = largest eigenvalue of D^1/2 C_e D^1/2 / w_e,     gamma <= max over elements of gamma_e
//
// bounds u^H C u of all u with u^H M u = 1. A law with a damping c (forces/force.hpp) is one of C_e = c and w_e = c, in any
// state: gamma_e = l_0. Those of other laws are bounds of a state; they have to be symmetric and positive semidefinite, as Kelvin
// and Voigt's are: what turns velocities or drives them has no such rate. Where a run begins that is checked, later it is not.
// Laws that are `unbounded` by their own word are not counted.

#include <memory>
#include <vector>

#include "jetlag/model/model.hpp"

namespace jetlag {

class ElementBounds;

/// The least c / m [1/s] of the laws with a damping c, over all particles that are not fixed: no mode is damped at a lesser
/// rate. 0 without such particles.
double least_damping(const Model<double>& model);

/// Upper bounds [1/s] of what the laws with a damping do in any state: the largest c / m, and that of each particle.
/// Shape (particles).
double damping_bound(const Model<double>& model);
std::vector<double> damping_bounds(const Model<double>& model);

/// Whether a force acts on velocities, has no damping and is not `unbounded`: then a bound is that of a state.
bool damping_needs_state(const Model<double>& model);

/// Throws std::invalid_argument naming a law whose tangent by velocities is not finite, not symmetric or not positive
/// semidefinite at a state: nothing is known of the steps that such forces allow.
void require_damping(const Model<double>& model, const State<double>& state);

/// Upper bounds of the damping [1/s] at one state after another. Of tangents that are not symmetric the symmetric part counts.
class DampingMeter {
 public:
  explicit DampingMeter(const Model<double>& model);
  DampingMeter(const DampingMeter& other);
  ~DampingMeter();

  /// At this state; not finite where a tangent is not.
  double operator()(const State<double>& state);

  /// The same for each particle, over the elements that it takes part in, as FrequencyMeter::of_particles, raised by 5 % where
  /// found anew; empty where a tangent is not finite. Shape (particles).
  std::vector<double> of_particles(const State<double>& state);

  /// Throws std::invalid_argument, as require_damping, for the state of the last bounds.
  void require_positive(double time) const;

 private:
  std::unique_ptr<ElementBounds> elements_;
};

}  // namespace jetlag
