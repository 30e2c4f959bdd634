// SPDX-License-Identifier: MIT
#include "jetlag/output/summary.hpp"

#include "output/json.hpp"

namespace jetlag {

namespace {

/// One particle a line.
std::string rows(const Coordinates<double>& values) {
  std::vector<std::string> rows;
  for (const auto& row : values.rowwise()) rows.push_back(json::list_of(row));
  return json::list(rows, 2);
}

std::string energies(const Summary& summary) {
  const auto measured = [&](double value) { return summary.has_energy ? json::value(value) : "null"; };
  return json::object({{"initial", measured(summary.initial_energy.total())},
                       {"final", measured(summary.final_energy.total())},
                       {"max_relative_error", measured(summary.max_relative_energy_error)}});
}

std::string all_of(const Work& work) {
  return json::object({{"updates", json::value(work.updates)},
                       {"steps", json::value(work.steps)},
                       {"coefficients", json::value(work.coefficients)},
                       {"element_coefficients", json::value(work.element_coefficients)},
                       {"mean_degree", json::value(work.mean_degree())},
                       {"rejected", json::value(work.rejected)},
                       {"wake_ups", json::value(work.wake_ups)}});
}

std::string all_of(const std::vector<Deformation>& solids) {
  json::Members members;
  for (const Deformation& of : solids)
    members.emplace_back(of.law, json::object({{"count", json::value(of.count)},
                                               {"volume", json::value(of.volume)},
                                               {"min_J", json::value(of.min_j)},
                                               {"min_J_element", json::list_of(of.min_j_element)},
                                               {"min_J_time", json::value(of.min_j_time)},
                                               {"max_stretch", json::value(of.max_stretch)},
                                               {"inverted", json::value(of.inverted)}}));
  return json::object(members);
}

std::string all_of(const std::optional<CourantFrequency>& frequency) {
  if (!frequency) return json::object({});
  return json::object(
      {{"bound", json::value(frequency->bound)}, {"refreshed", json::value(frequency->refreshed)}});
}

std::string all_of(const std::optional<ContactRecord>& contact) {
  if (!contact) return json::object({});
  const ContactRecord::Gap& smallest = contact->smallest_gap;
  return json::object({{"stencils_tested", json::value(contact->stencils_tested)},
                       {"crossings_tested", json::value(contact->crossings_tested)},
                       {"looks", json::value(contact->looks)},
                       {"active_largest", json::value(contact->active_largest)},
                       {"contacts", json::object({{"begun", json::value(contact->begun)},
                                                  {"ended", json::value(contact->ended)}})},
                       {"smallest_gap", json::object({{"value", json::value(smallest.value)},
                                                      {"time", json::value(smallest.time)},
                                                      {"particles", json::list_of(smallest.particles)}})}});
}

}  // namespace

std::string to_json(const Summary& summary) {
  json::Members members = {{"outcome", json::value(to_string(summary.outcome))}};
  if (summary.outcome != Outcome::success) members.emplace_back("message", json::value(summary.message));
  members.insert(members.end(),
                 {{"time", json::value(summary.time)},
                  {"position", rows(summary.position)},
                  {"velocity", rows(summary.velocity)},
                  {"energy", energies(summary)},
                  {"momentum", json::object({{"initial", json::list_of(summary.initial_momentum)},
                                             {"final", json::list_of(summary.final_momentum)}})},
                  {"work", all_of(summary.work)},
                  {"elements", all_of(summary.elements)},
                  {"frequency", all_of(summary.frequency)},
                  {"contact", all_of(summary.contact)},
                  {"wall_seconds", json::value(summary.wall_seconds)},
                  {"version", json::value(summary.version)},
                  {"seed", json::value(summary.seed)},
                  {"instruction_set", json::value(summary.instruction_set)},
                  {"threads", json::value(summary.threads)},
                  {"warnings", json::list_of(summary.warnings)}});
  return json::object(members, 0) + "\n";
}

}  // namespace jetlag
