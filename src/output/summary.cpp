// SPDX-License-Identifier: MIT
// The summary of a run as JSON. Strings and layout of values are nlohmann's; numbers are ours, because its
// own are not always the shortest, and "-0" would lose its sign.
#include "jetlag/output/summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "jetlag/output/files.hpp"

namespace jetlag {

namespace {

using Members = std::vector<std::pair<std::string, std::string>>;

std::string json(double value) {
  if (!std::isfinite(value)) return "null";
  const std::string text = number(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}
std::string json(std::uint64_t value) { return std::to_string(value); }
std::string json(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <class Values>
std::string list(const Values& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + json(value);
  return "[" + text + "]";
}

std::string json(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + json(text);
  return "[" + list + "]";
}

/// One particle a line.
std::string json(const Coordinates<double>& values) {
  std::string text;
  for (const auto& row : values.rowwise()) text += (text.empty() ? "\n    " : ",\n    ") + list(row);
  return text.empty() ? "[]" : "[" + text + "\n  ]";
}

std::string object(const Members& members, const std::string& separator) {
  std::string text;
  for (const auto& [key, value] : members)
    text += (text.empty() ? "" : "," + separator) + json(key) + ": " + value;
  return text;
}
std::string object(const Members& members) { return "{" + object(members, " ") + "}"; }

std::string energy(const Summary& summary) {
  const auto measured = [&](double value) { return summary.has_energy ? json(value) : "null"; };
  return object({{"initial", measured(summary.initial_energy.total())},
                 {"final", measured(summary.final_energy.total())},
                 {"max_relative_error", measured(summary.max_relative_energy_error)}});
}

std::string json(const Work& work) {
  return object({{"updates", json(work.updates)},
                 {"steps", json(work.steps)},
                 {"coefficients", json(work.coefficients)},
                 {"element_coefficients", json(work.element_coefficients)},
                 {"mean_degree", json(work.mean_degree())},
                 {"rejected", json(work.rejected)},
                 {"wake_ups", json(work.wake_ups)}});
}

}  // namespace

std::string to_json(const Summary& summary) {
  Members members = {{"outcome", json(std::string(to_string(summary.outcome)))}};
  if (summary.outcome != Outcome::success) members.emplace_back("message", json(summary.message));
  members.insert(members.end(), {{"time", json(summary.time)},
                                 {"position", json(summary.position)},
                                 {"velocity", json(summary.velocity)},
                                 {"energy", energy(summary)},
                                 {"momentum", object({{"initial", list(summary.initial_momentum)},
                                                      {"final", list(summary.final_momentum)}})},
                                 {"work", json(summary.work)},
                                 {"wall_seconds", json(summary.wall_seconds)},
                                 {"version", json(summary.version)},
                                 {"seed", json(summary.seed)},
                                 {"instruction_set", json(summary.instruction_set)},
                                 {"threads", std::to_string(summary.threads)},
                                 {"warnings", json(summary.warnings)}});
  return "{\n  " + object(members, "\n  ") + "\n}\n";
}

}  // namespace jetlag
