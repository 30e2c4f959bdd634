// SPDX-License-Identifier: MIT
// Quantized states; "control" is the quantum.
#include "jetlag/schedule/qss.hpp"

#include "scenes/methods/keys.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag::methods {

using namespace method_keys;

namespace {

const SceneKeys quantized{
    choice("control.type", {"quantum"}, "quantum"),
    {"control.quantum", "of positions [m], > 0", "required"},
    {"control.velocity_quantum", "of velocities [m/s], > 0", "none: the number of control.quantum"},
    {"control.max_step",
     "each component acts at least so often [s], > 0; required by floors and by forces that depend on the "
     "time",
     "none"},
    {"schedule.type", "`asynchronous`", "asynchronous"},
    max_steps};

Method read_qss(const ScheduleArguments& arguments) {
  const Value control = arguments.scene.at("control");
  const auto system = arguments.system;
  Qss::Options options;
  options.order = arguments.integrator.at("type").text().back() - '0';
  options.quantum = control.at("quantum").number(positive);
  options.velocity_quantum = control.at("velocity_quantum", options.quantum).number(positive);
  options.max_step = read_max_step(control);
  checked(control, [&] { Qss(*system, options); });
  Method method;
  method.schedule = [system, options] { return std::make_unique<Qss>(*system, options); };
  method.mean_orders = options.order;
  method.largest_degree = options.order;
  return method;
}

}  // namespace

MethodRecord qss1() {
  return {
      .name = "qss1",
      .what = "Quantized states of order 1: a component acts where it has changed by a quantum",
      .when =
          "To study how quantized states behave: events grow as 1 / quantum, and oscillations without "
          "damping gain energy. For more digits take `qss2` or `qss3`; for stiff scenes, where "
          "components chatter, an implicit method.",
      .declared = {{"schedule/qss.hpp", "Qss"}},
      .keys = quantized,
      .examples = {R"({"integrator": {"type": "qss1"},
 "control": {"quantum": 1e-2}})",
                   R"({"integrator": {"type": "qss1"},
 "control": {"type": "quantum", "quantum": 1e-2, "velocity_quantum": 1e-1, "max_step": 0.01}})"},
      .proofs = {{"to_one_percent), 99, 2",
                  "events in which v' = -v falls from 1 to 0.01 with a quantum of 0.01, and how far their "
                  "number may be off",
                  "Qss.OfOrderOneDecaysInAHundredEvents", "schedule/qss/qss_test.cpp"},
                 {"80 * quantum", "relative growth of the energy of x'' = -x from x = 1 in 10 periods",
                  "Qss.OfOrderOneGainsEnergyOnAnOscillator", "schedule/qss/qss_test.cpp"},
                 {"order == 1 ? 8 : 4",
                  "the error of a planet of eccentricity 0.3 at t = 2 is below so many quanta: 8 with "
                  "`qss1`, 4 with the others",
                  "Qss.ErrorsOnAPlanetAreProportionalToTheQuantum", "schedule/qss/qss_test.cpp"}},
      .own_schedule = read_qss};
}

MethodRecord qss2() {
  return {
      .name = "qss2",
      .what = "Quantized states of order 2: a component acts where it has left its line by a quantum",
      .when =
          "A damped scene, most of which is at rest or moves evenly while some of it is busy, to a few "
          "digits: what hardly moves has hardly any events, and on stable linear systems errors stay "
          "within a bound for all time. Not for stiff scenes, where components chatter, nor for long "
          "runs without damping, where the energy changes in proportion to the quantum.",
      .declared = {{"schedule/qss.hpp", "Qss"}},
      .keys = quantized,
      .examples = {R"({"integrator": {"type": "qss2"},
 "control": {"quantum": 1e-4}})",
                   R"({"integrator": {"type": "qss2"},
 "control": {"type": "quantum", "quantum": 1e-4, "velocity_quantum": 1e-3, "max_step": 0.01}})"},
      .proofs = {{"-1.0 / order, 0.1",
                  "the power of the quantum with which the number of events grows, -1/2 here, and how far "
                  "it may be off",
                  "Qss.CountsEventsByTheRootOfTheQuantum", "schedule/qss/qss_test.cpp"},
                 {"250 * (std::sqrt(0.25) + std::sqrt(0.125) + std::sqrt(4.875))",
                  "events of a fall of 2.5 s with a quantum of 1e-4, all of positions: its velocities, "
                  "which are lines, have none",
                  "Qss.HasNoEventsWhereThePolynomialsAreExact", "schedule/qss/qss_test.cpp"},
                 {"change(2, quantum)), 10",
                  "the energy of x'' = -x from x = 1 changes in 10 periods by less than 10 times the "
                  "quantum, relatively",
                  "Qss.OfHigherOrdersKeepsTheEnergyToSomeQuanta", "schedule/qss/qss_test.cpp"}},
      .own_schedule = read_qss};
}

MethodRecord qss3() {
  return {
      .name = "qss3",
      .what = "Quantized states of order 3: a component acts where it has left its parabola by a quantum",
      .when =
          "As `qss2`, to more digits: events grow as quantum^(-1/3) instead of quantum^(-1/2). An "
          "oscillator without damping loses energy in every period.",
      .declared = {{"schedule/qss.hpp", "Qss"}},
      .keys = quantized,
      .examples = {R"({"integrator": {"type": "qss3"},
 "control": {"quantum": 1e-6}})",
                   R"({"integrator": {"type": "qss3"},
 "control": {"type": "quantum", "quantum": 1e-6, "velocity_quantum": 1e-5, "max_step": 0.01}})"},
      .proofs = {{"-1.0 / order, 0.1",
                  "the power of the quantum with which the number of events grows, -1/3 here, and how far "
                  "it may be off",
                  "Qss.CountsEventsByTheRootOfTheQuantum", "schedule/qss/qss_test.cpp"},
                 {"-39.5, 2.5",
                  "relative change of the energy of x'' = -x from x = 1 in 10 periods over the quantum, and "
                  "how far it may be off",
                  "Qss.OfHigherOrdersKeepsTheEnergyToSomeQuanta", "schedule/qss/qss_test.cpp"},
                 {"5e-14", "momentum of eight particles with 28 springs after 3 s, quantum 1e-3",
                  "Qss.KeepsMomentumToRounding", "schedule/qss/qss_test.cpp"}},
      .own_schedule = read_qss};
}

}  // namespace jetlag::methods
