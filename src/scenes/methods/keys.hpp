// SPDX-License-Identifier: MIT
#pragma once
// Keys that several methods share.

#include "scenes/keys.hpp"

namespace jetlag::method_keys {

inline const SceneKey max_steps{"schedule.max_steps", "the run ends after so many, whole number >= 1",
                                "none"},
    threads{"schedule.threads", "for large scenes, 1 to 1024; the same bits for any number", "none: 1"},
    courant{"control.courant", "no step exceeds this fraction of the stability limit, > 0 and <= 1", "none"},
    courant_refresh{
        "control.courant_refresh",
        "where a force has no stiffness, the limit is that of a state: it is found anew after so many steps, "
        "whole number >= 1",
        "50"},
    max_step{"control.max_step", "no step is longer [s], > 0", "none"};

/// Of methods in lockstep.
inline const SceneKeys many_threads{{"schedule.type", "`lockstep`", "lockstep"}, max_steps, threads},
    one_thread{{"schedule.type", "`lockstep`", "lockstep"}, max_steps, {"schedule.threads", "1", "none: 1"}};

inline SceneKeys fixed_step(const std::string& what) {
  return joined(
      {{choice("control.type", {"fixed"}, "required"), {"control.step", what, "required"}}, one_thread});
}
inline const SceneKeys fixed = fixed_step("h [s], > 0");

/// fixed, or steps of its own by `type`.
inline SceneKeys fixed_or(const std::string& type, const SceneKey& accuracy) {
  return joined({{choice("control.type", {"fixed", type}, "required"),
                  under({"fixed"}, {"control.step", "h [s], > 0", "required"}), under({type}, accuracy),
                  under({type}, max_step)},
                 one_thread});
}

inline const SceneKey tolerance{"control.tolerance", "error of a step relative to the largest component, > 0",
                                "required"};

/// Of methods with clocks that push.
inline const SceneKeys own_clocks{
    {"integrator.resonance", "`allowed`; `avoided`: steps are shortened until nothing resonates", "allowed"},
    choice("control.type", {"fixed"}, "fixed"),
    {"schedule.type", "`asynchronous`", "asynchronous"},
    max_steps};

inline const SceneKey inner{
    "integrator.inner",
    "an integrator that draws nothing and takes fixed steps, such as `{\"type\": \"rk4\"}`", "required"};

}  // namespace jetlag::method_keys
