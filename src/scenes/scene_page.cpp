// SPDX-License-Identifier: MIT
#include "scenes/scene_page.hpp"

#include "jetlag/output/output_options.hpp"
#include "scenes/choices.hpp"

namespace jetlag {

namespace {

constexpr const char* top = R"(# A scene file

A scene is a JSON object; `jetlag show two_body` prints one to begin with, `jetlag check FILE` says whether one is valid
and what it would cost. `-` in place of a file is standard input, and pipes are read too. Whole numbers may have a point
(`2.0`). A number stands for "the same for all" where there is one for each. Units are SI; lengths are in
[m]. What is wrong with a scene is said with its key, its value and what is allowed, and nothing is written then.

)";

constexpr const char* below = R"(## What a run leaves

In the folder of `--out`: `scene.json`, the complete scene with all defaults, so that the run can be repeated;
`summary.json`; by `output` also `energy.csv`, `clocks.csv`, pictures, and frames for ParaView. What an earlier run or
ensemble left there under such names goes first. Whatever happens to the process, what is under a name is whole and of one
run: the list of frames and the tables grow with the run (of more than 256 frames they are up to 3 % behind), `summary.json`
and the pictures come last; hidden drafts (`.jetlag-..`) of a run that was killed go at the next one there. A second run
into the folder is refused as long as the first goes on.

Exit codes: 0, also where a warning was printed; 1 for a folder or file that cannot be written (no rights, a full disk,
another run that writes there), which is named with the reason; 2 for a scene or an argument that is wrong; 3 for a run that cannot reach its end: it says
when, which particle and what to do, and leaves the last good state. Ctrl-C, SIGTERM and SIGHUP (a terminal that is closed)
end a run in good order, with the outputs up to there.

Frames have of each particle `velocity` and `fixed`, with `output.clocks` `step` and `degree`, and where there are contacts
`gap`, its smallest one [m] (-1 where nothing is within the thickness), and `contact_force` [N], on the vertices of obstacles too.

`summary.json` holds

| key | what |
|---|---|
| `outcome` | `success`; `non_finite`: a number is none, or beyond 1e150, where squares overflow; `step_underflow`; `step_limit`; `not_converged`; `event`; `contradicted`: the forces are not those that a step on clocks had foreseen, and it cannot be taken again; `interrupted` |
| `message` | for all but `success`: when, which particle, what to do |
| `time`, `position`, `velocity` | the last good state [s], [m], [m/s], a row for each particle |
| `energy` | `initial`, `final` [J] and `max_relative_error`; null without `output.energy` |
| `momentum` | `initial`, `final` [kg m/s] |
| `work` | `updates` of particles, `steps`, `coefficients` of particles, `element_coefficients` (of forces, what costs), `mean_degree`, `rejected` steps, `wake_ups` of particles; a step is rejected and halved where the forces at its end are not those that its series foresaw |
| `elements` | of each type of solid: `count`; `volume` at rest [m^3]; `min_J`, the least volume of an element as part of that at rest, with `min_J_element` (its particles) and `min_J_time` [s]; `max_stretch`; `inverted`, the most elements that were inside out at once; all at the frames |
| `frequency` | of a `courant` limit of Taylor's methods: `bound`, of the fastest frequency [rad/s], of solids in the last state for which it was taken; `refreshed`, how often it was taken anew; empty where there is none |
| `contact` | `stencils_tested`, pairs of features (vertices, edges, triangles) that were looked at in all steps; `crossings_tested`, those of them whose motion was searched; `looks` at the whole surface; `active_largest`, the most pairs within the thickness at once; `contacts`, how many pairs came within it, `begun`, and left it, `ended`; `smallest_gap`: its `value` [m], `time` [s] and the `particles` of the pair, to some thousandths, null where nothing came near; empty without a force of contact |
| `wall_seconds`, `version`, `seed`, `instruction_set`, `threads` | of this run |
| `warnings` | a list of texts, empty when there are none; one is that of a scene whose forces conserve the energy and whose energy changed by more than a tenth: the step is too long or the method unstable; another one is that of steps of a given length at whose ends the forces contradict the series, with the time and the particle: positions may be off by more than a thousandth of their extent |

Numbers have all their digits: they read back to the same bits.

## Ensembles

`jetlag ensemble SCENE --members 1000 [--threads T] [--watch 17.y] [--perturb SIGMA] [--velocities]` runs a scene with
random degrees many times at once. Member i has its own seed, made from the scene's and i; it is the same in any company
and for any number of threads. Frames are read off the polynomials of the steps, as in a run. `--perturb` adds normal
numbers of that deviation [m] to the initial positions; then `taylor` will do too. `out/SCENE_ensemble` then holds, besides
`scene.json`:

| file | holds |
|---|---|
| `ensemble.csv` | one row for each frame and quantity (`x`, `y`, `z` of a moving particle, with `--velocities` `vx` .., and `energy`): `time`, `particle`, `quantity`, `mean`, `spread` (sample standard deviation), the quantiles `q05`, `q25`, `q50`, `q75`, `q95`, `mean_low` and `mean_high` (95 % interval of the mean by Student's distribution), `reference` |
| `ensemble.json` | members, failures, work, seconds; `calibration` frame by frame and `over_time`, with `definitions` |
| `ensemble.svg` | the band of one coordinate about its median and the reference; below, spread and true errors |

The reference is the same scene by Taylor's method of degree 20 with `jorba_zou`. Is the spread a fair error bar? All are
root mean squares over the positions of moving particles:

- `spread_over_member_error`: 1 where the members scatter about the truth; less where they share a bias that the spread
  does not show. It can hardly exceed 1, so it says no more than that.
- `spread_over_mean_error`: how far the mean of the ensemble is better than a member.
- `spread_over_deterministic_error`: the spread over the true error of a run of a fixed degree whose steps cost the same.
  The honest question: 1 where the spread is what an ordinary run misses, above it is too careful, below too sure. The
  cost is measured: the orders that the steps of the members have computed, each by itself, on average, rounded. Where
  each particle draws that is up to the largest degree drawn: `ellipse` pays for degree 6, not for its mean degree 3.9,
  and degree 6 misses 2.4e-8 m where the members spread by 6.4e-6 m (20 members, `until=0.5`): a ratio of 262, not of 1.5
  as beside degree 4. `null` with `--perturb`: there the spread is that of where the members start.

A member that fails is left out from then on and counted; where all fail the exit code is 3.
)";

template <class Records>
std::string sections(const Records& records) {
  std::string text;
  for (const auto& record : records)
    text += "### `" + record.name + "`\n\n" + record.what + ".\n\n" + markdown_table(record.keys) + "\n";
  return text;
}

}  // namespace

