// SPDX-License-Identifier: MIT
#pragma once
// Random time steps: what a step does not know of the solution, as another length.

#include <memory>
#include <string>
#include <vector>

#include "jetlag/integrators/integrator.hpp"

namespace jetlag {

/// How a random step H is distributed about its mean h [s], with Var H = C h^(2p+1):
///   uniform on (h - h^(p+1/2), h + h^(p+1/2)), C = 1/3, where h^(p-1/2) < 1;
///   lognormal: log H ~ N(log h - s/2, s), s = log(1 + h^(2p-1)), C = 1.
/// Source: Abdulle, Garegnani 2020, section 2; s is derived from the mean and the variance.
enum class StepDistribution { uniform, lognormal };
inline const std::vector<std::string> names_of_step_distributions = {"uniform", "lognormal"};

/// Y_{k+1} = Psi_{H_k}(Y_k), H_k independent, while the time goes on by their mean h. One H for all particles.
/// Psi is the inner method, of order q. Mean-square order min(p, q), weak order min(2p, q). What Psi conserves for all h
/// is conserved, and the flow is symplectic if Psi is. H is a number of seconds: the law is not free of the unit of time.
/// Source: Abdulle, Garegnani, Stat. Comput. 30 (2020) 907.
class RandomStep final : public Integrator {
 public:
  struct Options {
    double step;   // h [s], > 0; for `uniform` < 1 s
    double order;  // p > 1/2
    StepDistribution distribution = StepDistribution::uniform;
    std::uint64_t seed = 1;
  };
  /// inner: a deterministic method that takes steps of any length up to 1e300 s. Throws std::invalid_argument.
  RandomStep(std::unique_ptr<Integrator> inner, const Options& options);

  double step(State<double>& state, double limit, Report& report) override;
  /// That of the inner method over H, run through in h: its velocity is not the derivative of its position.
  Piece piece() const override;
  const Work& work() const override { return inner_->work(); }

  /// H of an update whose mean is h.
  double length(double h, std::uint64_t update) const;

 private:
  std::unique_ptr<Integrator> inner_;
  Options options_;
  std::uint64_t update_ = 0;
  double last_step_ = 0;
};

}  // namespace jetlag
