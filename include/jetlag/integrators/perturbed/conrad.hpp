// SPDX-License-Identifier: MIT
#pragma once
// Additive noise: what a step does not know of the solution, as a normal number.

#include <memory>
#include <vector>

#include "jetlag/integrators/integrator.hpp"

namespace jetlag {

/// Y_{k+1} = Psi_h(Y_k) + xi_k,   xi_k ~ N(0, sigma^2 h^(2p+1)) in each component of the position [m] and the velocity
/// [m/s] of each moving particle, all independent. Psi is the inner method, of order q; p = q is the natural choice.
/// Mean-square order min(p, q), weak order min(2p, q). No invariant survives, momentum neither.
/// Source: Conrad, Girolami, Sarkka, Stuart, Zygalakis, Stat. Comput. 27 (2017) 1065.
class Conrad final : public Integrator {
 public:
  struct Options {
    double step;         // h [s], > 0
    double order;        // p > 0
    double sigma = 1.0;  // > 0, in SI units
    std::uint64_t seed = 1;
  };
  /// inner: a deterministic method that takes steps of any length up to 1e300 s. Throws std::invalid_argument.
  Conrad(const System<double>& system, std::unique_ptr<Integrator> inner, const Options& options);

  double step(State<double>& state, double limit, Report& report) override;
  /// That of the inner method; the noise grows linearly over the step.
  Piece piece() const override;
  const Work& work() const override { return inner_->work(); }

 private:
  std::unique_ptr<Integrator> inner_;
  Options options_;
  std::vector<bool> fixed_;
  Coordinates<double> noise_of_position_, noise_of_velocity_;  // in the last step
  double last_step_ = 0;
  std::uint64_t update_ = 0;
};

}  // namespace jetlag
