// SPDX-License-Identifier: MIT
// "integrator", "control" and "schedule": the record of the method says what may stand there, and makes it.
#include <functional>
#include <limits>

#include "jetlag/scenes/error.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "scenes/methods/methods.hpp"
#include "scenes/methods/record.hpp"

namespace jetlag {

namespace {

std::vector<std::string> names_where(const std::function<bool(const MethodRecord&)>& holds) {
  std::vector<std::string> names;
  for (const MethodRecord& record : method_records())
    if (holds(record)) names.push_back(record.name);
  return names;
}

bool of_integrator(const MethodRecord& record) { return record.named_by == "integrator.type"; }

void require_object(const Value& value) {
  if (!value.is_object()) value.refuse("an object with a type");
}

/// Refuses what is no key of this part of the scene. Its type comes first, though pages may list it elsewhere.
void check_keys(const Value& value, const SceneKeys& keys, const std::string& part,
                const std::string& chosen = "") {
  std::vector<std::string_view> names = allowed(keys, part, chosen);
  std::erase(names, "type");
  names.insert(names.begin(), "type");
  value.only(names);
}

void check_integrator(const Value& integrator, const MethodRecord& record) {
  std::string law;
  if (const SceneKey* laws = find_key(record.keys, "integrator.law")) {
    const auto given = integrator.find("law");
    law = given ? given->one_of(laws->names) : laws->fallback;
  }
  check_keys(integrator, record.keys, "integrator", law);
}

/// Of a method that takes one of several types, or the only one. One whose type may be left out is known by its keys.
void check_control(const Value& control, const MethodRecord& record) {
  require_object(control);
  const SceneKey& types = *find_key(record.keys, "control.type");
  const bool named = types.fallback == "required";
  if (!named) check_keys(control, record.keys, "control", types.fallback);
  const Value type = named ? control.at("type") : control.at("type", types.fallback);
  if (types.names.size() > 1)
    type.one_of(types.names);
  else if (type.text() != types.names.front())
    type.refuse(types.names.front() + ", which is what " + record.name + " works with");
  if (named) check_keys(control, record.keys, "control", type.text());
}

int read_threads(const Value& schedule, const MethodRecord& record) {
  constexpr std::int64_t most_threads = 1024;
  const int threads =
      schedule.has("threads") ? static_cast<int>(schedule.at("threads").integer(1, most_threads)) : 1;
  if (threads > 1 && !record.threaded)
    throw SceneError("schedule.threads: got " + std::to_string(threads) + "; must be 1 for " + record.name);
  return threads;
}

/// Refuses a method for which elements that come and go would be always there, or never.
void require_follows_contacts(const Value& integrator, const Value& schedule, const MethodRecord& record) {
  if (record.follows_contacts) return;
  const auto listed = [](bool integrators) {
    std::string text;
    for (const std::string& name : names_where([&](const MethodRecord& one) {
           return of_integrator(one) == integrators && one.follows_contacts;
         }))
      text += (text.empty() ? "" : " or ") + name;
    return text;
  };
  (of_integrator(record) ? integrator : schedule)
      .at("type")
      .refuse(listed(true) + " with the schedule lockstep or " + listed(false) +
              " beside a force contact_barrier, whose elements come and go" +
              (record.name == "avi" ? "; with avi take contact_layers" : ""));
}

Method in_lockstep(const MethodRecord& record, const StepperArguments& arguments) {
  const Stepper stepper = record.stepper(arguments);
  const Value& control = arguments.control;
  Method method;
  method.schedule = [make = stepper.make] { return std::make_unique<Lockstep>(make()); };
  method.series = stepper.series;
  if (control.at("type").text() == "fixed" && !control.has("courant"))
    method.fixed_step = stepper.cycle * control.at("step").number(positive);
  method.mean_orders = stepper.mean_orders;
  method.largest_degree = stepper.largest_degree;
  method.at_least = stepper.at_least;
  return method;
}

}  // namespace

std::vector<std::string> integrator_types() { return names_where(of_integrator); }

std::vector<std::string> schedule_types() {
  auto types = names_where([](const MethodRecord& record) { return !of_integrator(record); });
  types.insert(types.begin(), "lockstep");
  return types;
}

Stepper read_inner(const StepperArguments& arguments) {
  const Value inner = arguments.integrator.at("inner");
  require_object(inner);
  const MethodRecord& record = method_record(inner.at("type").one_of(
      names_where([](const MethodRecord& one) { return one.stepper != nullptr && !one.draws; })));
  check_integrator(inner, record);
  Document any_length(R"({"type": "fixed", "step": 1e300})", "control");
  return record.stepper({inner, any_length.root("control"), arguments.system, arguments.seed,
                         arguments.threads, arguments.start});
}

Method read_method(const Value& scene, std::shared_ptr<const System<double>> system,
                   const State<double>& start, std::uint64_t seed) {
  const Value integrator = scene.at("integrator");
  require_object(integrator);
  const MethodRecord& by_type = method_record(integrator.at("type").one_of(integrator_types()));
  check_integrator(integrator, by_type);

  const bool own = by_type.own_schedule != nullptr;
  const std::string usual = own ? "asynchronous" : "lockstep";
  const Value schedule = scene.at("schedule", JsonText{"{}"});
  if (own) check_keys(schedule, by_type.keys, "schedule");
  const std::string type =
      schedule.at("type", usual).one_of(own ? std::vector<std::string>{usual} : schedule_types());
  const MethodRecord& record = type == usual ? by_type : method_record(type);
  if (!own) check_keys(schedule, record.keys, "schedule");
  if (!system->changing().empty()) require_follows_contacts(integrator, schedule, record);
  const int threads = read_threads(schedule, record);

  Method method;
  if (record.stepper != nullptr) {
    const Value control = scene.at("control");
    check_control(control, record);
    method = in_lockstep(record, {integrator, control, std::move(system), seed, threads, start});
  } else {
    if (of_integrator(record)) check_control(scene.at("control"), record);
    method = record.own_schedule({scene, integrator, schedule, std::move(system), seed, threads, start});
  }
  const auto most = std::numeric_limits<std::int64_t>::max();
  method.max_steps = static_cast<std::uint64_t>(
      schedule.has("max_steps") ? schedule.at("max_steps").integer(1, most) : most);
  method.threads = threads;
  return method;
}

}  // namespace jetlag
