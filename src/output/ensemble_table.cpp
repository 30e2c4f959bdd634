// SPDX-License-Identifier: MIT
// An ensemble as comma-separated values and as JSON.
#include "jetlag/output/ensemble_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "jetlag/base/text.hpp"
#include "output/json.hpp"

namespace jetlag {

namespace {

constexpr std::size_t most_failures = 10;  // that are listed

std::string text_or_null(const std::string& text) { return text.empty() ? "null" : json::value(text); }

/// a / b where both are positive numbers.
std::string ratio(double a, double b) { return a > 0 && b > 0 ? json::value(a / b) : "null"; }

json::Members members_of(const Calibration& c, bool perturbed) {
  return {{"spread", json::value(c.spread)},
          {"member_error", json::value(c.member_error)},
          {"mean_error", json::value(c.mean_error)},
          {"deterministic_error", json::value(c.deterministic_error)},
          {"spread_over_member_error", ratio(c.spread, c.member_error)},
          {"spread_over_mean_error", ratio(c.spread, c.mean_error)},
          {"spread_over_deterministic_error", perturbed ? "null" : ratio(c.spread, c.deterministic_error)}};
}

std::string calibration(const EnsembleFrame& frame, bool perturbed) {
  auto members = members_of(frame.calibration, perturbed);
  members.insert(members.begin(),
                 {{"time", json::value(frame.time)}, {"members", json::value(frame.members)}});
  return json::object(members);
}

std::string definitions(bool perturbed) {
  return json::object(
      {{"over_time",
        json::value("root mean square over all frames but the first; calibration has the frames one by one")},
       {"spread",
        json::value(
            "sample standard deviation of the members, root mean square over all components of the positions "
            "of moving particles [m]")},
       {"member_error",
        json::value("member minus reference, root mean square over members and components [m]")},
       {"mean_error",
        json::value(
            "mean of the members minus reference, root mean square over components [m]; for a linear motion "
            "without bias it is some spread / sqrt(members)")},
       {"deterministic_error",
        json::value(
            "run of a fixed degree with the same control minus reference, root mean square over components "
            "[m]: what an answer without randomness misses at the same cost of a step; deterministic has its "
            "degree and work")},
       {"orders_of_a_member",
        json::value(
            "orders of the forces that a step of a member computes by itself, measured, on average: up to "
            "the degree drawn, or up to the largest where each particle draws, and up to what the control "
            "reads. The degree is that whose steps compute as many, rounded. Lanes compute somewhat more, "
            "up to "
            "the largest of their members: that is in work, not here")},
       {"spread_over_member_error",
        json::value(
            "1: the members scatter about the truth; below 1: they share an error (a bias) that the spread "
            "does not show; it cannot exceed sqrt(members / (members - 1))")},
       {"spread_over_mean_error",
        json::value("how far the mean of the ensemble is better than a member; large: averaging pays")},
       {"spread_over_deterministic_error",
        json::value(
            perturbed
                ? "null: the members start apart, so their spread is that of where they start, and no "
                  "error bar of a method"
                : "whether the spread is a fair error bar of an ordinary run whose steps cost the same: "
                  "1: it is; above: too careful; below: too sure")},
       {"reference",
        json::value("the same scene from its initial state without perturbation, by Taylor's method of "
                    "degree 20 with jorba_zou: to rounding")}},
      2);
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

void write_ensemble_csv(const std::filesystem::path& path, const EnsembleResult& result, Until until) {
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
  write_file(path, table, until);
}

std::string to_json(const EnsembleResult& result) {
  const bool perturbed = result.perturbation > 0;
  std::vector<std::string> frames, failures;
  for (const EnsembleFrame& frame : result.frames) frames.push_back(calibration(frame, perturbed));
  for (std::size_t i = 0; i < std::min(result.failures.size(), most_failures); ++i) {
    const auto& [member, time, report] = result.failures[i];
    failures.push_back(json::object({{"member", json::value(member)},
                                     {"time", json::value(time)},
                                     {"outcome", json::value(to_string(report.outcome))},
                                     {"message", json::value(report.message)}}));
  }
  const Work &work = result.work, &fixed = result.deterministic_work;
  const int run = result.deterministic_degree;
  const std::string works = json::object({{"updates", json::value(work.updates)},
                                          {"steps", json::value(work.steps)},
                                          {"coefficients", json::value(work.coefficients)},
                                          {"element_coefficients", json::value(work.element_coefficients)},
                                          {"mean_degree", json::value(work.mean_degree())},
                                          {"rejected", json::value(work.rejected)}});
  return json::object({{"outcome", json::value(to_string(result.outcome))},
                       {"message", text_or_null(result.message)},
                       {"time", json::value(result.frames.empty() ? 0.0 : result.frames.back().time)},
                       {"members", json::value(result.members)},
                       {"failed", json::value(result.failures.size())},
                       {"failures", json::list(failures, 2)},
                       {"perturbation", json::value(result.perturbation)},
                       {"work", works},
                       {"wall_seconds", json::value(result.wall_seconds)},
                       {"threads", json::value(result.threads)},
                       {"layout", json::value(result.in_lanes ? "lanes" : "one by one")},
                       {"instruction_set", json::value(result.instruction_set)},
                       {"seed", json::value(result.seed)},
                       {"version", json::value(result.version)},
                       {"reference", json::object({{"method", json::value("taylor, degree 20, jorba_zou")},
                                                   {"message", text_or_null(result.reference_message)}})},
                       {"deterministic",
                        json::object({{"degree", run > 0 ? json::value(run) : "null"},
                                      {"orders_of_a_member", json::value(result.mean_orders)},
                                      {"steps", json::value(fixed.steps)},
                                      {"element_coefficients", json::value(fixed.element_coefficients)},
                                      {"message", text_or_null(result.deterministic_message)},
                                      {"warning", text_or_null(result.warning)}})},
                       {"definitions", definitions(perturbed)},
                       {"over_time", json::object(members_of(over_time(result), perturbed))},
                       {"calibration", json::list(frames, 2)}},
                      0) +
         "\n";
}

}  // namespace jetlag
