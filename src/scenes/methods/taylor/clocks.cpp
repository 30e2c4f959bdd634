// SPDX-License-Identifier: MIT
// A clock for each particle.
#include "jetlag/control/courant.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"
#include "scenes/methods/taylor/series.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

const SceneKeys clock_keys{
    {"integrator.type",
     "`taylor` with a `degree` of 3 to 256; `random_taylor` with a law known beforehand, of a largest degree "
     ">= 3; with their keys, but without compensated sums",
     "required"},
    {"schedule.tolerance", "error of a step of a particle [m], > 0", "1e-9"},
    {"schedule.max_step", "no step is longer [s], > 0", "none"},
    max_steps,
    threads,
    choice("control.type", {"fixed", "last_two"}, "none", "; or no control at all"),
    under({"fixed"}, {"control.step", "the longest step [s], > 0", "required"}),
    under({"last_two"}, {"control.tolerance", "as schedule.tolerance, which precedes [m], > 0", "required"}),
    under({"last_two"}, max_step),
    {"control.courant",
     "no step exceeds this fraction of the limit of its particle, of solids that of their present state, > 0 "
     "and <= 1",
     "none"}};

constexpr double default_tolerance = 1e-9;  // [m]
const Range at_least_one{1, infinite, true, false, "a number >= 1"};

struct Degrees {
  TruncationLaw law;
  bool shared_draw;
  Draw draws = Draw::independent;
};

/// Steps follow from the last two coefficients, so degree 3 is the least.
Degrees read_degrees(const Value& integrator) {
  const std::string type = integrator.at("type").text();
  if (integrator.has("compensated") && integrator.at("compensated").boolean())
    integrator.at("compensated")
        .refuse("false: with a clock for each particle there are no compensated sums");
  if (type == "taylor")
    return {fixed_degree(static_cast<int>(integrator.at("degree").integer(3, largest_degree))), true};
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
                const State<double>& start, const TruncationLaw& law, ClockOptions& options) {
  double tolerance = default_tolerance;
  if (const auto control = scene.find("control")) {
    if (!control->is_object()) control->refuse("an object with a type");
    const std::string type = control->at("type").text();
    if (type != "fixed" && type != "last_two")
      control->at("type").refuse(
          "fixed (its step is the longest) or last_two, or control left out, where every particle has a "
          "clock of its "
          "own: steps follow from schedule.tolerance");
    control->only(allowed(clock_keys, "control", type));
    if (type == "fixed") {
      options.max_step = control->at("step").number(positive);
    } else {
      tolerance = control->at("tolerance").number(positive);
      options.max_step = read_max_step(*control);
    }
    if (const auto courant = read_courant_of_series(*control, system, start, law, options.velocity)) {
      options.courant = *courant;
      checked(control->at("courant"), [&] {
        return courant_steps_of_particles(system, start, law, options.velocity, options.courant);
      });
    }
  }
  if (const auto most = schedule.find("max_step")) options.max_step = most->number(positive);
  options.tolerance = schedule.at("tolerance", tolerance).number(positive);
}

/// What both have in common; ScheduleType: how the steps of neighbours go together.
template <class ScheduleType, class ReadMore>
Method read_clocks(const ScheduleArguments& arguments, ReadMore read_more) {
  const auto& [scene, integrator, schedule, system, seed, threads, start] = arguments;
  const Degrees degrees = read_degrees(integrator);
  const TruncationLaw& law = degrees.law;
  typename ScheduleType::Options options;
  options.velocity = read_velocity_series(integrator);
  read_steps(scene, schedule, *system, start, law, options);
  options.shared_draw = degrees.shared_draw;
  options.draws = degrees.draws;
  options.seed = seed;
  options.threads = threads;
  read_more(schedule, options);
  Method method;
  method.schedule = [system = system, law, options] {
    return std::make_unique<ScheduleType>(*system, law, options);
  };
  method.mean_orders = law.mean() + (options.velocity == VelocitySeries::own_series ? 1 : 0) - 1;
  method.largest_degree = law.max_degree();
  return method;
}

