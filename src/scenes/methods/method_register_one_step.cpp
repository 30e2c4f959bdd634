// SPDX-License-Identifier: MIT
// Pages of the methods of others that take one step after another with all particles.
#include "scenes/methods/method_keys.hpp"
#include "scenes/methods/method_register.hpp"

namespace jetlag {

std::vector<MethodPage> one_step_pages() {
  using namespace method_keys;
  return {
      {.name = "leapfrog",
       .what = "Leapfrog in its velocity form (Stoermer, Verlet)",
       .when = "Long runs to some digits with forces that depend on positions only: one force evaluation a "
               "step, and an energy that does not drift. The measure of every explicit method.",
       .declared = {{"integrators/explicit/leapfrog.hpp", "Leapfrog"}},
       .keys =
           with({{"control.courant",
                  "no step exceeds this fraction of the stability limit 2 / omega, > 0 and <= 1", "none"}},
                fixed),
       .examples = {R"({"integrator": {"type": "leapfrog"},
 "control": {"type": "fixed", "step": 0.01, "courant": 0.5}})"},
       .proofs = {{"1 - h * h / 4",
                   "v^2 + (1 - h^2/4) x^2 of x'' = -x is kept to rounding over 2000 steps of h = 1/2",
                   "Leapfrog.ConservesItsModifiedOscillatorEnergy", "integrators/explicit/leapfrog_test.cpp"},
                  {"28u * 1001",
                   "one evaluation of 28 springs in each of 1000 steps, and one before the first",
                   "Leapfrog.EvaluatesForcesOnceAStep", "integrators/explicit/leapfrog_test.cpp"}}},

      {.name = "symplectic_euler",
       .what = "The symplectic (semi-implicit) Euler method, of order 1",
       .when = "To compare with: the simplest method whose energy does not drift. `leapfrog` costs as much "
               "and is of order 2. Refuses drag.",
       .declared = {{"integrators/explicit/symplectic_euler.hpp", "SymplecticEuler"}},
       .keys = fixed,
       .examples = {R"({"integrator": {"type": "symplectic_euler"},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"x * x + v * v - h * x * v",
                   "this quantity of x'' = -x is kept to rounding over 2000 steps of h = 1/2",
                   "SymplecticEuler.ConservesItsModifiedOscillatorEnergy",
                   "integrators/explicit/symplectic_euler_test.cpp"}}},

      {.name = "euler",
       .what = "Euler's explicit method, of order 1",
       .when = "To compare with, and as the `inner` method of those that perturb another. Oscillations grow "
               "at any step.",
       .declared = {{"integrators/explicit/rk4.hpp", "euler"},
                    {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
       .keys = fixed,
       .examples = {R"({"integrator": {"type": "euler"},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"1e4 * eps",
                   "its table misses the condition of order 1 by no more, and that of order 2 by over 1e-7",
                   "RungeKutta.TablesMeetTheConditionsOfTheirOrderAndOfNoMore",
                   "integrators/explicit/runge_kutta_test.cpp"}}},

      {.name = "rk4",
       .what = "The classical method of Runge and Kutta, of order 4",
       .when = "Short runs to some digits, with forces of any kind: four evaluations a step. Over long runs "
               "its energy drifts.",
       .declared = {{"integrators/explicit/rk4.hpp", "rk4"},
                    {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
       .keys = fixed,
       .examples = {R"({"integrator": {"type": "rk4"},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"1e4 * eps",
                   "its table misses none of the 8 conditions up to order 4 by more, and one of order 5 by "
                   "over 1e-7",
                   "RungeKutta.TablesMeetTheConditionsOfTheirOrderAndOfNoMore",
                   "integrators/explicit/runge_kutta_test.cpp"}}},

      {.name = "dopri5",
       .what = "The method of Dormand and Prince of order 5(4)",
       .when = "Forces of any kind to medium accuracy, with steps that follow the motion; the "
               "general-purpose method of most programs.",
       .declared = {{"integrators/explicit/dopri5.hpp", "dopri5"},
                    {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
       .keys = fixed_or("embedded", tolerance),
       .examples = {R"({"integrator": {"type": "dopri5"},
 "control": {"type": "embedded", "tolerance": 1e-8}})",
                    R"({"integrator": {"type": "dopri5"},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"dopri5().error), 4",
                   "its estimate is the difference to a method of order 4 and of no more",
                   "RungeKutta.EstimatesAreDifferencesToMethodsOfTheirOrder",
                   "integrators/explicit/runge_kutta_test.cpp"},
                  {"1 + 6 * (result.work.steps + result.work.rejected)",
                   "six force evaluations for each step tried",
                   "RungeKutta.ARejectedStepIsTriedAgainAndCounted",
                   "integrators/explicit/runge_kutta_test.cpp"}}},

