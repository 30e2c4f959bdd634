// SPDX-License-Identifier: MIT
// integrator.law and integrator.draws: where the series of random_taylor stop.
#include <algorithm>
#include <numeric>

#include "jetlag/scenes/error.hpp"
#include "jetlag/truncation/poisson.hpp"
#include "jetlag/truncation/single_term.hpp"
#include "jetlag/truncation/variance_capped.hpp"
#include "scenes/choices.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

std::pair<int, int> read_degrees(const Value& integrator) {
  const auto m = static_cast<int>(integrator.at("min_degree").integer(1, largest_degree));
  return {m, static_cast<int>(integrator.at("max_degree").integer(m, largest_degree))};
}

/// 1 - p of a geometric law: of "base", one in base goes on; or of "probability", that of stopping.
TruncationLaw read_geometric_law(const Value& integrator) {
  const auto [m, n] = read_degrees(integrator);
  if (const auto base = integrator.find("base")) {
    if (integrator.has("probability")) base->refuse("left out where integrator.probability is given");
    const auto whole = static_cast<double>(base->integer(2, 1'000'000));
    return checked(*base, [&, m = m, n = n] {
      std::vector<double> tail(n + 1, 1.0);  // not by 1 - (1 - 1/base), which loses digits
      for (int k = m + 1; k <= n; ++k) tail[k] = tail[k - 1] / whole;
      return TruncationLaw("geometric", std::move(tail));
    });
  }
  const Value p = integrator.at("probability", 0.5);
  const double probability =
      p.number({0, 1, true, true, "a number from 0 to 1, below 1 unless max_degree = min_degree"});
  return checked(p, [&, m = m, n = n] { return geometric(m, n, probability); });
}

Truncation read_geometric(const Value& integrator) { return read_geometric_law(integrator); }

Truncation read_single_term(const Value& integrator) {
  return checked(integrator, [&] { return single_term(read_geometric_law(integrator)); });
}

Truncation read_poisson(const Value& integrator) {
  const auto [m, n] = read_degrees(integrator);
  const Value mean = integrator.at("mean");
  return checked(mean, [&, m = m, n = n] { return poisson(m, n, mean.number(positive)); });
}

std::vector<double> read_numbers(const Value& values, const Range& range, std::size_t least) {
  if (!values.is_array() || values.size() < least || values.size() > largest_degree + 1)
    values.refuse("an array of " + std::to_string(least) + " to " + std::to_string(largest_degree + 1) +
                  " numbers");
  return values.vector(values.size(), range);
}

Truncation read_tail(const Value& integrator) {
  const Value tail = integrator.at("tail");
  const auto values = read_numbers(tail, {0, 1, false, true, "a probability > 0 and <= 1"}, 2);
  return checked(tail, [&] {
    TruncationLaw law("tail", values);
    if (law.min_degree() < 1) throw std::invalid_argument("P(K >= 1) must be 1");
    return law;
  });
}

Truncation read_variance_capped(const Value& integrator) {
  const Value terms = integrator.at("terms"), cap = integrator.at("max_variance");
  const auto values = read_numbers(terms, any_number, 2);
  const double most = cap.number(positive);
  const TruncationLaw law = checked(terms, [&] { return variance_capped(values, most); });
  if (law.min_degree() < 1) cap.refuse("smaller: with these terms P(K >= 1) would be below 1");
  return law;
}

Truncation read_sequential(const Value& integrator) {
  const auto [m, n] = read_degrees(integrator);
  const Value target = integrator.at("target"), least = integrator.at("least", 0.05);
  const double size = target.number(positive),
               probability = least.number({0, 1, false, true, "a probability > 0 and <= 1"});
  return checked(least, [&, m = m, n = n] { return sequential(m, n, size, probability); });
}

const SceneKey min_degree{"min_degree", "1 to 256", "required"},
    max_degree{"max_degree", "min_degree to 256", "required"};
const SceneKeys of_geometric{
    min_degree,
    max_degree,
    {"probability", "of stopping at a degree, 0 to 1, below 1 unless the degrees are equal", "0.5"},
    {"base", "in place of it: one in `base` goes on, whole number from 2 to 1000000", "none"}};

}  // namespace

const std::vector<LawRecord>& law_records() {
  static const std::vector<LawRecord> records = {
      {"geometric", "Stops at each degree with the same probability", of_geometric, read_geometric},
      {"poisson",
       "Poisson's law beyond the least degree",
       {min_degree, max_degree, {"mean", "of the degrees beyond min_degree, > 0", "required"}},
       read_poisson},
      {"tail",
       "Any law, by its tail",
       {{"tail", "P(K >= n) for n = 0, 1, .., the first two 1, 2 to 257 numbers", "required"}},
       read_tail},
      {"variance_capped",
       "The law of least cost for terms of known sizes",
       {{"terms", "sizes of the terms, 2 to 257 numbers", "required"},
        {"max_variance", "of the sum of these terms, > 0", "required"}},
       read_variance_capped},
      {"sequential",
       "Goes on by the size of the terms",
       {min_degree,
        max_degree,
        {"target", "terms below it may be left out [m], > 0", "required"},
        {"least", "the least probability of going on, > 0 and <= 1", "0.05"}},
       read_sequential},
      {"single_term", "As geometric, but only the term where it stops is weighted", of_geometric,
       read_single_term}};
  return records;
}

SceneKeys truncation_keys() {
  std::vector<Choice> choices;
  for (const LawRecord& record : law_records()) choices.push_back({record.name, record.keys});
  return joined(
      {{choice("integrator.law", names_of(law_records()), "geometric",
               "; `sequential`, `single_term` with a control that reads no variance, without courant")},
       merged("integrator", choices),
       {{"integrator.draws", quoted_list(names_of_draws) + "; `stratified` with a draw for each particle",
         "independent"}}});
}

Truncation read_truncation(const Value& integrator) {
  return named(law_records(), integrator.at("law", "geometric").text()).read(integrator);
}

Draw read_draws(const Value& integrator, const Truncation& law, bool shared_draw, int particles) {
  const Value draws = integrator.at("draws", "independent");
  const auto found = std::ranges::find(names_of_draws, draws.one_of(names_of_draws));
  const auto kind = static_cast<Draw>(found - names_of_draws.begin());
  const auto* known = std::get_if<TruncationLaw>(&law);
  if (known == nullptr || !known->is_fixed())
    checked(draws,
            [&] { return Draws(kind, known, 1, shared_draw ? 1 : static_cast<std::uint32_t>(particles)); });
  return kind;
}

}  // namespace jetlag