const SceneKeys& scene_keys() {
  static const SceneKeys keys = [] {
    const OutputOptions unasked;
    SceneKeys keys = {
        {"name", "text", "scene"},
        {"dimension", "1, 2, 3", "3"},
        {"particles", "an object, see below", "required"},
        {"forces", "a list of objects, see below", "none"},
        {"obstacles", "a list of objects, see below", "none"},
        {"integrator", "an object with the `type` of a method, see the page of each", "required"},
        {"control", "an object with a `type`, see below and the page of the method",
         "required by most methods"},
        {"schedule", "an object with a `type`, see the page of the method", "none: that of the method"},
        {"until", "the end [s], > 0", "required"},
        {"seed", "of all that is random, whole number from 0 to 2^64 - 1", "1"},
        {"output", "an object", "none"},
        {"output.frames",
         "besides the first, evenly spaced in time, 0 to 1000000; 0: none are written, and energies and "
         "pictures are of the beginning and the end",
         "100"}};
    for (const auto& [name, asked, what] : output_keys)
      keys.push_back({"output." + std::string(name), "true, false: " + std::string(what),
                      unasked.*asked ? "true" : "false"});
    return keys;
  }();
  return keys;
}

std::string scene_page() {
  return top + markdown_table(scene_keys()) +
         "\n## Particles\n\nListed, or made by a generator, named by its key.\n\n" +
         markdown_table(merged("particles", particle_choices())) +
         "\nA mesh has edges, faces and tetrahedra; springs may lie along its edges.\n\n## Obstacles\n\n"
         "What contacts may touch and nothing moves: particles that are fixed, after those of `particles` in "
         "the "
         "summary and in frames. Forces that act on all particles or all pairs leave them out.\n\n" +
         markdown_table(merged("obstacles[]", obstacle_choices())) + "\n## Forces\n\n" +
         sections(force_records()) +
         "## Controls of Taylor's methods\n\nHow far a step goes. Each takes `courant` too: a fraction of "
         "the stability limit of springs and solids, > 0 and <= 1, that no step exceeds; of solids it is "
         "that of their state, "
         "found anew every `courant_refresh` steps. Drag and viscosity count. With viscosity the limit is "
         "one for "
         "modes that are damped as much as any and as little as the least, so that it may be half of what a "
         "body "
         "allows whose damping_time is one for all, and a degree that needs damping (2, 5, 6, 9, 10, ..) "
         "still "
         "needs a drag on all particles; `velocity` must be `own_series`.\n\n" +
         sections(control_records()) +
         "## Laws of random degrees\n\n`integrator.law` of `random_taylor`: where a series stops.\n\n" +
         sections(law_records()) + below;
}

}  // namespace jetlag
