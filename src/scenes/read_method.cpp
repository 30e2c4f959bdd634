// SPDX-License-Identifier: MIT
#include <limits>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/halve_double.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/variance_target.hpp"
#include "jetlag/integrators/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

constexpr int largest_degree = 256;
const Range fraction{0, 1, false, true, "a number > 0 and <= 1"};

double read_max_step(const Value& control) {
  const auto value = control.find("max_step");
  return value ? value->number(positive) : infinite;
}

/// The control of a series stopped by `law`, without the Courant limit.
std::unique_ptr<Control> read_series_control(const Value& control, const TruncationLaw& law) {
  const std::string type = control.at("type").one_of({"fixed", "jorba_zou", "variance", "halve_double"});
  if (type == "fixed") {
    control.only({"type", "step", "courant"});
    return std::make_unique<FixedStep>(control.at("step").number(positive));
  }
  if (type == "jorba_zou") {
    control.only({"type", "max_step", "courant", "tolerance"});
    return std::make_unique<JorbaZou>(read_max_step(control));
  }
  if (type == "variance") {
    control.only({"type", "step", "max_step", "tolerance_random", "tolerance_bias", "courant"});
    return std::make_unique<VarianceTarget>(control.at("step").number(positive), read_max_step(control),
                                            control.at("tolerance_random").number(positive),
                                            control.at("tolerance_bias").number(positive));
  }
  control.only({"type", "step", "max_step", "min_variance", "max_variance", "courant"});
  const double step = control.at("step").number(positive), max_step = read_max_step(control),
               least = control.at("min_variance").number(positive),
               most = control.at("max_variance").number(positive);
  return checked(
      control, [&] { return std::make_unique<HalveDouble>(step, max_step, least, most, law.min_degree()); });
}

std::unique_ptr<Control> read_control(const Value& control, const TruncationLaw& law,
                                      const System<double>& system) {
  auto inner = read_series_control(control, law);
  const auto courant = control.find("courant");
  if (!courant) return inner;
  const double safety = courant->number(fraction);
  return checked(*courant, [&] {
    return std::make_unique<Courant>(std::move(inner), safety, imaginary_stability_limit(law),
                                     frequency_bound(system));
  });
}

/// "degree", or what a tolerance of jorba_zou asks for.
int read_degree(const Value& integrator, const Value& control) {
  const auto tolerance = control.find("tolerance");
  if (!tolerance || integrator.has("degree"))
    return static_cast<int>(integrator.at("degree").integer(1, largest_degree));
  const int degree = jorba_zou_degree(tolerance->number({0, 1, false, false, "a number between 0 and 1"}));
  return static_cast<int>(integrator.at("degree", degree).integer(1, largest_degree));
}

VelocitySeries read_velocity_series(const Value& integrator) {
  return integrator.at("velocity", "own_series").one_of({"own_series", "derivative"}) == "own_series"
             ? VelocitySeries::own_series
             : VelocitySeries::derivative;
}

struct IntegratorFactory {
  std::function<std::unique_ptr<Integrator>()> make;
  double mean_orders;
};

IntegratorFactory series_method(TruncationLaw law, const Value& control,
                                std::shared_ptr<const System<double>> system, RandomTaylor::Options options) {
  const double orders = law.mean() + (options.velocity == VelocitySeries::own_series ? 1 : 0) - 1;
  std::shared_ptr<Control> model = read_control(control, law, *system);
  return {[=] { return std::make_unique<RandomTaylor>(*system, law, model->clone(), options); }, orders};
}

IntegratorFactory read_integrator(const Value& integrator, const Value& control,
                                  std::shared_ptr<const System<double>> system, std::uint64_t seed) {
  const std::string type = integrator.at("type").one_of({"taylor", "random_taylor", "leapfrog"});
  if (type == "taylor") {
    integrator.only({"type", "degree", "velocity"});
    return series_method(fixed_degree(read_degree(integrator, control)), control, system,
                         {seed, true, read_velocity_series(integrator)});
  }
  if (type == "random_taylor") {
    integrator.only({"type", "min_degree", "max_degree", "probability", "draws", "shared_draw", "velocity"});
    const auto m = static_cast<int>(integrator.at("min_degree").integer(1, largest_degree)),
               n = static_cast<int>(integrator.at("max_degree").integer(m, largest_degree));
    const Value p = integrator.at("probability", 0.5);
    const double probability =
        p.number({0, 1, true, true, "a number from 0 to 1, below 1 unless max_degree = min_degree"});
    integrator.at("draws", "independent").one_of({"independent"});
    return series_method(
        checked(p, [&] { return geometric(m, n, probability); }), control, system,
        {seed, integrator.at("shared_draw", true).boolean(), read_velocity_series(integrator)});
  }
  integrator.only({"type"});
  if (control.at("type").text() != "fixed")
    control.at("type").refuse("fixed, which is what leapfrog works with");
  control.only({"type", "step", "courant"});
  double step = control.at("step").number(positive);
  if (const auto courant = control.find("courant")) {
    const double omega = frequency_bound(*system);
    if (omega > 0) step = std::min(step, courant->number(fraction) * 2.0 / omega);
  }
  return {[=] { return std::make_unique<Leapfrog>(*system, step); }, 1.0};
}

}  // namespace

Method read_method(const Value& scene, std::shared_ptr<const System<double>> system, std::uint64_t seed) {
  const Value schedule = scene.at("schedule", Json{{"type", "lockstep"}});
  schedule.only({"type", "max_steps"}).at("type", "lockstep").one_of({"lockstep"});
  const auto most = std::numeric_limits<std::int64_t>::max();
  const auto max_steps = schedule.has("max_steps") ? schedule.at("max_steps").integer(1, most) : most;

  const Value integrator = scene.at("integrator"), control = scene.at("control");
  if (!integrator.is_object()) integrator.refuse("an object with a type");
  if (!control.is_object()) control.refuse("an object with a type");
  const auto [make, mean_orders] = read_integrator(integrator, control, std::move(system), seed);
  std::optional<double> fixed_step;
  if (control.at("type").text() == "fixed" && !control.has("courant"))
    fixed_step = control.at("step").number(positive);
  return {[make = make] { return std::make_unique<Lockstep>(make()); }, static_cast<std::uint64_t>(max_steps),
          fixed_step, mean_orders};
}

}  // namespace jetlag
