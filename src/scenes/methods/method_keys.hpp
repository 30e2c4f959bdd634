// SPDX-License-Identifier: MIT
#pragma once
// Keys that several methods share, for their pages.

#include "scenes/methods/methods.hpp"

namespace jetlag::method_keys {

using Keys = std::vector<SceneKey>;

inline Keys with(Keys keys, const Keys& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

inline const SceneKey lockstep{"schedule.type", "`lockstep`", "lockstep"},
    max_steps{"schedule.max_steps", "the run ends after so many, whole number >= 1", "none"},
    threads{"schedule.threads", "for large scenes, 1 to 1024; the same bits for any number", "none: 1"},
    max_step{"control.max_step", "no step is longer [s], > 0", "none"},
    courant{"control.courant", "no step exceeds this fraction of the stability limit, > 0 and <= 1", "none"};

/// Of methods in lockstep that are not threaded.
inline const Keys one_thread{lockstep, max_steps, {"schedule.threads", "1", "none: 1"}};

inline const Keys fixed =
    with({{"control.type", "`fixed`", "required"}, {"control.step", "h [s], > 0", "required"}}, one_thread);

/// fixed, or steps of its own by `type`.
inline Keys fixed_or(const std::string& type, const SceneKey& accuracy) {
  return with({{"control.type", "`fixed`, `" + type + "`", "required"},
               {"control.step", "with `fixed`: h [s], > 0", "required with fixed"},
               accuracy,
               {"control.max_step", "with `" + type + "`: no step is longer [s], > 0", "none"}},
              one_thread);
}

inline const SceneKey tolerance{"control.tolerance",
                                "with `embedded`: error of a step relative to the largest component, > 0",
                                "required with embedded"};

inline const SceneKey velocity{"integrator.velocity", "`own_series`, `derivative` of that of the position",
                               "own_series"};

/// Of Taylor's methods in lockstep.
inline const Keys series{
    velocity,
    {"integrator.compensated", "true, false: sums of increments with their rests", "false"},
    {"control.type", "`fixed`, `jorba_zou`, `last_two`, `variance`, `halve_double`", "required"},
    {"control.step", "[s], > 0: with `fixed`, or the first one with `variance` and `halve_double`",
     "required with these"},
    max_step,
    {"control.tolerance_random", "with `variance`: random error of a position in one step [m], > 0",
     "required with variance"},
    {"control.tolerance_bias", "with `variance`: what is left out of it [m], > 0", "required with variance"},
    {"control.min_variance", "with `halve_double`: doubled below it [m^2], > 0",
     "required with halve_double"},
    {"control.max_variance", "with `halve_double`: halved above it [m^2], > 4^(m+1) min_variance",
     "required with halve_double"},
    courant,
    lockstep,
    max_steps,
    threads};

/// Of methods with clocks that push.
inline const Keys own_clocks{
    {"integrator.resonance", "`allowed`; `avoided`: steps are shortened until nothing resonates", "allowed"},
    {"control.type", "`fixed`", "fixed"},
    {"schedule.type", "`asynchronous`", "asynchronous"},
    max_steps};

/// Of quantized states.
inline const Keys quantized{
    {"control.type", "`quantum`", "quantum"},
    {"control.quantum", "of positions [m], > 0", "required"},
    {"control.velocity_quantum", "of velocities [m/s], > 0", "none: the number of control.quantum"},
    {"control.max_step",
     "each component acts at least so often [s], > 0; required by floors and by forces that depend on the "
     "time",
     "none"},
    {"schedule.type", "`asynchronous`", "asynchronous"},
    max_steps};

inline const SceneKey inner{
    "integrator.inner",
    "an integrator that draws nothing and takes fixed steps, such as `{\"type\": \"rk4\"}`", "required"};

/// Of schedules with a clock for each particle.
inline const Keys clocks{
    {"integrator.type",
     "`taylor` with a `degree` of 3 to 256; `random_taylor` with a law known beforehand, of a largest degree "
     ">= 3; with their keys, but without compensated sums",
     "required"},
    {"schedule.tolerance", "error of a step of a particle [m], > 0", "1e-9"},
    {"schedule.max_step", "no step is longer [s], > 0", "none"},
    max_steps,
    threads,
    {"control.type", "`fixed`, whose step is the longest, `last_two`, or no control", "none"},
    {"control.step", "with `fixed`: the longest step [s], > 0", "required with fixed"},
    {"control.tolerance", "with `last_two`: as schedule.tolerance, which precedes [m], > 0",
     "required with last_two"},
    max_step,
    {"control.courant", "no step exceeds this fraction of the limit of its particle, > 0 and <= 1", "none"}};

}  // namespace jetlag::method_keys
