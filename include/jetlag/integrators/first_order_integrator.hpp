// SPDX-License-Identifier: MIT
#pragma once
// y' = f(t, y) as a motion on a line, so that schedules run it: with events, stop times, frames and dense output.
//
//   Lockstep schedule(first_order(lorenz, 3, {.parameters = {10.0, 28.0, 8.0 / 3.0}}));
//   RunOptions options;
//   options.events = {{.name = "z = 27", .g = [](const auto& t, const auto& y, const auto& slope) { return y(2, 0) - 27.0; }}};
//   State<double> state = first_order_state(0.0, {-10.0, -1.0, 40.0});
//   Trajectory solution;
//   record(schedule, state, 20.0, solution, options);              // solution.at(t).position(i, 0) is y_i
//
// Component i of y is the position of particle i, y(i, 0) in an event, and y_i' its velocity, which each step sets.

#include <memory>
#include <utility>
#include <vector>

#include "jetlag/integrators/first_order_taylor.hpp"
#include "jetlag/integrators/integrator.hpp"

namespace jetlag {

/// The state of y: shape (components, 1); y' is zero until a step has been taken.
State<double> first_order_state(double time, const std::vector<double>& y);

class FirstOrderIntegrator final : public Integrator {
 public:
  /// f, size, options: those of FirstOrderTaylor, which says what is thrown.
  template <class F>
  FirstOrderIntegrator(const F& f, int size, FirstOrderOptions<> options = {})
      : size_(size), taylor_(f, size, std::move(options)) {}

  /// Throws std::invalid_argument for a state of another shape than (size, 1).
  double step(State<double>& state, double limit, Report& report) override;
  Piece piece() const override;
  const Work& work() const override { return taylor_.work(); }
  std::string warning() const override { return taylor_.warning(); }

 private:
  int size_;
  FirstOrderTaylor<> taylor_;
  double begin_ = 0, last_step_ = 0;
};

template <class F>
std::unique_ptr<Integrator> first_order(const F& f, int size, FirstOrderOptions<> options = {}) {
  return std::make_unique<FirstOrderIntegrator>(f, size, std::move(options));
}

}  // namespace jetlag
