// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/explicit/dop853.hpp"
#include "jetlag/integrators/explicit/dopri5.hpp"
#include "jetlag/integrators/explicit/gauss_radau.hpp"
#include "jetlag/integrators/explicit/hermite.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/explicit/rk4.hpp"
#include "jetlag/integrators/explicit/symplectic_euler.hpp"
#include "jetlag/integrators/implicit/explicit_implicit.hpp"
#include "jetlag/integrators/implicit/implicit.hpp"
#include "jetlag/integrators/perturbed/conrad.hpp"
#include "jetlag/integrators/perturbed/exponential_step.hpp"
#include "jetlag/integrators/perturbed/random_step.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

/// The tolerance of jorba_zou, which stands for a degree.
std::optional<Value> tolerance_of_degree(const Value& control) {
  return control.at("type").text() == "jorba_zou" ? control.find("tolerance") : std::nullopt;
}

/// "degree", or what a tolerance of jorba_zou asks for.
int read_degree(const Value& integrator, const Value& control) {
  const auto tolerance = tolerance_of_degree(control);
  if (!tolerance) return static_cast<int>(integrator.at("degree").integer(1, largest_degree));
  if (integrator.has("degree"))
    tolerance->refuse("left out where integrator.degree is given: one follows from the other");
  const int degree = jorba_zou_degree(tolerance->number({0, 1, false, false, "a number between 0 and 1"}));
  if (degree > largest_degree)
    tolerance->refuse("larger: it asks for degree " + std::to_string(degree) + ", beyond " +
                      std::to_string(largest_degree));
  return degree;
}

VelocitySeries read_velocity_series(const Value& integrator) {
  return integrator.at("velocity", "own_series").one_of({"own_series", "derivative"}) == "own_series"
             ? VelocitySeries::own_series
             : VelocitySeries::derivative;
}

struct IntegratorFactory {
  std::function<std::unique_ptr<Integrator>()> make;
  double mean_orders;
  int largest_degree;
  bool at_least = false;  // mean_orders is a lower bound
  std::optional<SeriesMethod> series{};
  int cycle = 1;  // steps of the control in a step
};

struct MethodArguments {
  const Value& integrator;
  const Value& control;
  std::shared_ptr<const System<double>> system;
  std::uint64_t seed;
  int threads;
};

/// P(the largest of the degrees that a step draws >= n). Draws of different particles are independent,
///     1 - (1 - P)^M,      P = P(K >= n), M = moving particles,
/// but of `stratified` ones, one from each of N intervals of (0, 1], the first floor(N P) surely go that far and the
/// next one with the probability N P - floor(N P). Which M of the N are those of moving particles is random.
double largest_at_least(const TruncationLaw& law, const RandomTaylor::Options& options,
                        const System<double>& system, int n) {
  const double p = law.at_least(n);
  const int moving = moving_particles(system), all = system.particles();
  if (options.shared_draw || moving == 0) return p;
  if (options.draws != Draw::stratified) return -std::expm1(moving * std::log1p(-p));
  const double sure = std::floor(all * p);
  double none = 1;  // of the moving ones
  for (int i = 0; i < sure && none > 0; ++i) none *= double(std::max(0, all - moving - i)) / (all - i);
  return 1 - none * (sure < all ? 1 - (all * p - sure) * std::min(1.0, moving / (all - sure)) : 1.0);
}

/// The orders of the forces that a step computes on average: those of the positions up to the largest degree, with
/// own_series one more, and up to what the control reads, but the two that the state gives.
double mean_orders(const TruncationLaw& law, const RandomTaylor::Options& options,
                   const System<double>& system, int read) {
  const int more = options.velocity == VelocitySeries::own_series ? 1 : 0;
  double mean = 0;  // E max(largest K + more, read), from its tail
  for (int n = 1; n <= std::max(law.max_degree() + more, read); ++n)
    mean += n <= read || n <= more ? 1.0 : largest_at_least(law, options, system, n - more);
  return std::max(mean, 1.0) - 1;
}

IntegratorFactory series_method(const MethodArguments& arguments, Truncation law, bool shared_draw,
                                Draw draws) {
  const RandomTaylor::Options options{arguments.seed,
                                      shared_draw,
                                      read_velocity_series(arguments.integrator),
                                      arguments.integrator.at("compensated", false).boolean(),
                                      arguments.threads,
                                      draws};
  const TruncationLaw known = known_beforehand(law);
  std::shared_ptr<const Control> model =
      read_control(arguments.control, known, options.velocity, *arguments.system);
  const int read = model->orders_read(known, options.velocity);
  return {[system = arguments.system, law, model, options] {
            return std::make_unique<RandomTaylor>(*system, law, model->clone(), options);
          },
          mean_orders(known, options, *arguments.system, read), known.max_degree(),
          std::holds_alternative<SequentialLaw>(law) &&
              read <= known.max_degree() - (options.velocity == VelocitySeries::own_series ? 0 : 1),
          SeriesMethod{law, options, model}};
}

