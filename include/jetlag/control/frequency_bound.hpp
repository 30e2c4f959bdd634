// SPDX-License-Identifier: MIT
#pragma once
// Bounds of the fastest oscillation of a system, from one number for each element.
//
// Let K_e be the tangent of an element, -dF/dx of all its participants, and w_e > 0 any weight. If the mass of a particle
// is shared among its elements in proportion to their weights, then
//
//     l_i = sum_{e at i} w_e / m_i,   D = diag(l_i, i of e),   omega_e^2 = largest eigenvalue of D^1/2 K_e D^1/2 / w_e
//
// is that of the element alone, and with the sum of all x^T K_e x and of all shares
//
//     omega^2 <= max over elements of omega_e^2,
//
// for any masses and mixtures of laws (the mediant inequality of Rayleigh quotients). As a weight serves half of kappa_e,
// the largest |eigenvalue| of K_e. Of a spring that is k, and omega_e^2 = l_0 + l_1.
//
// A law with a stiffness k (forces/force.hpp) need not be looked at: with the roots A_i of the tangent, |A_i u|^2 <= k
// |u|^2, and w_e = k,
//
//     |sum_i A_i x_i|^2 <= (sum_i l_i) sum_i |A_i x_i|^2 / l_i <= (sum_i l_i) k sum_i |x_i|^2 / l_i:
//     omega_e^2 <= sum_{i of e} l_i,
//
// in any state. The tangents of other laws are those of one state, and so is the bound: FrequencyMeter follows it. Laws that
// are `unbounded` by their own word, as gravity, are not counted, nor are velocities and the time. Of a law without a
// potential energy the symmetric part of the tangent counts, which bounds the real part of omega^2. Fixed particles count
// as infinitely heavy.

#include <memory>
#include <string>
#include <vector>

#include "jetlag/model/model.hpp"

namespace jetlag {

class ElementBounds;

/// An upper bound of the fastest angular frequency [rad/s] that the elements with a stiffness can have in any state. 0 when
/// no law of the system has one. What the others do is not bounded: see require_bounded.
double frequency_bound(const Model<double>& model);

/// The same for each particle, over the elements that it takes part in: how fast its neighbourhood may oscillate [rad/s].
/// Shape (particles).
std::vector<double> frequency_bounds(const Model<double>& model);

/// The same of all laws that are not `unbounded`, at a state. That of above where `bounds_need_state` is false.
/// Throws std::invalid_argument naming a law whose tangent is not finite there, or one that reads velocities too and says no
/// damping: for methods that count no damping.
double frequency_bound(const Model<double>& model, const State<double>& state);
std::vector<double> frequency_bounds(const Model<double>& model, const State<double>& state);

/// Throws std::invalid_argument naming a law whose tangent is not finite at a state.
void require_finite_tangents(const Model<double>& model, const State<double>& state);

/// omega_e of each element [rad/s]; 0 of those that bound no step. One list for each law of the model.
/// Throws std::invalid_argument as above.
std::vector<std::vector<double>> frequency_bounds_of_elements(const Model<double>& model,
                                                              const State<double>& state);

/// Whether a force acts on positions, has no stiffness and is not `unbounded`: then a bound is that of a state.
bool bounds_need_state(const Model<double>& model);

/// The name of the first force that acts on positions and has no stiffness: bounds without a state go without it. Empty if
/// there is none.
std::string unbounded_force(const Model<double>& model);

/// Throws std::invalid_argument naming such a force, unless it says itself that it is `unbounded`, as gravity does: then no
/// fraction of frequency_bound is known to be a safe step in all states.
void require_bounded(const Model<double>& model);

/// frequency_bound at one state after another, each by tangents alone and with few eigenvalues: the weights are those of the
/// first state, scaled with the norms of the tangents since. One that is not finite is returned as such. Of laws that read
/// velocities too, the tangents by positions count, at the velocities of the state.
class FrequencyMeter {
 public:
  explicit FrequencyMeter(const Model<double>& model);
  FrequencyMeter(const FrequencyMeter& other);
  ~FrequencyMeter();

  /// An upper bound of the fastest frequency at this state [rad/s].
  double operator()(const State<double>& state);

  /// frequency_bounds [rad/s] at one state after another; empty where a tangent is not finite. Shape (particles). That of an
  /// element stays while it still is a bound and its tangent has not become less by a fifth; found anew it is raised by 2.5 %.
  std::vector<double> of_particles(const State<double>& state);

 private:
  std::unique_ptr<ElementBounds> elements_;
};

}  // namespace jetlag
