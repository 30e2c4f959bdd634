// SPDX-License-Identifier: MIT
// Pages of Taylor's methods with one clock for all.
#include "scenes/methods/method_keys.hpp"
#include "scenes/methods/method_register.hpp"

namespace jetlag {

std::vector<MethodPage> taylor_pages() {
  using namespace method_keys;
  return {
      {.name = "taylor",
       .what = "Taylor's method of a fixed degree",
       .when = "Smooth motions, to any accuracy: degree 12 to 20 with `jorba_zou` is the cheapest way to "
               "many digits. The method to begin with.",
       .declared = {{"integrators/taylor.hpp", "taylor"}, {"control/jorba_zou.hpp", "jorba_zou_step"}},
       .keys = with(
           {{"integrator.degree", "1 to 256", "required without control.tolerance of jorba_zou"},
            {"control.tolerance",
             "with `jorba_zou`, in place of integrator.degree: between 0 and 1; with `last_two`: [m], > 0",
             "required with last_two"}},
           series),
       .examples = {R"({"integrator": {"type": "taylor", "degree": 20},
 "control": {"type": "jorba_zou"}})",
                    R"({"integrator": {"type": "taylor"},
 "control": {"type": "jorba_zou", "tolerance": 1e-12}})",
                    R"({"integrator": {"type": "taylor", "degree": 8},
 "control": {"type": "fixed", "step": 0.01, "courant": 0.5}})",
                    R"({"integrator": {"type": "taylor", "degree": 8},
 "control": {"type": "last_two", "tolerance": 1e-9}})",
                    R"({"integrator": {"type": "taylor", "degree": 6},
 "control": {"type": "variance", "step": 0.01, "tolerance_random": 1e-6, "tolerance_bias": 1e-6}})",
                    R"({"integrator": {"type": "taylor", "degree": 6},
 "control": {"type": "halve_double", "step": 0.01, "max_step": 0.1, "min_variance": 1e-16, "max_variance": 1e-10}})"},
       .proofs = {{"-1.320695160352823732570402",
                   "x of a planet of eccentricity 0.99 at t = 1000, in 75-digit arithmetic; degree 20 with "
                   "jorba_zou ends there to what an energy error of 1e-12 allows",
                   "Kepler.EndsAtThePublishedPositions", "integrators/long_runs_test.cpp"},
                  {"{0.99, 120}",
                   "at most 120 steps a period at that eccentricity, with no error but rounding",
                   "Kepler.TakesNoMoreStepsAndNoMoreErrorThanRoundingGives",
                   "integrators/long_runs_test.cpp"}}},

      {.name = "random_taylor",
       .what = "Taylor's method, stopped at a random degree with weights that keep it unbiased",
       .when = "An ensemble whose spread is wanted (`jetlag ensemble`); or many steps of a low degree on a "
               "long regular motion, with the draws of the `ruler`. Not for one smooth run to many digits: "
               "there `taylor` is cheaper.",
       .declared = {{"integrators/taylor.hpp", "RandomTaylor"},
                    {"truncation/truncation.hpp", "TruncationLaw"}},
       .keys = with(
           {{"integrator.law",
             "`geometric`, `poisson`, `tail`, `variance_capped`, `sequential`, `single_term`; the last two "
             "with the control `fixed` or `jorba_zou`, without courant",
             "geometric"},
            {"integrator.min_degree", "1 to 256, but for `tail` and `variance_capped`",
             "required with its laws"},
            {"integrator.max_degree", "min_degree to 256, with the same laws", "required with its laws"},
            {"integrator.probability",
             "with `geometric` and `single_term`: of stopping at a degree, 0 to 1, below 1 unless the "
             "degrees are equal",
             "0.5"},
            {"integrator.base", "in place of it: one in `base` goes on, whole number from 2 to 1000000",
             "none"},
            {"integrator.mean", "with `poisson`: of the degrees beyond min_degree, > 0",
             "required with poisson"},
            {"integrator.tail", "with `tail`: P(K >= n) for n = 0, 1, .., the first two 1, 2 to 257 numbers",
             "required with tail"},
            {"integrator.terms", "with `variance_capped`: sizes of the terms, 2 to 257 numbers",
             "required with variance_capped"},
            {"integrator.max_variance", "with `variance_capped`: of the sum of these terms, > 0",
             "required with variance_capped"},
            {"integrator.target", "with `sequential`: terms below it may be left out [m], > 0",
             "required with sequential"},
            {"integrator.least", "with `sequential`: the least probability of going on, > 0 and <= 1",
             "0.05"},
            {"integrator.draws",
             "`independent`, `rotation`, `ruler`, `scrambled_ruler`, `antithetic`; `stratified` with a draw "
             "for each particle",
             "independent"},
            {"integrator.shared_draw", "true: one draw for all particles; false: one for each", "true"},
            {"control.tolerance", "with `last_two`: [m], > 0", "required with last_two"}},
           series),
       .examples =
           {R"({"integrator": {"type": "random_taylor", "min_degree": 3, "max_degree": 4},
 "control": {"type": "fixed", "step": 0.01}})",
            R"({"integrator": {"type": "random_taylor", "min_degree": 5, "max_degree": 16, "base": 3, "draws": "ruler"},
 "control": {"type": "fixed", "step": 0.01}})",
            R"({"integrator": {"type": "random_taylor", "law": "poisson", "min_degree": 3, "max_degree": 12,
                "mean": 1.5},
 "control": {"type": "variance", "step": 0.01, "tolerance_random": 1e-6, "tolerance_bias": 1e-6}})",
            R"({"integrator": {"type": "random_taylor", "law": "tail", "tail": [1, 1, 1, 0.5, 0.2]},
 "control": {"type": "halve_double", "step": 0.01, "max_step": 0.1, "min_variance": 1e-16, "max_variance": 1e-10}})",
            R"({"integrator": {"type": "random_taylor", "law": "variance_capped", "terms": [1, 1, 0.5, 0.1, 0.01],
                "max_variance": 1e-4},
 "control": {"type": "last_two", "tolerance": 1e-9}})",
            R"({"integrator": {"type": "random_taylor", "law": "sequential", "min_degree": 3, "max_degree": 12,
                "target": 1e-9},
 "control": {"type": "jorba_zou"}})",
            R"({"integrator": {"type": "random_taylor", "law": "single_term", "min_degree": 3, "max_degree": 6,
                "shared_draw": false},
 "control": {"type": "fixed", "step": 0.01}})"},
       .proofs = {{"2.0838e-11",
                   "growth of the mean square of an oscillator in a step h omega = 0.1, degrees 3 to 6, p = "
                   "1/2, own_series",
                   "RandomTaylor.GrowsInMeanSquareAsPublished", "integrators/random_taylor_test.cpp"},
                  {"1.52952e-8", "the same with `derivative`", "RandomTaylor.GrowsInMeanSquareAsPublished",
                   "integrators/random_taylor_test.cpp"}}}};
}

}  // namespace jetlag
