// SPDX-License-Identifier: MIT
#include "runs/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "jetlag/base/text.hpp"
#include "jetlag/model/finite.hpp"
#include "jetlag/output/files.hpp"

namespace jetlag {

namespace {

/// What is wrong with a state whose numbers are finite but not what is made of them; success where nothing is.
Report usable(const System<double>& system, const State<double>& state, const EnergyRow* row) {
  Report report;
  if (!in_range(state, largest_number, state.time, report)) {
    report.message = "the motion has blown up: at t = " + number(state.time) + " a number of particle " +
                     std::to_string(report.particle) + " is beyond " + number(largest_number) +
                     ", where squares overflow; take a shorter step or a smaller tolerance";
    return report;
  }
  const bool finite = !row || (std::isfinite(row->energy.total()) && std::isfinite(row->relative_error));
  if (finite && momentum(system, state).allFinite()) return {};
  int fastest = 0;
  state.velocity.rowwise().squaredNorm().maxCoeff(&fastest);
  return {Outcome::non_finite,
          std::string("the ") + (finite ? "momentum" : "energy") + " at t = " + number(state.time) +
              " is not finite, and particle " + std::to_string(fastest) +
              " is the fastest: particles coincide, or the motion has blown up; take a shorter step or a "
              "smaller tolerance",
          fastest};
}

/// Whether all forces have potentials, and depend on positions only.
bool conserves_energy(const System<double>& system) {
  const auto is_of_position = [](const Node& node) {
    const bool other = node.input.kind == Input::Kind::velocity || node.input.kind == Input::Kind::time;
    return node.kind != Node::Kind::input || !other;
  };
  return std::ranges::all_of(system.elements(), [&](const Elements<double>& group) {
    return group.count() == 0 ||
           (group.law.energy && std::ranges::all_of(group.law.force.nodes, is_of_position));
  });
}

}  // namespace

Recorder::Recorder(const Scene& scene, const RunHooks& hooks, RunResult& result)
    : scene_(scene), hooks_(hooks), result_(result), last_(scene.initial) {
  if (scene.output.energy) meter_.emplace(*scene.system);
  if (!scene.solids.empty()) deformation_.emplace(scene.solids, scene.rest);
  if (!scene.contacts.empty() && hooks.frame) contact_.emplace(*scene.system);
  record(scene.initial);
}

std::vector<double> Recorder::times() const {
  const int frames = scene_.output.frames;
  std::vector<double> times;
  for (int frame = 1; frame < frames; ++frame) times.push_back(scene_.until * frame / frames);
  times.push_back(scene_.until);
  return times;
}

void Recorder::record(const State<double>& state) {
  if (failure_.outcome != Outcome::success) return;
  EnergyRow row{state.time, {}, 0.0};
  if (meter_) row = measured(state);
  failure_ = usable(*scene_.system, state, meter_ ? &row : nullptr);
  if (failure_.outcome != Outcome::success) return;
  last_ = state;
  if (meter_) keep(row);
  if (deformation_) deformation_->take(state.time, state.position);
  if (!hooks_.frame) return;
  Frame frame{state.time, state.position, state.velocity};
  if (result_.clocks) {
    frame.step = result_.clocks->step();
    frame.degree = result_.clocks->degree();
  }
  if (contact_) {
    contact_->measure(state);
    frame.gap = contact_->gap();
    frame.contact_force = contact_->force();
  }
  hooks_.frame(frame);
}

EnergyRow Recorder::measured(const State<double>& state) {
  const Energy energy = (*meter_)(state);
  const double initial = result_.energies.empty() ? energy.total() : result_.summary.initial_energy.total();
  const double scale = initial != 0 ? std::abs(initial) : std::max(largest_kinetic_, energy.kinetic);
  return {state.time, energy, scale > 0 ? (energy.total() - initial) / scale : 0.0};
}

void Recorder::keep(const EnergyRow& row) {
  Summary& summary = result_.summary;
  if (result_.energies.empty()) summary.initial_energy = row.energy;
  largest_change_ = std::max(largest_change_, std::abs(row.energy.total() - summary.initial_energy.total()));
  largest_kinetic_ = std::max(largest_kinetic_, row.energy.kinetic);
  result_.energies.push_back(row);
  summary.max_relative_energy_error =
      std::max(summary.max_relative_energy_error, std::abs(row.relative_error));
}

/// An initial energy that is small because its parts cancel is no measure: the change must be seen beside the kinetic
/// energy too.
void Recorder::judge_energy() const {
  Summary& summary = result_.summary;
  if (summary.max_relative_energy_error <= 0.1 || largest_change_ <= 1e-3 * largest_kinetic_) return;
  if (!conserves_energy(*scene_.system)) return;
  std::ostringstream text;
  text.precision(3);
  text << "energy is conserved by this scene but changed by " << summary.max_relative_energy_error
       << " times what it was: the step is too long or the method unstable; take a smaller step or "
          "tolerance";
  summary.warnings.push_back(text.str());
}

void Recorder::judge_deformation() const {
  if (!deformation_) return;
  Summary& summary = result_.summary;
  summary.elements = deformation_->found();
  for (const Deformation& of : summary.elements)
    if (of.inverted > 0)
      summary.warnings.push_back(
          of.law + ": up to " + std::to_string(of.inverted) + " of " + std::to_string(of.count) +
          " elements were inside out at once, the worst at t = " + number(of.min_j_time) + " s");
}

void Recorder::judge() const {
  judge_energy();
  judge_deformation();
}

}  // namespace jetlag
