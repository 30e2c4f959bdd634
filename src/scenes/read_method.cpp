// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "jetlag/control/courant.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/halve_double.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/control/variance_target.hpp"
#include "jetlag/integrators/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

const Range fraction{0, 1, false, true, "a number > 0 and <= 1"};

double read_max_step(const Value& control) {
  const auto value = control.find("max_step");
  return value ? value->number(positive) : infinite;
}

// ---- controls --------------------------------------------------------------------------------------------

std::unique_ptr<Control> read_fixed(const Value& control, const TruncationLaw&) {
  control.only({"type", "step", "courant"});
  return std::make_unique<FixedStep>(control.at("step").number(positive));
}

std::unique_ptr<Control> read_jorba_zou(const Value& control, const TruncationLaw&) {
  control.only({"type", "max_step", "tolerance", "courant"});
  return std::make_unique<JorbaZou>(read_max_step(control));
}

std::unique_ptr<Control> read_variance(const Value& control, const TruncationLaw&) {
  control.only({"type", "step", "max_step", "tolerance_random", "tolerance_bias", "courant"});
  return std::make_unique<VarianceTarget>(control.at("step").number(positive), read_max_step(control),
                                          control.at("tolerance_random").number(positive),
                                          control.at("tolerance_bias").number(positive));
}

std::unique_ptr<Control> read_halve_double(const Value& control, const TruncationLaw& law) {
  control.only({"type", "step", "max_step", "min_variance", "max_variance", "courant"});
  const double step = control.at("step").number(positive), max_step = read_max_step(control),
               least = control.at("min_variance").number(positive),
               most = control.at("max_variance").number(positive);
  return checked(
      control, [&] { return std::make_unique<HalveDouble>(step, max_step, least, most, law.min_degree()); });
}

struct ControlReader {
  const char* type;
  std::unique_ptr<Control> (*read)(const Value& control, const TruncationLaw& law);
};
constexpr ControlReader controls[] = {{"fixed", read_fixed},
                                      {"jorba_zou", read_jorba_zou},
                                      {"variance", read_variance},
                                      {"halve_double", read_halve_double}};

/// The member of a register that "type" names.
template <class Readers>
const auto& chosen(const Value& value, const Readers& readers) {
  std::vector<std::string> types;
  for (const auto& reader : readers) types.push_back(reader.type);
  const std::string type = value.at("type").one_of(types);
  return *std::ranges::find(readers, type, [](const auto& reader) { return std::string(reader.type); });
}

/// The fraction of the Courant limit, if asked for, and the fastest frequency it refers to.
std::optional<std::pair<double, double>> read_courant(const Value& control, const System<double>& system) {
  const auto courant = control.find("courant");
  if (!courant) return std::nullopt;
  const double safety = courant->number(fraction), omega = frequency_bound(system);
  if (omega == 0) courant->refuse("left out: no force of this scene has a stiffness that limits the step");
  return std::pair(safety, omega);
}

std::unique_ptr<Control> read_control(const Value& control, const TruncationLaw& law, VelocitySeries velocity,
                                      const System<double>& system) {
  auto inner = chosen(control, controls).read(control, law);
  const auto courant = read_courant(control, system);
  if (!courant) return inner;
  return checked(control.at("courant"), [&] {
    const auto [safety, omega] = *courant;
    return std::make_unique<Courant>(std::move(inner), safety,
                                     courant_limit(law, velocity, omega, common_damping(system)), omega);
  });
}

// ---- integrators -----------------------------------------------------------------------------------------

/// "degree", or what a tolerance of jorba_zou asks for.
int read_degree(const Value& integrator, const Value& control) {
  const auto tolerance = control.find("tolerance");
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
  bool at_least;  // mean_orders is a lower bound
  int largest_degree;
  std::optional<SeriesMethod> series{};
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
          mean_orders(known, options, *arguments.system, read),
          std::holds_alternative<SequentialLaw>(law) &&
              read <= known.max_degree() - (options.velocity == VelocitySeries::own_series ? 0 : 1),
          known.max_degree(), SeriesMethod{law, options, model}};
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
  if (const auto tolerance = arguments.control.find("tolerance"))
    tolerance->refuse("left out for random_taylor, whose degrees are given");
  require_control_for(law, arguments.control);
  const bool shared_draw = integrator.at("shared_draw", true).boolean();
  const Draw draws = read_draws(integrator, law, shared_draw, arguments.system->particles());
  return series_method(arguments, law, shared_draw, draws);
}

IntegratorFactory read_leapfrog(const MethodArguments& arguments) {
  const Value& control = arguments.control;
  arguments.integrator.only({"type"});
  if (arguments.threads > 1)
    throw SceneError("schedule.threads: got " + std::to_string(arguments.threads) +
                     "; must be 1 for leapfrog");
  if (chosen(control, controls).read != read_fixed)
    control.at("type").refuse("fixed, which is what leapfrog works with");
  control.only({"type", "step", "courant"});
  double step = control.at("step").number(positive);
  if (const auto courant = read_courant(control, *arguments.system))
    step = std::min(step, courant->first * 2.0 / courant->second);
  return {[system = arguments.system, step] { return std::make_unique<Leapfrog>(*system, step); }, 1.0, false,
          2};
}

struct IntegratorReader {
  const char* type;
  IntegratorFactory (*read)(const MethodArguments&);
};
constexpr IntegratorReader integrators[] = {
    {"taylor", read_taylor}, {"random_taylor", read_random_taylor}, {"leapfrog", read_leapfrog}};

}  // namespace

Method read_method(const Value& scene, std::shared_ptr<const System<double>> system, std::uint64_t seed) {
  const Value schedule = scene.at("schedule", Json{{"type", "lockstep"}});
  schedule.only({"type", "max_steps", "threads"}).at("type", "lockstep").one_of({"lockstep"});
  const auto most = std::numeric_limits<std::int64_t>::max();
  const auto max_steps = schedule.has("max_steps") ? schedule.at("max_steps").integer(1, most) : most;

  constexpr std::int64_t most_threads = 1024;
  const int threads =
      schedule.has("threads") ? static_cast<int>(schedule.at("threads").integer(1, most_threads)) : 1;

  const Value integrator = scene.at("integrator"), control = scene.at("control");
  if (!integrator.is_object()) integrator.refuse("an object with a type");
  if (!control.is_object()) control.refuse("an object with a type");
  const auto method =
      chosen(integrator, integrators).read({integrator, control, std::move(system), seed, threads});
  std::optional<double> fixed_step;
  if (control.at("type").text() == "fixed" && !control.has("courant"))
    fixed_step = control.at("step").number(positive);
  return {[make = method.make] { return std::make_unique<Lockstep>(make()); },
          method.series,
          static_cast<std::uint64_t>(max_steps),
          threads,
          fixed_step,
          method.mean_orders,
          method.at_least,
          method.largest_degree};
}

}  // namespace jetlag