IntegratorFactory read_taylor(const MethodArguments& arguments) {
  arguments.integrator.only({"type", "degree", "velocity", "compensated"});
  return series_method(arguments, fixed_degree(read_degree(arguments.integrator, arguments.control)), true,
                       Draw::independent);
}

/// What a control reads of a law is its variance, known beforehand, as a coupled sum.
void require_control_for(const Truncation& law, const Value& control) {
  const bool reads_variance = control.at("type").text() == "variance" ||
                              control.at("type").text() == "halve_double" || control.has("courant");
  const auto* known = std::get_if<TruncationLaw>(&law);
  if (reads_variance && (known == nullptr || known->weighting() != Weighting::coupled_sum))
    control.refuse(
        "fixed or jorba_zou without courant where integrator.law is sequential or single_term: the others "
        "need the variance of the law");
}

IntegratorFactory read_random_taylor(const MethodArguments& arguments) {
  const Value& integrator = arguments.integrator;
  const Truncation law = read_truncation(integrator);
  if (const auto tolerance = tolerance_of_degree(arguments.control))
    tolerance->refuse("left out for random_taylor, whose degrees are given");
  require_control_for(law, arguments.control);
  const bool shared_draw = integrator.at("shared_draw", true).boolean();
  const Draw draws = read_draws(integrator, law, shared_draw, arguments.system->particles());
  return series_method(arguments, law, shared_draw, draws);
}

/// What methods that are not threaded ask of the schedule.
void require_one_thread(const MethodArguments& arguments) {
  if (arguments.threads > 1)
    throw SceneError("schedule.threads: got " + std::to_string(arguments.threads) + "; must be 1 for " +
                     arguments.integrator.at("type").text());
}

/// The step of a method that works with steps of one length only.
double read_step(const MethodArguments& arguments) {
  const Value& control = arguments.control;
  require_one_thread(arguments);
  if (!is_fixed(control))
    control.at("type").refuse("fixed, which is what " + arguments.integrator.at("type").text() +
                              " works with");
  return control.only({"type", "step", "courant"}).at("step").number(positive);
}

/// As above, for methods whose stability limit is not known here.
double read_step_without_courant(const MethodArguments& arguments) {
  const double step = read_step(arguments);
  arguments.control.only({"type", "step"});
  return step;
}

/// Makes a method once, so that what it refuses is said of the scene.
template <class Make>
IntegratorFactory one_step_method(const MethodArguments& arguments, double evaluations, Make make) {
  checked(arguments.integrator.at("type"), make);
  return {make, evaluations, 2};
}

IntegratorFactory read_leapfrog(const MethodArguments& arguments) {
  arguments.integrator.only({"type"});
  double step = read_step(arguments);
  if (const auto courant = read_courant(arguments.control, *arguments.system))
    step = std::min(step, courant->first * 2.0 / courant->second);
  return {[system = arguments.system, step] { return std::make_unique<Leapfrog>(*system, step); }, 1.0, 2};
}

IntegratorFactory read_symplectic_euler(const MethodArguments& arguments) {
  arguments.integrator.only({"type"});
  const double step = read_step_without_courant(arguments);
  return one_step_method(arguments, 1.0, [system = arguments.system, step] {
    return std::make_unique<SymplecticEuler>(*system, step);
  });
}

template <const RungeKuttaTable& table()>
IntegratorFactory read_runge_kutta(const MethodArguments& arguments) {
  arguments.integrator.only({"type"});
  const double step = read_step_without_courant(arguments);
  return one_step_method(arguments, table().stages(), [system = arguments.system, step] {
    return std::make_unique<RungeKutta>(*system, table(), step);
  });
}

/// "control" of a method that estimates its own error: "fixed", or "embedded" with a tolerance.
template <const RungeKuttaTable& table()>
IntegratorFactory read_embedded(const MethodArguments& arguments) {
  const Value& control = arguments.control;
  if (control.at("type").one_of({"fixed", "embedded"}) == "fixed") return read_runge_kutta<table>(arguments);
  arguments.integrator.only({"type"});
  require_one_thread(arguments);
  control.only({"type", "tolerance", "max_step"});
  const EmbeddedControl embedded{control.at("tolerance").number(positive), read_max_step(control)};
  return one_step_method(arguments, table().stages(), [system = arguments.system, embedded] {
    return std::make_unique<RungeKutta>(*system, table(), embedded);
  });
}

