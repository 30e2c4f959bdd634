// SPDX-License-Identifier: MIT
#pragma once
// The same step every time.

#include "jetlag/control/control.hpp"

namespace jetlag {

class FixedStep final : public Control {
 public:
  /// step [s], > 0.
  explicit FixedStep(double step) : step_(step) { require_positive("step", step); }
  double step() const { return step_; }
  int orders_read(const TruncationLaw&, VelocitySeries) const override { return 0; }
  double propose(const Prospect&) override { return step_; }
  double longest() const override { return step_; }
  bool is_given() const override { return true; }
  double past_kinks() const override { return std::numeric_limits<double>::infinity(); }
  std::unique_ptr<Control> clone() const override { return std::make_unique<FixedStep>(*this); }

 private:
  double step_;
};

}  // namespace jetlag
