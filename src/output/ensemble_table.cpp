// SPDX-License-Identifier: MIT
// An ensemble as comma-separated values and as JSON.
#include "jetlag/output/ensemble_table.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "jetlag/output/files.hpp"

namespace jetlag {

namespace {

constexpr std::size_t most_failures = 10;  // that are listed

std::string field(double value) { return std::isfinite(value) ? number(value) : ""; }
std::string json(double value) { return std::isfinite(value) ? number(value) : "null"; }
std::string json(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}
std::string json_or_null(const std::string& text) { return text.empty() ? "null" : json(text); }

std::string object(const std::vector<std::pair<std::string, std::string>>& members,
                   const std::string& separator = " ") {
  std::string text;
  for (const auto& [key, value] : members)
    text += (text.empty() ? "" : "," + separator) + json(key) + ": " + value;
  return "{" + (separator == " " ? text : separator + text + separator.substr(0, separator.size() - 2)) + "}";
}

std::string list(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "\n    " : ",\n    ") + item;
  return text.empty() ? "[]" : "[" + text + "\n  ]";
}

/// a / b where both are positive numbers.
std::string ratio(double a, double b) { return a > 0 && b > 0 ? json(a / b) : "null"; }

std::vector<std::pair<std::string, std::string>> members_of(const Calibration& c, bool perturbed) {
  return {{"spread", json(c.spread)},
          {"member_error", json(c.member_error)},
          {"mean_error", json(c.mean_error)},
          {"deterministic_error", json(c.deterministic_error)},
          {"spread_over_member_error", ratio(c.spread, c.member_error)},
          {"spread_over_mean_error", ratio(c.spread, c.mean_error)},
          {"spread_over_deterministic_error", perturbed ? "null" : ratio(c.spread, c.deterministic_error)}};
}

std::string calibration(const EnsembleFrame& frame, bool perturbed) {
  auto members = members_of(frame.calibration, perturbed);
  members.insert(members.begin(), {{"time", json(frame.time)}, {"members", std::to_string(frame.members)}});
  return object(members);
}

std::string definitions(bool perturbed) {
  const std::string separator = "\n    ";
  return object(
      {{"over_time",
        json("root mean square over all frames but the first; calibration has the frames one by one")},
       {"spread",
        json(
            "sample standard deviation of the members, root mean square over all components of the positions "
            "of moving particles [m]")},
       {"member_error", json("member minus reference, root mean square over members and components [m]")},
       {"mean_error",
        json("mean of the members minus reference, root mean square over components [m]; for a linear motion "
             "without bias it is some spread / sqrt(members)")},
       {"deterministic_error",
        json(
            "run of a fixed degree with the same control minus reference, root mean square over components "
            "[m]: what an answer without randomness misses at the same cost of a step; deterministic has its "
            "degree and work")},
       {"orders_of_a_member",
        json("orders of the forces that a step of a member computes by itself, measured, on average: up to "
             "the degree drawn, or up to the largest where each particle draws, and up to what the control "
             "reads. The degree is that whose steps compute as many, rounded. Lanes compute somewhat more, "
             "up to "
             "the largest of their members: that is in work, not here")},
       {"spread_over_member_error",
        json("1: the members scatter about the truth; below 1: they share an error (a bias) that the spread "
             "does not show; it cannot exceed sqrt(members / (members - 1))")},
       {"spread_over_mean_error",
        json("how far the mean of the ensemble is better than a member; large: averaging pays")},
       {"spread_over_deterministic_error",
        json(perturbed
                 ? "null: the members start apart, so their spread is that of where they start, and no "
                   "error bar of a method"
                 : "whether the spread is a fair error bar of an ordinary run whose steps cost the same: "
                   "1: it is; above: too careful; below: too sure")},
       {"reference", json("the same scene from its initial state without perturbation, by Taylor's method of "
                          "degree 20 with jorba_zou: to rounding")}},
      separator);
}

}  // namespace

