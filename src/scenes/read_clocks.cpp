// SPDX-License-Identifier: MIT
// "schedule": {"type": "block" | "asynchronous", ...}: a clock for each particle.
#include "jetlag/control/courant.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

constexpr double default_tolerance = 1e-9;  // [m]
const Range at_least_one{1, infinite, true, false, "a number >= 1"};

struct Degrees {
  TruncationLaw law;
  bool shared_draw;
  Draw draws = Draw::independent;
};

/// Steps follow from the last two coefficients, so degree 3 is the least.
Degrees read_clock_degrees(const Value& integrator) {
  const std::string type = integrator.at("type").text();
  if (integrator.has("compensated") && integrator.at("compensated").boolean())
    integrator.at("compensated")
        .refuse("false: with a clock for each particle there are no compensated sums");
  if (type == "taylor") {
    integrator.only({"type", "degree", "velocity", "compensated"});
    return {fixed_degree(static_cast<int>(integrator.at("degree").integer(3, largest_degree))), true};
  }
  if (type != "random_taylor")
    integrator.at("type").refuse("taylor or random_taylor where every particle has a clock of its own");
  const Truncation truncation = read_truncation(integrator);
  const auto* law = std::get_if<TruncationLaw>(&truncation);
  if (law == nullptr || law->weighting() != Weighting::coupled_sum)
    integrator.at("law").refuse(
        "geometric, poisson, tail or variance_capped where every particle has a clock of its own");
  if (law->max_degree() < 3)
    integrator.refuse("a law of a largest degree of at least 3 where every particle has a clock of its own");
  const bool shared_draw = integrator.at("shared_draw", true).boolean();
  return {*law, shared_draw, read_draws(integrator, truncation, true, 1)};
}

/// The longest step and the tolerance may stand in a control, as they would for one clock.
void read_steps(const Value& scene, const Value& schedule, const System<double>& system,
                const TruncationLaw& law, ClockOptions& options) {
  double tolerance = default_tolerance;
  if (const auto control = scene.find("control")) {
    if (!control->is_object()) control->refuse("an object with a type");
    const std::string type = control->at("type").text();
    if (type == "fixed") {
      control->only({"type", "step", "courant"});
      options.max_step = control->at("step").number(positive);
    } else if (type == "last_two") {
      control->only({"type", "tolerance", "max_step", "courant"});
      tolerance = control->at("tolerance").number(positive);
      if (const auto most = control->find("max_step")) options.max_step = most->number(positive);
    } else {
      control->at("type").refuse(
          "fixed (its step is the longest) or last_two, or control left out, where every particle has a "
          "clock of its "
          "own: steps follow from schedule.tolerance");
    }
  }
  if (const auto control = scene.find("control"))
    if (const auto courant = read_courant(*control, system)) {
      options.courant = courant->first;
      checked(control->at("courant"),
              [&] { return courant_steps_of_particles(system, law, options.velocity, options.courant); });
    }
  if (const auto most = schedule.find("max_step")) options.max_step = most->number(positive);
  options.tolerance = schedule.at("tolerance", tolerance).number(positive);
}

template <class ScheduleType>
Method method(std::shared_ptr<const System<double>> system, const TruncationLaw& law,
              const typename ScheduleType::Options& options) {
  const double orders = law.mean() + (options.velocity == VelocitySeries::own_series ? 1 : 0) - 1;
  return {[system, law, options] { return std::make_unique<ScheduleType>(*system, law, options); },
          std::nullopt,
          std::numeric_limits<std::int64_t>::max(),
          options.threads,
          std::nullopt,
          orders,
          law.max_degree()};
}

}  // namespace

Method read_clocks(const Value& scene, const Value& schedule, std::shared_ptr<const System<double>> system,
                   std::uint64_t seed) {
  const bool block = schedule.at("type").text() == "block";
  if (block)
    schedule.only({"type", "max_steps", "threads", "tolerance", "max_step", "grading"});
  else
    schedule.only({"type", "max_steps", "threads", "tolerance", "max_step", "grading", "notify"});
  const Value integrator = scene.at("integrator");
  if (!integrator.is_object()) integrator.refuse("an object with a type");
  const Degrees degrees = read_clock_degrees(integrator);

  ClockOptions common;
  common.velocity =
      integrator.at("velocity", "own_series").one_of({"own_series", "derivative"}) == "own_series"
          ? VelocitySeries::own_series
          : VelocitySeries::derivative;
  read_steps(scene, schedule, *system, degrees.law, common);
  common.shared_draw = degrees.shared_draw;
  common.draws = degrees.draws;
  common.seed = seed;
  constexpr std::int64_t most_threads = 1024;
  if (schedule.has("threads"))
    common.threads = static_cast<int>(schedule.at("threads").integer(1, most_threads));

  Method result;
  if (block) {
    BlockSteps::Options options{common};
    options.grading = static_cast<int>(schedule.at("grading", options.grading).integer(0, 64));
    result = method<BlockSteps>(std::move(system), degrees.law, options);
  } else {
    Asynchronous::Options options{common};
    options.grading = schedule.at("grading", options.grading).number(at_least_one);
    options.notify = schedule.at("notify", options.notify).number(positive);
    result = method<Asynchronous>(std::move(system), degrees.law, options);
  }
  if (schedule.has("max_steps"))
    result.max_steps = static_cast<std::uint64_t>(
        schedule.at("max_steps").integer(1, std::numeric_limits<std::int64_t>::max()));
  return result;
}

}  // namespace jetlag
