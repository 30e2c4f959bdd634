// SPDX-License-Identifier: MIT
#include "scenes/methods/taylor/series.hpp"

#include "jetlag/integrators/taylor.hpp"
#include "jetlag/truncation/mean_orders.hpp"
#include "scenes/methods/keys.hpp"

namespace jetlag::methods {

SceneKeys series_keys() {
  return joined({{{"integrator.velocity", "`own_series`, `derivative` of that of the position", "own_series"},
                  {"integrator.compensated", "true, false: sums of increments with their rests", "false"}},
                 control_keys(),
                 method_keys::many_threads});
}

std::optional<Value> tolerance_of_degree(const Value& control) {
  return control.at("type").text() == "jorba_zou" ? control.find("tolerance") : std::nullopt;
}

VelocitySeries read_velocity_series(const Value& integrator) {
  return integrator.at("velocity", "own_series").one_of({"own_series", "derivative"}) == "own_series"
             ? VelocitySeries::own_series
             : VelocitySeries::derivative;
}

Stepper series_method(const StepperArguments& arguments, const Truncation& law, bool shared_draw,
                      Draw draws) {
  const auto& [integrator, control, system, seed, threads, start] = arguments;
  const RandomTaylor::Options options{
      seed,    shared_draw, read_velocity_series(integrator), integrator.at("compensated", false).boolean(),
      threads, draws};
  const TruncationLaw known = known_beforehand(law);
  std::shared_ptr<const Control> model = read_control(control, known, options.velocity, *system, start);
  const int read = model->orders_read(known, options.velocity);
  const StepDraws of_a_step{draws, shared_draw, system->particles(), moving_particles(*system)};
  return {[system = system, law, model, options] {
            return std::make_unique<RandomTaylor>(*system, law, model->clone(), options);
          },
          mean_orders(known, of_a_step, options.velocity, read), known.max_degree(),
          std::holds_alternative<SequentialLaw>(law) &&
              read <= known.max_degree() - (options.velocity == VelocitySeries::own_series ? 0 : 1),
          SeriesMethod{law, options, model}};
}

}  // namespace jetlag::methods