/// "fixed", or "embedded": by the last coefficient of its polynomial, to a tolerance of 1e-9 of the accelerations.
IntegratorFactory read_gauss_radau(const MethodArguments& arguments) {
  const Value& control = arguments.control;
  arguments.integrator.only({"type"});
  GaussRadau::Options options;
  if (control.at("type").one_of({"fixed", "embedded"}) == "fixed") {
    options.step = read_step_without_courant(arguments);
  } else {
    require_one_thread(arguments);
    control.only({"type", "tolerance", "max_step"});
    options.tolerance = control.at("tolerance", options.tolerance).number(positive);
    options.max_step = read_max_step(control);
  }
  return one_step_method(arguments, 15.0, [system = arguments.system, options] {
    return std::make_unique<GaussRadau>(*system, options);
  });
}

/// "fixed", or "aarseth".
IntegratorFactory read_hermite(const MethodArguments& arguments) {
  const Value &control = arguments.control, &integrator = arguments.integrator;
  integrator.only({"type", "iterations"});
  Hermite::Options options;
  options.iterations = static_cast<int>(integrator.at("iterations", options.iterations).integer(1, 20));
  if (control.at("type").one_of({"fixed", "aarseth"}) == "fixed") {
    options.step = read_step_without_courant(arguments);
  } else {
    require_one_thread(arguments);
    control.only({"type", "accuracy", "max_step"});
    options.accuracy = control.at("accuracy", options.accuracy).number(positive);
    options.max_step = read_max_step(control);
  }
  return one_step_method(arguments, 2.0 * (options.iterations + 1), [system = arguments.system, options] {
    return std::make_unique<Hermite>(*system, options);
  });
}

template <class M>
IntegratorFactory read_implicit(const MethodArguments& arguments) {
  arguments.integrator.only({"type"});
  const double step = read_step_without_courant(arguments);
  return one_step_method(arguments, 4.0,
                         [system = arguments.system, step] { return std::make_unique<M>(*system, step); });
}

IntegratorFactory read_explicit_implicit(const MethodArguments& arguments) {
  arguments.integrator.only({"type", "implicit"});
  const double step = read_step_without_courant(arguments);
  const auto implicit = read_implicit_particles(arguments.integrator, *arguments.system, step);
  return one_step_method(arguments, 4.0, [system = arguments.system, step, implicit] {
    return std::make_unique<ExplicitImplicit>(*system, step, implicit);
  });
}

IntegratorFactory read_subcycled_implicit(const MethodArguments& arguments) {
  const auto options =
      read_implicit_subcycling(arguments.integrator, read_step_without_courant(arguments), *arguments.system);
  auto factory = one_step_method(arguments, 4.0 * options.ratio, [system = arguments.system, options] {
    return std::make_unique<ImplicitSubcycling>(*system, options);
  });
  factory.cycle = options.ratio;
  return factory;
}

/// "inner": a deterministic method, for steps of any length.
IntegratorFactory read_inner(const MethodArguments& arguments);

IntegratorFactory read_conrad(const MethodArguments& arguments) {
  const Value& integrator = arguments.integrator;
  integrator.only({"type", "inner", "order", "sigma"});
  Conrad::Options options;
  options.step = read_step_without_courant(arguments);
  options.order = integrator.at("order").number(positive);
  options.sigma = integrator.at("sigma", 1.0).number(positive);
  options.seed = arguments.seed;
  const auto inner = read_inner(arguments);
  return one_step_method(arguments, inner.mean_orders,
                         [system = arguments.system, options, make = inner.make] {
                           return std::make_unique<Conrad>(*system, make(), options);
                         });
}

IntegratorFactory read_random_step(const MethodArguments& arguments) {
  const Value& integrator = arguments.integrator;
  integrator.only({"type", "inner", "order", "distribution"});
  RandomStep::Options options;
  options.step = read_step_without_courant(arguments);
  options.order = integrator.at("order").number({0.5, infinite, false, false, "a number > 0.5"});
  const std::string name = integrator.at("distribution", "uniform").one_of(names_of_step_distributions);
  options.distribution = name == "uniform" ? StepDistribution::uniform : StepDistribution::lognormal;
  options.seed = arguments.seed;
  const auto inner = read_inner(arguments);
  return one_step_method(arguments, inner.mean_orders, [options, make = inner.make] {
    return std::make_unique<RandomStep>(make(), options);
  });
}

