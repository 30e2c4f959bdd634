// SPDX-License-Identifier: MIT
#pragma once
// Lockstep: one clock for all particles.

#include <memory>

#include "jetlag/integrators/integrator.hpp"
#include "jetlag/schedule/schedule.hpp"

namespace jetlag {

/// The time is a compensated sum of the steps, so that it does not drift; the last step is cropped to end at `until`.
class Lockstep final : public Schedule {
 public:
  explicit Lockstep(std::unique_ptr<Integrator> integrator) : integrator_(std::move(integrator)) {}
  Report run(State<double>& state, double until, const RunOptions& options) override;
  const Work& work() const override { return integrator_->work(); }
  std::string warning() const override { return integrator_->warning(); }
  std::optional<CourantFrequency> courant_frequency() const override {
    return integrator_->courant_frequency();
  }

 private:
  Report take_steps(State<double>& state, double until, const RunOptions& options);

  std::unique_ptr<Integrator> integrator_;
};

}  // namespace jetlag