Method read_block(const ScheduleArguments& arguments) {
  return read_clocks<BlockSteps>(arguments, [](const Value& schedule, BlockSteps::Options& options) {
    options.grading = static_cast<int>(schedule.at("grading", options.grading).integer(0, 64));
  });
}

Method read_asynchronous(const ScheduleArguments& arguments) {
  return read_clocks<Asynchronous>(arguments, [](const Value& schedule, Asynchronous::Options& options) {
    options.grading = schedule.at("grading", options.grading).number(at_least_one);
    options.notify = schedule.at("notify", options.notify).number(positive);
  });
}

}  // namespace

MethodRecord block() {
  return {
      .name = "block",
      .what = "Taylor's method with a clock for each particle, on powers of two",
      .when =
          "A scene that is stiff, or fast, in one place only: the rest takes longer steps at the "
          "accuracy of one clock. Of the two kinds of clocks the one to take.",
      .declared = {{"schedule/block.hpp", "BlockSteps"}, {"control/last_two.hpp", "last_two_step"}},
      .keys = joined(
          {{{"schedule.grading", "levels between neighbours, 0 to 64; 0: any number", "1"}}, clock_keys}),
      .examples = {R"({"integrator": {"type": "taylor", "degree": 8},
 "schedule": {"type": "block", "tolerance": 1e-9, "max_step": 0.1}})",
                   R"({"integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 4},
 "control": {"type": "fixed", "step": 0.1, "courant": 0.5},
 "schedule": {"type": "block"}})",
                   R"({"integrator": {"type": "taylor", "degree": 8},
 "control": {"type": "last_two", "tolerance": 1e-9, "max_step": 0.1},
 "schedule": {"type": "block"}})"},
      .proofs = {{"10 * block.work.element_coefficients",
                  "so much less work than one clock on a chain of 128 masses with four springs 10000 times "
                  "stiffer, at most 1.5 times its error",
                  "StiffSpot.CostsBlockStepsATenthOfLockstep", "schedule/stiff_chain_test.cpp"},
                 {"13.3, 11.4, 11.4, 10.7", "measured: times less work at degrees 4, 8, 12, 16",
                  "StiffSpot.CostsBlockStepsATenthOfLockstep", "schedule/stiff_chain_test.cpp"}},
      .threaded = true,
      .follows_contacts = true,
      .named_by = "schedule.type",
      .own_schedule = read_block};
}

MethodRecord asynchronous() {
  return {
      .name = "asynchronous",
      .what = "Taylor's method with a free clock for each particle",
      .when =
          "Where no ratio between the steps of particles may be special; `block` has less work for the same "
          "accuracy, the more so at high degree.",
      .declared = {{"schedule/asynchronous.hpp", "Asynchronous"}, {"control/last_two.hpp", "last_two_step"}},
      .keys = joined({{{"schedule.grading", "no step is longer than so many times a neighbour's, >= 1", "2"},
                       {"schedule.notify",
                        "tolerances by which a motion may depart from what a neighbour was told, > 0", "1"}},
                      clock_keys}),
      .examples = {R"({"integrator": {"type": "taylor", "degree": 6},
 "schedule": {"type": "asynchronous", "tolerance": 1e-9, "max_step": 0.1}})",
                   R"({"integrator": {"type": "taylor", "degree": 4},
 "control": {"type": "fixed", "step": 0.1, "courant": 0.5},
 "schedule": {"type": "asynchronous"}})",
                   R"({"integrator": {"type": "taylor", "degree": 6},
 "control": {"type": "last_two", "tolerance": 1e-9, "max_step": 0.1},
 "schedule": {"type": "asynchronous"}})"},
      .proofs = {{"12 * free.work.updates",
                  "so many fewer updates than one clock on the same chain as for `block`, degrees 4 and 8, "
                  "at most 5 times its error (measured: 1.07 and 1.00)",
                  "StiffSpot.CostsFreeClocksATwelfthOfTheUpdates", "schedule/stiff_chain_test.cpp"}},
      .threaded = true,
      .follows_contacts = true,
      .named_by = "schedule.type",
      .own_schedule = read_asynchronous};
}

}  // namespace jetlag::methods