      {.name = "dop853",
       .what = "The method of Dormand and Prince of order 8(5,3)",
       .when = "Forces of any kind to high accuracy, tolerances below some 1e-8, with steps that follow the "
               "motion.",
       .declared = {{"integrators/explicit/dop853.hpp", "dop853"},
                    {"integrators/explicit/runge_kutta.hpp", "RungeKuttaTable"}},
       .keys = fixed_or("embedded", tolerance),
       .examples = {R"({"integrator": {"type": "dop853"},
 "control": {"type": "embedded", "tolerance": 1e-11}})",
                    R"({"integrator": {"type": "dop853"},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"1u + 1 + 2 + 4 + 9 + 20 + 48 + 115", "so many trees up to order 8 give a condition each",
                   "RungeKutta.ThereAre200TreesUpToOrderEight", "integrators/explicit/runge_kutta_test.cpp"},
                  {"1e4 * eps", "its table misses none of these 200 conditions by more",
                   "RungeKutta.TablesMeetTheConditionsOfTheirOrderAndOfNoMore",
                   "integrators/explicit/runge_kutta_test.cpp"}}},

      {.name = "gauss_radau",
       .what = "Gauss-Radau integration of order 15 (the method of IAS15)",
       .when = "Planets and other smooth motions to rounding, close encounters included, where a method "
               "other than `taylor` is wanted to compare with.",
       .declared = {{"integrators/explicit/gauss_radau.hpp", "GaussRadau"}},
       .keys = fixed_or("embedded", {"control.tolerance", "with `embedded`: eps_b > 0", "1e-9"}),
       .examples = {R"({"integrator": {"type": "gauss_radau"},
 "control": {"type": "embedded"}})",
                    R"({"integrator": {"type": "gauss_radau"},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"15, 1.0",
                   "the power of the step with which the error falls, e = 0.8, and what the next term adds",
                   "GaussRadau.TheErrorFallsWithThePowerFifteen",
                   "integrators/explicit/gauss_radau_test.cpp"},
                  {"1e-13",
                   "relative energy error after 100 periods of e = 0.9, in fewer than 250 steps a period",
                   "GaussRadau.KeepsTheEnergyOfAnEccentricOrbitToRounding",
                   "integrators/explicit/gauss_radau_test.cpp"}}},

      {.name = "hermite",
       .what = "Hermite's method of order 4, with the jerk",
       .when = "Bodies under gravity to medium accuracy; with 5 iterations or more and fixed steps, long "
               "runs whose energy does not drift.",
       .declared = {{"integrators/explicit/hermite.hpp", "Hermite"}},
       .keys = with({{"integrator.iterations",
                      "of the corrector, 1 to 20; 1 stands for 2 where forces depend on velocities", "1"}},
                    fixed_or("aarseth", {"control.accuracy", "with `aarseth`: eta > 0", "0.01"})),
       .examples = {R"({"integrator": {"type": "hermite"},
 "control": {"type": "aarseth"}})",
                    R"({"integrator": {"type": "hermite", "iterations": 8},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs =
           {{"1e-13",
             "x of an oscillator after 40 converged steps, which turn it by 2 atan((h/2) / (1 - h^2/12))",
             "Hermite.ConvergedStepsAreThoseOfTheFourthPadeApproximation",
             "integrators/explicit/hermite_test.cpp"},
            {"4.0, 0.1", "its order, measured with drag and with forces that depend on time",
             "Hermite.IsOfOrderFourWithDragAndWithForcesThatDependOnTime",
             "integrators/explicit/hermite_test.cpp"}}},

      {.name = "implicit_midpoint",
       .what = "The implicit midpoint rule, of order 2, by Newton's method with exact Jacobians",
       .when = "Stiff scenes with steps far beyond the limit of explicit methods, where momentum and angular "
               "momentum are to be kept; damping is welcome.",
       .declared = {{"integrators/implicit/implicit.hpp", "ImplicitMidpoint"}},
       .keys = fixed,
       .examples = {R"({"integrator": {"type": "implicit_midpoint"},
 "control": {"type": "fixed", "step": 0.1}})"},
       .proofs = {{"100 * 1e3 * eps", "energy of an oscillator after 100 steps with h omega = 1000",
                   "Implicit.StiffOscillatorsKeepTheirAmplitude", "integrators/implicit/implicit_test.cpp"},
                  {"40 * 8 * eps", "x of an oscillator after 40 steps, which turn it by 2 atan(h/2)",
                   "Implicit.TurnsAnOscillatorByTheCayleyTransform",
                   "integrators/implicit/implicit_test.cpp"}}},

      {.name = "newmark",
       .what =
           "Newmark's method with the mean acceleration, of order 2, by Newton's method with exact Jacobians",
       .when = "Stiff and mostly linear scenes with steps far beyond the limit of explicit methods: there it "
               "conserves the energy.",
       .declared = {{"integrators/implicit/implicit.hpp", "Newmark"}},
       .keys = fixed,
       .examples = {R"({"integrator": {"type": "newmark"},
 "control": {"type": "fixed", "step": 0.1}})"},
       .proofs = {{"100 * 1e6 / 4 * eps", "energy of an oscillator after 100 steps with h omega = 1000",
                   "Implicit.StiffOscillatorsKeepTheirAmplitude", "integrators/implicit/implicit_test.cpp"},
                  {"40 * 8 * eps", "x of an oscillator after 40 steps, which turn it by 2 atan(h/2)",
                   "Implicit.TurnsAnOscillatorByTheCayleyTransform",
                   "integrators/implicit/implicit_test.cpp"}}},

      {.name = "explicit_implicit",
       .what = "Leapfrog for most particles, Newmark's method for the stiff ones, in one step",
       .when = "A few stiff particles in a large scene, at one step that suits the rest: nothing resonates, "
               "and only the stiff ones are solved for.",
       .declared = {{"integrators/implicit/explicit_implicit.hpp", "ExplicitImplicit"}},
       .keys =
           with({{"integrator.implicit",
                  "a list of particles that are not fixed, or `courant`: those whose limit is below the step",
                  "required"}},
                fixed),
       .examples = {R"({"integrator": {"type": "explicit_implicit", "implicit": [2, 3]},
 "control": {"type": "fixed", "step": 0.01}})",
                    R"({"integrator": {"type": "explicit_implicit", "implicit": "courant"},
 "control": {"type": "fixed", "step": 0.1}})"},
       .proofs = {{"1.035276180410083",
                   "the limit of the step on a chain of ten masses, five implicit, however stiff these",
                   "ExplicitImplicit.IsStableUpToTheLimitOfTheExplicitParticles",
                   "integrators/implicit/explicit_implicit_test.cpp"},
                  {"99.3", "times that of leapfrog where the implicit half is 10000 times stiffer",
                   "ExplicitImplicit.GainsAHundredfoldOnLeapfrog",
                   "integrators/implicit/explicit_implicit_test.cpp"}}},

      {.name = "implicit_subcycling",
       .what = "The trapezoidal rule with long steps for some particles and short ones for the others",
       .when = "A fast part of a stiff scene: all steps may lie far beyond the limit of explicit methods, "
               "and only the part whose motion is to be resolved takes the short ones. Its cost grows with "
               "the interface: every short step solves for each component of the coarse particles that share "
               "an element with a fine one. Drag and forces of the time are welcome.",
       .declared = {{"integrators/implicit/implicit_subcycling.hpp", "ImplicitSubcycling"}},
       .keys = with({{"integrator.coarse",
                      "a list of the particles with long steps, each once; the others are fine", "required"},
                     {"integrator.ratio",
                      "m of the long step to the short one, whole number from 1 to 1000000", "required"},
                     {"control.type", "`fixed`", "required"},
                     {"control.step", "dt of fine particles [s], > 0; coarse ones take m dt", "required"}},
                    one_thread),
       .examples = {R"({"integrator": {"type": "implicit_subcycling", "coarse": [4, 5, 6, 7], "ratio": 5},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs =
           {{"1e-12",
             "the most by which the energy changes, relatively, in 10000 cycles of linear forces, dt ten "
             "times the explicit limit, m = 3 and 10",
             "ImplicitSubcycling.KeepsTheEnergyOfLinearForces",
             "integrators/implicit/implicit_subcycling_test.cpp"},
            {"2.0, 0.1",
             "its order, measured at m = 1, 2, 5 and 10 on springs with drag, and how far it may be off",
             "ImplicitSubcycling.HasOrderTwoAtAnyRatio", "integrators/implicit/implicit_subcycling_test.cpp"},
            {"1e-13", "momentum of a cube of springs, half of it coarse, after 40 cycles",
             "ImplicitSubcycling.KeepsMomentumToRounding",
             "integrators/implicit/implicit_subcycling_test.cpp"}}},

      {.name = "conrad",
       .what = "Normal noise added to another method",
       .when = "An ensemble about a deterministic method, with sigma fitted to its errors; no invariant "
               "survives.",
       .declared = {{"integrators/perturbed/conrad.hpp", "Conrad"}},
       .keys = with({inner,
                     {"integrator.order", "p > 0, best the order of the inner method", "required"},
                     {"integrator.sigma", "> 0, in SI units", "1"}},
                    fixed),
       .examples = {R"({"integrator": {"type": "conrad", "inner": {"type": "rk4"}, "order": 4},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs =
           {{"5.2632e-3",
             "variance of Euler's method with noise on y' = -y after 100 steps of 0.1, sigma = 1, p = 1",
             "Conrad.TheVarianceOfADecayIsThatOfItsAutoregression",
             "integrators/perturbed/perturbed_test.cpp"}}},

      {.name = "random_step",
       .what = "Another method with random lengths of its steps",
       .when = "An ensemble about a deterministic method, as with `conrad`, that keeps what the method "
               "keeps: momentum, a symplectic flow.",
       .declared = {{"integrators/perturbed/random_step.hpp", "RandomStep"},
                    {"integrators/perturbed/random_step.hpp", "StepDistribution"}},
       .keys = with({inner,
                     {"integrator.order", "p > 0.5, best the order of the inner method", "required"},
                     {"integrator.distribution", "`uniform`, for steps below 1 s; `lognormal`", "uniform"}},
                    fixed),
       .examples =
           {R"({"integrator": {"type": "random_step", "inner": {"type": "implicit_midpoint"}, "order": 2},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs =
           {{"1e-12",
             "angular momentum of a perturbed planet by the midpoint rule with random steps, up to t = 40",
             "RandomStep.KeepsTheAngularMomentumThatTheMidpointRuleKeeps",
             "integrators/implicit/implicit_test.cpp"},
            {"std::pow(h, 2 * p + 1) / 3",
             "what random lengths add to the second moment of y' = -y by Euler's method",
             "RandomStep.TheSecondMomentOfADecayIsInClosedForm",
             "integrators/perturbed/perturbed_test.cpp"}}},

      {.name = "exponential_step",
       .what = "Euler's method with exponentially distributed steps",
       .when =
           "To study ensembles whose moments are known in closed form. Of order 1, and stable in mean square "
           "at half of Euler's step only.",
       .declared = {{"integrators/perturbed/exponential_step.hpp", "ExponentialStep"}},
       .keys = with(
           {{"control.type", "`fixed`", "required"}, {"control.step", "the mean h [s], > 0", "required"}},
           one_thread),
       .examples = {R"({"integrator": {"type": "exponential_step"},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"1.105", "second moment of y' = -y after a step of mean 1.05; 0.905 at 0.95",
                   "ExponentialStep.TheSecondMomentOfADecayIsInClosedForm",
                   "integrators/perturbed/perturbed_test.cpp"}}}};
}

}  // namespace jetlag
