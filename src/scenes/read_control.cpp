// SPDX-License-Identifier: MIT
// "control": how far to go. To add one, write its reader and add its line to the register.
#include <algorithm>
#include <limits>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/halve_double.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/control/variance_target.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

double read_max_step(const Value& control) {
  const auto value = control.find("max_step");
  return value ? value->number(positive) : infinite;
}

namespace {

std::unique_ptr<Control> read_fixed(const Value& control, const TruncationLaw&) {
  control.only({"type", "step", "courant"});
  return std::make_unique<FixedStep>(control.at("step").number(positive));
}

std::unique_ptr<Control> read_jorba_zou(const Value& control, const TruncationLaw&) {
  control.only({"type", "max_step", "tolerance", "courant"});
  return std::make_unique<JorbaZou>(read_max_step(control));
}

std::unique_ptr<Control> read_last_two(const Value& control, const TruncationLaw&) {
  control.only({"type", "max_step", "tolerance", "courant"});
  return std::make_unique<LastTwo>(control.at("tolerance").number(positive), read_max_step(control));
}

std::unique_ptr<Control> read_variance(const Value& control, const TruncationLaw&) {
  control.only({"type", "step", "max_step", "tolerance_random", "tolerance_bias", "courant"});
  const double step = control.at("step").number(positive), max_step = read_max_step(control),
               random = control.at("tolerance_random").number(positive),
               bias = control.at("tolerance_bias").number(positive);
  return checked(control, [&] { return std::make_unique<VarianceTarget>(step, max_step, random, bias); });
}

std::unique_ptr<Control> read_halve_double(const Value& control, const TruncationLaw& law) {
  control.only({"type", "step", "max_step", "min_variance", "max_variance", "courant"});
  const double step = control.at("step").number(positive), max_step = read_max_step(control),
               least = control.at("min_variance").number(positive),
               most = control.at("max_variance").number(positive);
  return checked(
      control, [&] { return std::make_unique<HalveDouble>(step, max_step, least, most, law.min_degree()); });
}

struct ControlReader {
  const char* type;
  std::unique_ptr<Control> (*read)(const Value& control, const TruncationLaw& law);
};
constexpr ControlReader controls[] = {{"fixed", read_fixed},
                                      {"jorba_zou", read_jorba_zou},
                                      {"last_two", read_last_two},
                                      {"variance", read_variance},
                                      {"halve_double", read_halve_double}};

}  // namespace

bool is_fixed(const Value& control) { return chosen(control, controls).read == read_fixed; }

std::optional<std::pair<double, double>> read_courant(const Value& control, const System<double>& system) {
  const auto courant = control.find("courant");
  if (!courant) return std::nullopt;
  const double safety = courant->number(fraction), omega = frequency_bound(system);
  if (omega == 0) courant->refuse("left out: no force of this scene has a stiffness that limits the step");
  checked(*courant, [&] { require_bounded(system); });
  return std::pair(safety, omega);
}

std::unique_ptr<Control> read_control(const Value& control, const TruncationLaw& law, VelocitySeries velocity,
                                      const System<double>& system) {
  auto inner = chosen(control, controls).read(control, law);
  const auto courant = read_courant(control, system);
  if (!courant) return inner;
  return checked(control.at("courant"), [&] {
    const auto [safety, omega] = *courant;
    return std::make_unique<Courant>(std::move(inner), safety,
                                     courant_limit(law, velocity, omega, common_damping(system)), omega);
  });
}

}  // namespace jetlag
