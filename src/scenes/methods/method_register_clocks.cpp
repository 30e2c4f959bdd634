// SPDX-License-Identifier: MIT
// Pages of methods with many clocks: of each particle, element or component.
#include "scenes/methods/method_keys.hpp"
#include "scenes/methods/method_register.hpp"

namespace jetlag {

std::vector<MethodPage> clock_pages() {
  using namespace method_keys;
  return {
      {.name = "block",
       .what = "Taylor's method with a clock for each particle, on powers of two",
       .when = "A scene that is stiff, or fast, in one place only: the rest takes longer steps at the "
               "accuracy of one clock. Of the two kinds of clocks the one to take.",
       .declared = {{"schedule/block.hpp", "BlockSteps"}, {"control/last_two.hpp", "last_two_step"}},
       .keys = with({{"schedule.grading", "levels between neighbours, 0 to 64; 0: any number", "1"}}, clocks),
       .examples = {R"({"integrator": {"type": "taylor", "degree": 8},
 "schedule": {"type": "block", "tolerance": 1e-9, "max_step": 0.1}})",
                    R"({"integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 4},
 "control": {"type": "fixed", "step": 0.1, "courant": 0.5},
 "schedule": {"type": "block"}})",
                    R"({"integrator": {"type": "taylor", "degree": 8},
 "control": {"type": "last_two", "tolerance": 1e-9, "max_step": 0.1},
 "schedule": {"type": "block"}})"},
       .proofs = {{"10 * block.work.element_coefficients",
                   "so much less work than one clock on a chain of 128 masses with four springs 10000 times "
                   "stiffer, at most 1.5 times its error",
                   "StiffSpot.CostsBlockStepsATenthOfLockstep", "schedule/stiff_chain_test.cpp"},
                  {"13.3, 11.4, 11.4, 10.7", "measured: times less work at degrees 4, 8, 12, 16",
                   "StiffSpot.CostsBlockStepsATenthOfLockstep", "schedule/stiff_chain_test.cpp"}},
       .named_by = "schedule.type"},

      {.name = "asynchronous",
       .what = "Taylor's method with a free clock for each particle",
       .when =
           "Where no ratio between the steps of particles may be special; `block` has less work for the same "
           "accuracy, the more so at high degree.",
       .declared = {{"schedule/asynchronous.hpp", "Asynchronous"}, {"control/last_two.hpp", "last_two_step"}},
       .keys = with({{"schedule.grading", "no step is longer than so many times a neighbour's, >= 1", "2"},
                     {"schedule.notify",
                      "tolerances by which a motion may depart from what a neighbour was told, > 0", "1"}},
                    clocks),
       .examples = {R"({"integrator": {"type": "taylor", "degree": 6},
 "schedule": {"type": "asynchronous", "tolerance": 1e-9, "max_step": 0.1}})",
                    R"({"integrator": {"type": "taylor", "degree": 4},
 "control": {"type": "fixed", "step": 0.1, "courant": 0.5},
 "schedule": {"type": "asynchronous"}})",
                    R"({"integrator": {"type": "taylor", "degree": 6},
 "control": {"type": "last_two", "tolerance": 1e-9, "max_step": 0.1},
 "schedule": {"type": "asynchronous"}})"},
       .proofs = {{"12 * free.work.updates",
                   "so many fewer updates than one clock on the same chain as for `block`, degrees 4 and 8, "
                   "at most 5 times its error (measured: 1.07 and 1.00)",
                   "StiffSpot.CostsFreeClocksATwelfthOfTheUpdates", "schedule/stiff_chain_test.cpp"}},
       .named_by = "schedule.type"},

      {.name = "avi",
       .what = "Asynchronous variational integrator: a clock for each element",
       .when =
           "Elements of very different stiffness, forces with a potential only, where momentum is to be kept "
           "to rounding and the energy must not drift; with `resonance` avoided where steps are long.",
       .declared = {{"schedule/avi.hpp", "Avi"}, {"schedule/impulses.hpp", "Impulses"}},
       .keys =
           with({{"control.step", "[s], > 0: of all elements, or a list with one for each force",
                  "none; step, courant or both: the shorter"},
                 {"control.courant", "the fraction of its own limit that each element takes, > 0 and <= 1",
                  "none; step, courant or both: the shorter"}},
                own_clocks),
       .examples = {R"({"integrator": {"type": "avi"},
 "control": {"courant": 0.2}})",
                    R"({"integrator": {"type": "avi", "resonance": "avoided"},
 "control": {"step": [0.01], "courant": 0.2}})"},
       .proofs = {{"1.0203835232",
                   "spectral radius at h = 0.14075 of the chain wall-100-A-1-B-1-wall, soft springs every "
                   "second step, in 75-digit arithmetic",
                   "AviResonance.HasTheBandsOfTheChainWithRatioTwo", "schedule/avi/avi_resonance_test.cpp"},
                  {"0.01887",
                   "largest relative energy error of ten masses at a tenth of each limit, without drift",
                   "Avi.HasTheEnergyErrorOfTheReferenceWithoutDrift", "schedule/avi/avi_test.cpp"},
                  {"1e-13", "momentum of the same after 1000 s", "Avi.KeepsMomentumToRounding",
                   "schedule/avi/avi_test.cpp"}}},

      {.name = "subcycling",
       .what = "Leapfrog with a step for each particle, in whole ratios or any other",
       .when = "A stiff part of a scene that should not dictate the steps of the rest, to some digits, and "
               "forces without a potential (not of velocities); with `resonance` avoided. With a potential "
               "take `avi`.",
       .declared = {{"schedule/subcycling.hpp", "Subcycling"}, {"schedule/impulses.hpp", "Impulses"}},
       .keys = with(
           {{"integrator.ratio",
             "of long steps to the short one, 1 to 1e9: of the particles in `coarse`, or without it a list "
             "of one for each; or `courant`: what the limits of those in `coarse`, or of each, allow",
             "required"},
            {"integrator.coarse", "a list of particles that are not fixed", "none"},
            {"control.step", "the short step [s], > 0", "none; step, courant or both: the shorter"},
            {"control.courant",
             "the fraction of the limit of the fastest frequency, or of each particle, > 0 and <= 1",
             "none; step, courant or both: the shorter"}},
           own_clocks),
       .examples = {R"({"integrator": {"type": "subcycling", "coarse": [4, 5, 6, 7], "ratio": 2.5},
 "control": {"step": 0.01}})",
                    R"({"integrator": {"type": "subcycling", "ratio": "courant", "resonance": "avoided"},
 "control": {"courant": 0.2}})"},
       .proofs = {{"0.1268403737",
                   "the step where the chain wall-100-A-1-B-1-wall with the ratio 4 begins to resonate, in "
                   "75-digit arithmetic; the band ends at 0.1276082943",
                   "SubcyclingResonance.HasTheBandOfTheChainWithRatioFour",
                   "schedule/subcycling/subcycling_resonance_test.cpp"},
                  {"1.018873", "spectral radius at h = 0.17975 for the ratio 5/2",
                   "SubcyclingResonance.HasBandsForRealRatios",
                   "schedule/subcycling/subcycling_resonance_test.cpp"},
                  {"1e-13",
                   "no farther is it from the scheme of 1979, which the test writes down, in 1000 steps of "
                   "whole ratios",
                   "Subcycling.IsTheSchemeOf1979WhereRatiosAreWhole",
                   "schedule/subcycling/subcycling_test.cpp"}}},

      {.name = "qss1",
       .what = "Quantized states of order 1: a component acts where it has changed by a quantum",
       .when = "To study how quantized states behave: events grow as 1 / quantum, and oscillations without "
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
                   "Qss.ErrorsOnAPlanetAreProportionalToTheQuantum", "schedule/qss/qss_test.cpp"}}},

      {.name = "qss2",
       .what = "Quantized states of order 2: a component acts where it has left its line by a quantum",
       .when = "A damped scene, most of which is at rest or moves evenly while some of it is busy, to a few "
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
                   "Qss.OfHigherOrdersKeepsTheEnergyToSomeQuanta", "schedule/qss/qss_test.cpp"}}},

      {.name = "qss3",
       .what = "Quantized states of order 3: a component acts where it has left its parabola by a quantum",
       .when = "As `qss2`, to more digits: events grow as quantum^(-1/3) instead of quantum^(-1/2). An "
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
                   "Qss.KeepsMomentumToRounding", "schedule/qss/qss_test.cpp"}}}};
}

}  // namespace jetlag
