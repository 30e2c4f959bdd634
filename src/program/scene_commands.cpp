// SPDX-License-Identifier: MIT
// What can be said of a scene without running it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "jetlag/base/text.hpp"
#include "jetlag/control/damping_bound.hpp"
#include "jetlag/control/frequency_bound.hpp"
#include "jetlag/model/changing_elements.hpp"
#include "jetlag/motion/expansion.hpp"
#include "program/commands.hpp"
#include "program/scene_arguments.hpp"

namespace jetlag {

namespace {

struct NoArguments {};

int list_scenes(const NoArguments&) {
  for (const auto& scene : built_in_scenes())
    std::printf("%-10s %s\n", scene.name.c_str(), scene.description.c_str());
  return 0;
}

int show(const SceneArguments& arguments) {
  std::printf("%s\n", arguments.load().json.c_str());
  return 0;
}

/// What a scene is and what its run would cost, from one expansion measured here.
int check(const SceneArguments& arguments) {
  const Scene scene = arguments.load();
  const System<double>& system = *scene.system;
  ModelAlong along(system);
  along.begin(scene.initial);
  const Model<double>& model = along.model();
  std::size_t elements = 0, in_contact = 0;
  for (const auto& law : model.laws()) elements += law->count();
  for (const auto& group : system.elements()) in_contact += group.count();
  in_contact = elements - in_contact;
  for (const std::string& warning : scene.warnings) std::fprintf(stderr, "jetlag: %s\n", warning.c_str());
  std::printf("%s: valid\n", shown_name(scene.name).c_str());
  std::printf("  particles   %d in %d dimension%s, %d fixed\n", system.particles(), system.dimension(),
              system.dimension() == 1 ? "" : "s", system.particles() - moving_particles(system));
  for (const auto& group : system.elements())
    if (group.count() > 0 || system.changing().empty())
      std::printf("  force       %-14s %zu element%s\n", group.law.name.c_str(), group.count(),
                  group.count() == 1 ? "" : "s");
  if (!system.changing().empty())
    std::printf("  contact     %zu element%s of features within the thickness at the start\n", in_contact,
                in_contact == 1 ? "" : "s");
  const auto uncounted = std::ranges::find_if(
      system.elements(), [](const auto& group) { return group.count() > 0 && group.law.unbounded; });
  const Model<double> always = Model<double>::without_changing(system);
  const double omega = FrequencyMeter(always)(scene.initial), damping = DampingMeter(always)(scene.initial);
  const std::string others =
      uncounted == system.elements().end() ? "" : ", " + uncounted->law.name + " not counted";
  if (omega > 0 && damping_needs_state(always))
    std::printf("  stiffness   frequencies up to %.4g rad/s and viscosity up to %.4g /s at the start%s\n",
                omega, damping, others.c_str());
  else if (omega > 0)
    std::printf("  stiffness   frequencies up to %.4g rad/s%s; leapfrog is stable below a step of %.4g s%s\n",
                omega, bounds_need_state(always) ? " at the start" : "", 2 / omega, others.c_str());
  const int orders = std::max(1, static_cast<int>(scene.mean_orders + 0.5));
  Expansion<double> series(model, orders + 1);
  series.start(scene.initial);
  series.grow_to(orders + 1);
  int repeats = 0;
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0;
  do {
    series.start(scene.initial);
    series.grow_to(orders + 1);
    ++repeats;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } while (elapsed < 0.05);
  std::printf("  memory      %.3g MB of series\n", static_cast<double>(series.bytes()) / 1e6);
  const char* about = scene.orders_at_least ? "at least" : "about";
  std::printf("  a step      %s%.4g orders on average, %.3g element coefficients, %s %.3g ms\n",
              scene.orders_at_least ? "at least " : "", scene.mean_orders,
              scene.mean_orders * static_cast<double>(elements), about, 1e3 * elapsed / repeats);
  if (const double steps = scene.fixed_step ? std::ceil(scene.until / *scene.fixed_step) : 0; steps > 0)
    std::printf("  the run     %.*g steps, %s %.2g s and the frames\n", steps < 1e15 ? 15 : 4, steps, about,
                scene.until / *scene.fixed_step * elapsed / repeats);
  else
    std::printf("  the run     as many steps as its control chooses, until t = %.6g s\n", scene.until);
  return 0;
}

std::vector<Option> options(SceneArguments& arguments) { return arguments.options(); }

}  // namespace

Command scenes_command() {
  return command<NoArguments>("scenes", "list the built-in scenes", list_scenes,
                              [](NoArguments&) { return std::vector<Option>(); });
}

Command show_command() {
  return command<SceneArguments>("show", "print a scene as JSON, complete", show, options);
}

Command check_command() {
  return command<SceneArguments>("check", "validate a scene and say what its run would cost", check, options);
}

}  // namespace jetlag
