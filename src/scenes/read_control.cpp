// SPDX-License-Identifier: MIT
// "control" of a series: how far to go. To add one, write its reader and add its record.
#include <algorithm>
#include <cmath>
#include <limits>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/halve_double.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/control/variance_target.hpp"
#include "scenes/choices.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

double read_max_step(const Value& control) {
  const auto value = control.find("max_step");
  return value ? value->number(positive) : infinite;
}

namespace {

std::unique_ptr<Control> read_fixed(const Value& control, const TruncationLaw&) {
  return std::make_unique<FixedStep>(control.at("step").number(positive));
}

std::unique_ptr<Control> read_jorba_zou(const Value& control, const TruncationLaw&) {
  return std::make_unique<JorbaZou>(read_max_step(control));
}

std::unique_ptr<Control> read_last_two(const Value& control, const TruncationLaw&) {
  return std::make_unique<LastTwo>(control.at("tolerance").number(positive), read_max_step(control));
}

std::unique_ptr<Control> read_variance(const Value& control, const TruncationLaw&) {
  const double step = control.at("step").number(positive), max_step = read_max_step(control),
               random = control.at("tolerance_random").number(positive),
               bias = control.at("tolerance_bias").number(positive);
  return checked(control, [&] { return std::make_unique<VarianceTarget>(step, max_step, random, bias); });
}

std::unique_ptr<Control> read_halve_double(const Value& control, const TruncationLaw& law) {
  const double step = control.at("step").number(positive), max_step = read_max_step(control),
               least = control.at("min_variance").number(positive),
               most = control.at("max_variance").number(positive);
  return checked(
      control, [&] { return std::make_unique<HalveDouble>(step, max_step, least, most, law.min_degree()); });
}

const SceneKey longest_step{"max_step", "no step is longer [s], > 0", "none"},
    first_step{"step", "the first one [s], > 0", "required"};

}  // namespace

const std::vector<ControlRecord>& control_records() {
  static const std::vector<ControlRecord> records = {
      {.name = "fixed",
       .what = "Steps of one length",
       .keys = {{"step", "[s], > 0", "required"}},
       .read = read_fixed},
      {.name = "jorba_zou",
       .what = "From the last two coefficients: as long as the series lets rounding be the error",
       .keys = {longest_step,
                {"tolerance", "of `taylor`, in place of integrator.degree: between 0 and 1", "none"}},
       .read = read_jorba_zou},
      {.name = "last_two",
       .what = "From the last two coefficients, to a tolerance",
       .keys = {longest_step, {"tolerance", "of a step [m], > 0", "required"}},
       .read = read_last_two},
      {.name = "variance",
       .what = "To a random error and to a bias of a step",
       .keys = {first_step,
                longest_step,
                {"tolerance_random", "random error of a position in one step [m], > 0", "required"},
                {"tolerance_bias", "what is left out of it [m], > 0", "required"}},
       .read = read_variance,
       .reads_variance = true},
      {.name = "halve_double",
       .what = "Halved above one variance, doubled below another",
       .keys = {first_step,
                longest_step,
                {"min_variance", "doubled below it [m^2], > 0", "required"},
                {"max_variance", "halved above it [m^2], > 4^(m+1) min_variance", "required"}},
       .read = read_halve_double,
       .reads_variance = true}};
  return records;
}

SceneKeys control_keys() {
  std::vector<Choice> choices;
  for (const ControlRecord& record : control_records()) choices.push_back({record.name, record.keys});
  return joined({{choice("control.type", names_of(control_records()), "required")},
                 merged("control", choices),
                 {method_keys::courant, method_keys::courant_refresh}});
}

void require_control_for(const Truncation& law, const Value& control) {
  const auto* known = std::get_if<TruncationLaw>(&law);
  if (known != nullptr && known->weighting() == Weighting::coupled_sum) return;
  if (!named(control_records(), control.at("type").text()).reads_variance && !control.has("courant")) return;
  std::string others;
  for (const ControlRecord& record : control_records())
    if (!record.reads_variance) others += (others.empty() ? "" : ", ") + record.name;
  control.refuse("one of " + others +
                 " without courant where integrator.law is sequential or single_term: the others need the "
                 "variance of the law");
}

namespace {

/// Without elements that come and go: barriers give no bound.
Model<double> always_there(const System<double>& system) { return Model<double>::without_changing(system); }

void refuse_without_stiffness(const Value& courant) {
  courant.refuse("left out: no force of this scene has a stiffness that limits the step");
}

}  // namespace

std::optional<std::pair<double, double>> read_courant(const Value& control, const System<double>& system,
                                                      const State<double>& start) {
  const auto courant = control.find("courant");
  if (!courant) return std::nullopt;
  const double safety = courant->number(fraction),
               omega = checked(*courant, [&] { return frequency_bound(system, start); });
  if (omega == 0) refuse_without_stiffness(*courant);
  return std::pair(safety, omega);
}

std::optional<double> read_courant_of_series(const Value& control, const System<double>& system,
                                             const State<double>& start, const TruncationLaw& law,
                                             VelocitySeries velocity) {
  const auto courant = control.find("courant");
  if (!courant) return std::nullopt;
  const double safety = courant->number(fraction),
               step = checked(*courant, [&] {
                 return courant_step(always_there(system), start, law, velocity, safety);
               });
  if (!std::isfinite(step)) refuse_without_stiffness(*courant);
  return safety;
}

std::unique_ptr<Control> read_control(const Value& control, const TruncationLaw& law, VelocitySeries velocity,
                                      const System<double>& system, const State<double>& start) {
  auto inner = named(control_records(), control.at("type").text()).read(control, law);
  const auto courant = read_courant_of_series(control, system, start, law, velocity);
  if (!courant) {
    if (const auto refresh = control.find("courant_refresh")) refresh->refuse("left out where courant is");
    return inner;
  }
  const auto refresh = static_cast<int>(
      control.at("courant_refresh", Courant::usual_refresh).integer(1, std::numeric_limits<int>::max()));
  return checked(control.at("courant"), [&] {
    return std::make_unique<Courant>(std::move(inner), *courant, always_there(system), law, velocity,
                                     refresh);
  });
}

}  // namespace jetlag