Calibration over_time(const EnsembleResult& result) {
  const auto root_mean_square = [&](double Calibration::* of) {
    double sum = 0, count = 0;
    for (std::size_t f = 1; f < result.frames.size(); ++f) {
      const double value = result.frames[f].calibration.*of;
      if (!std::isfinite(value)) continue;
      sum += value * value;
      ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : Calibration::not_known;
  };
  return {root_mean_square(&Calibration::spread), root_mean_square(&Calibration::member_error),
          root_mean_square(&Calibration::mean_error), root_mean_square(&Calibration::deterministic_error)};
}

std::string name_of(const Quantity& quantity) {
  if (quantity.particle < 0) return "energy";
  return (quantity.of_velocity ? "v" : "") + std::string(1, "xyz"[quantity.component]);
}

void write_ensemble_csv(const std::filesystem::path& path, const EnsembleResult& result) {
  std::string table = "time,particle,quantity,mean,spread,q05,q25,q50,q75,q95,mean_low,mean_high,reference\n";
  for (const EnsembleFrame& frame : result.frames)
    for (std::size_t q = 0; q < result.quantities.size(); ++q) {
      const Quantity& quantity = result.quantities[q];
      const Sample& sample = frame.samples[q];
      table += field(frame.time) + ',' + (quantity.particle < 0 ? "" : std::to_string(quantity.particle)) +
               ',' + name_of(quantity) + ',' + field(sample.mean) + ',' + field(sample.spread);
      for (const double quantile : sample.quantiles) table += ',' + field(quantile);
      table += ',' + field(sample.mean - sample.half_width) + ',' + field(sample.mean + sample.half_width) +
               ',' + field(frame.reference[q]) + '\n';
    }
  write_file(path, table);
}

std::string to_json(const EnsembleResult& result) {
  const bool perturbed = result.perturbation > 0;
  std::vector<std::string> frames, failures;
  for (const EnsembleFrame& frame : result.frames) frames.push_back(calibration(frame, perturbed));
  for (std::size_t i = 0; i < std::min(result.failures.size(), most_failures); ++i) {
    const auto& [member, time, report] = result.failures[i];
    failures.push_back(object({{"member", std::to_string(member)},
                               {"time", json(time)},
                               {"outcome", json(std::string(to_string(report.outcome)))},
                               {"message", json(report.message)}}));
  }
  const Work &work = result.work, &fixed = result.deterministic_work;
  const int run = result.deterministic_degree;
  const std::string works = object({{"updates", std::to_string(work.updates)},
                                    {"steps", std::to_string(work.steps)},
                                    {"coefficients", std::to_string(work.coefficients)},
                                    {"element_coefficients", std::to_string(work.element_coefficients)},
                                    {"mean_degree", json(work.mean_degree())},
                                    {"rejected", std::to_string(work.rejected)}});
  return object(
             {{"outcome", json(std::string(to_string(result.outcome)))},
              {"message", json_or_null(result.message)},
              {"time", json(result.frames.empty() ? 0.0 : result.frames.back().time)},
              {"members", std::to_string(result.members)},
              {"failed", std::to_string(result.failures.size())},
              {"failures", list(failures)},
              {"perturbation", json(result.perturbation)},
              {"work", works},
              {"wall_seconds", json(result.wall_seconds)},
              {"threads", std::to_string(result.threads)},
              {"layout", json(std::string(result.in_lanes ? "lanes" : "one by one"))},
              {"instruction_set", json(result.instruction_set)},
              {"seed", std::to_string(result.seed)},
              {"version", json(result.version)},
              {"reference", object({{"method", json(std::string("taylor, degree 20, jorba_zou"))},
                                    {"message", json_or_null(result.reference_message)}})},
              {"deterministic", object({{"degree", run > 0 ? std::to_string(run) : "null"},
                                        {"orders_of_a_member", json(result.mean_orders)},
                                        {"steps", std::to_string(fixed.steps)},
                                        {"element_coefficients", std::to_string(fixed.element_coefficients)},
                                        {"message", json_or_null(result.deterministic_message)}})},
              {"definitions", definitions(perturbed)},
              {"over_time", object(members_of(over_time(result), perturbed))},
              {"calibration", list(frames)}},
             "\n  ") +
         "\n";
}

}  // namespace jetlag
