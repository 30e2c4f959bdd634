// SPDX-License-Identifier: MIT
// "integrator": {"type": "qss1"}, "qss2", "qss3": quantized states; "control" is the quantum.
#include <limits>

#include "jetlag/schedule/qss.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

Method read_qss(const Value& scene, std::shared_ptr<const System<double>> system) {
  const Value integrator = scene.at("integrator"), control = scene.at("control"),
              schedule = scene.at("schedule", JsonText{R"({"type": "asynchronous"})"});
  schedule.only({"type", "max_steps"}).at("type", "asynchronous").one_of({"asynchronous"});
  if (!control.is_object()) control.refuse("an object with a type and a quantum");
  if (control.only({"type", "quantum", "velocity_quantum", "max_step"}).at("type", "quantum").text() !=
      "quantum")
    control.at("type").refuse("quantum, which is what " + integrator.at("type").text() + " works with");
  Qss::Options options;
  options.order = integrator.only({"type"}).at("type").text().back() - '0';
  options.quantum = control.at("quantum").number(positive);
  options.velocity_quantum = control.at("velocity_quantum", options.quantum).number(positive);
  options.max_step = read_max_step(control);
  checked(control, [&] { Qss(*system, options); });

  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  const auto max_steps = schedule.has("max_steps") ? schedule.at("max_steps").integer(1, most) : most;
  return {[system, options] { return std::make_unique<Qss>(*system, options); },
          std::nullopt,
          static_cast<std::uint64_t>(max_steps),
          1,
          std::nullopt,
          static_cast<double>(options.order),
          options.order};
}

}  // namespace jetlag