IntegratorFactory read_exponential_step(const MethodArguments& arguments) {
  arguments.integrator.only({"type"});
  const double step = read_step_without_courant(arguments);
  return one_step_method(arguments, 1.0, [system = arguments.system, step, seed = arguments.seed] {
    return std::make_unique<ExponentialStep>(*system, step, seed);
  });
}

/// To add one, write its reader, add its line here and its page to a method_register_*.cpp.
struct IntegratorReader {
  const char* type;
  IntegratorFactory (*read)(const MethodArguments&);
  Method (*own_schedule)(const Value& scene, std::shared_ptr<const System<double>> system) = nullptr;
};
constexpr IntegratorReader integrators[] = {{"taylor", read_taylor},
                                            {"random_taylor", read_random_taylor},
                                            {"leapfrog", read_leapfrog},
                                            {"avi", nullptr, read_avi},
                                            {"subcycling", nullptr, read_subcycling},
                                            {"qss1", nullptr, read_qss},
                                            {"qss2", nullptr, read_qss},
                                            {"qss3", nullptr, read_qss},
                                            {"symplectic_euler", read_symplectic_euler},
                                            {"euler", read_runge_kutta<euler>},
                                            {"rk4", read_runge_kutta<rk4>},
                                            {"dopri5", read_embedded<dopri5>},
                                            {"dop853", read_embedded<dop853>},
                                            {"gauss_radau", read_gauss_radau},
                                            {"hermite", read_hermite},
                                            {"implicit_midpoint", read_implicit<ImplicitMidpoint>},
                                            {"newmark", read_implicit<Newmark>},
                                            {"explicit_implicit", read_explicit_implicit},
                                            {"implicit_subcycling", read_subcycled_implicit},
                                            {"conrad", read_conrad},
                                            {"random_step", read_random_step},
                                            {"exponential_step", read_exponential_step}};

IntegratorFactory read_inner(const MethodArguments& arguments) {
  const Value inner = arguments.integrator.at("inner");
  if (!inner.is_object()) inner.refuse("an object with a type");
  std::vector<IntegratorReader> deterministic;
  for (const auto& reader : integrators)
    if (const std::string type = reader.type; reader.read != nullptr && type != "random_taylor" &&
                                              type != "conrad" && type != "random_step" &&
                                              type != "exponential_step")
      deterministic.push_back(reader);
  Document any_length(R"({"type": "fixed", "step": 1e300})", "control");
  const Value control = any_length.root("control");
  return chosen(inner, deterministic)
      .read({inner, control, arguments.system, arguments.seed, arguments.threads});
}

}  // namespace

std::vector<std::string> integrator_types() {
  std::vector<std::string> types;
  for (const IntegratorReader& reader : integrators) types.emplace_back(reader.type);
  return types;
}

std::vector<std::string> schedule_types() { return {"lockstep", "block", "asynchronous"}; }

Method read_method(const Value& scene, std::shared_ptr<const System<double>> system, std::uint64_t seed) {
  const Value integrator = scene.at("integrator");
  if (!integrator.is_object()) integrator.refuse("an object with a type");
  if (const auto read = chosen(integrator, integrators).own_schedule) return read(scene, std::move(system));
  const Value schedule = scene.at("schedule", JsonText{R"({"type": "lockstep"})"});
  if (schedule.at("type", "lockstep").one_of(schedule_types()) != "lockstep")
    return read_clocks(scene, schedule, std::move(system), seed);
  schedule.only({"type", "max_steps", "threads"});
  const auto most = std::numeric_limits<std::int64_t>::max();
  const auto max_steps = schedule.has("max_steps") ? schedule.at("max_steps").integer(1, most) : most;

  constexpr std::int64_t most_threads = 1024;
  const int threads =
      schedule.has("threads") ? static_cast<int>(schedule.at("threads").integer(1, most_threads)) : 1;

  const Value control = scene.at("control");
  if (!control.is_object()) control.refuse("an object with a type");
  const auto method =
      chosen(integrator, integrators).read({integrator, control, std::move(system), seed, threads});
  std::optional<double> fixed_step;
  if (control.at("type").text() == "fixed" && !control.has("courant"))
    fixed_step = method.cycle * control.at("step").number(positive);
  return {[make = method.make] { return std::make_unique<Lockstep>(make()); },
          method.series,
          static_cast<std::uint64_t>(max_steps),
          threads,
          fixed_step,
          method.mean_orders,
          method.largest_degree,
          method.at_least};
}

}  // namespace jetlag
