// SPDX-License-Identifier: MIT
#pragma once
// A method is one record: what it is, when to use it, the keys of its scenes, what proves it, what it promises, and how
// it is made from a scene. Nothing else need be said of it: the reader checks scenes by it, `jetlag methods` prints it,
// tests hold it to it, and studies run it.
//
// To add one, write its record in a file of this folder (symplectic_euler.cpp is a short one) and name it in register.cpp.
//
// Pairs of a header and a symbol are read by .cmake/method_docs.cmake too, from every file of this folder: write both
// as plain text, as they are there. The page then has the comments of the header as the code has them.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "jetlag/integrators/integrator.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

/// What a header declares; header: below include/jetlag, symbol: of a class or a function.
struct Declaration {
  std::string header, symbol;
};

/// What a test (Suite.Name) in a file below tests shows; number: as it stands in that test.
struct Proof {
  std::string number, claim, test, file;
};

/// What tests/integrators/laws_test.cpp holds an integrator to, as `make` makes it with a fixed step [s].
struct Promise {
  std::string name;             // of this variant of the method, in letters, digits and _
  double order;                 // global; in mean square where it draws
  int exact_degree;             // solves motions of this degree in time exactly; -1: none, it is perturbed
  bool symmetric = false;       // a step, and a step with reversed velocities, return
  bool energy_bounded = false;  // over many periods
  bool random_length = false;   // the step is a mean
  double coarse_step =
      1.0 / 16;            // of the two that measure the order, the other is a quarter; 0: a test of its own
  double next_term = 0.1;  // what the next term of the error adds to the order at that step, at most
  std::function<std::unique_ptr<Integrator>(const System<double>& system, double step, std::uint64_t seed)>
      make;
};

/// As above, of an integrator that is constructed from a system and a step.
template <class M>
std::unique_ptr<Integrator> made(const System<double>& system, double step, std::uint64_t) {
  return std::make_unique<M>(system, step);
}

/// What a scene gives to a method that takes one step after another with all particles.
struct StepperArguments {
  Value integrator, control;
  std::shared_ptr<const System<double>> system;
  std::uint64_t seed;
  int threads;
  const State<double>& start;
};

/// Such a method.
struct Stepper {
  std::function<std::unique_ptr<Integrator>()> make;
  double mean_orders;
  int largest_degree;
  bool at_least = false;  // mean_orders is a lower bound
  std::optional<SeriesMethod> series{};
  int cycle = 1;  // steps of the control in a step
};

/// What a scene gives to a method with a schedule of its own.
struct ScheduleArguments {
  Value scene, integrator, schedule;
  std::shared_ptr<const System<double>> system;
  std::uint64_t seed;
  int threads;
  const State<double>& start;
};

struct MethodRecord {
  std::string name;                   // in a scene
  std::string what;                   // one line
  std::string when;                   // to use it
  std::vector<Declaration> declared;  // the method itself, then what it stands on
  std::vector<SceneKey> keys;         // beside that of its name; scenes are checked by them
  std::vector<std::string> examples;  // parts of scenes, in JSON
  std::vector<Proof> proofs;          //
  std::vector<Promise> promises{};    // of a stepper
  bool draws = false;                 // random numbers
  bool threaded = false;              // takes schedule.threads
  bool follows_contacts = false;      // runs scenes in which elements come and go
  std::string named_by = "integrator.type";

  /// One of these two makes it: a stepper under `lockstep`, or a schedule of its own. Both throw SceneError.
  Stepper (*stepper)(const StepperArguments&) = nullptr;
  Method (*own_schedule)(const ScheduleArguments&) = nullptr;
};

/// Makes a stepper once, so that what it refuses is said of the scene.
template <class Make>
Stepper one_step_method(const StepperArguments& arguments, double evaluations, Make make) {
  checked(arguments.integrator.at("type"), make);
  return {make, evaluations, 2};
}

/// The one step [s] of a method with the control `fixed`.
inline double read_step(const StepperArguments& arguments) {
  return arguments.control.at("step").number(positive);
}

/// "inner": a method that draws nothing, for steps of any length.
Stepper read_inner(const StepperArguments& arguments);

}  // namespace jetlag
