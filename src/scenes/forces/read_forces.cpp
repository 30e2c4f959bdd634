// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "jetlag/forces/forces.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/choices.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

using Pairs = std::vector<std::array<int, 2>>;
using Components = std::vector<double>;  // shape (dimension)
constexpr std::size_t max_pairs = 50'000'000;

/// "pairs": a list of pairs, "edges" of the mesh, or "all". Listed pairs must be of two different particles.
Pairs read_pairs(const Value& value, const Particles& particles) {
  const std::size_t count = particles.own;
  Pairs pairs;
  if (value.is_string()) {
    const bool all = value.one_of({"edges", "all"}) == "all";
    if (!all && particles.mesh.edges.empty())
      value.refuse("a list of pairs or \"all\": these particles have no mesh");
    if (all) {
      if (count * (count - 1) / 2 > max_pairs)
        value.refuse("at most " + std::to_string(max_pairs) + " pairs");
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = a + 1; b < count; ++b)
          pairs.push_back({static_cast<int>(a), static_cast<int>(b)});
    } else {
      pairs = particles.mesh.edges;
    }
  } else {
    if (!value.is_array()) value.refuse("a list of pairs of particles, \"edges\" or \"all\"");
    for (std::size_t e = 0; e < value.size(); ++e)
      pairs.push_back(read_members<2>(value.at(e), particles.state.position.rows()));
  }
  return pairs;
}

/// Refuses element e where its particles lie in the same place. law, else: what has no direction there, and what has.
void require_apart(const Value& value, const Particles& particles, const Pairs& pairs, std::size_t e,
                   const char* law, const char* otherwise) {
  const auto [a, b] = pairs[e];
  if (particles.state.position.row(a) != particles.state.position.row(b)) return;
  const std::string who = std::to_string(a) + " and " + std::to_string(b);
  throw SceneError(value.path() + (value.is_string() ? "" : "[" + std::to_string(e) + "]") + ": particles " +
                   who + " lie in the same place, where the force of a " + law +
                   " has no direction; must be apart, or " + otherwise);
}

/// Elements in one order, however the scene lists them: by particles, then by parameters.
template <std::size_t P>
void sort_elements(Pairs& pairs, std::vector<std::array<double, P>>& parameters) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (auto& pair : pairs) std::ranges::sort(pair);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return std::tie(pairs[a], parameters[a]) < std::tie(pairs[b], parameters[b]);
  });
  Pairs sorted_pairs;
  std::vector<std::array<double, P>> sorted_parameters;
  for (const std::size_t e : order) {
    sorted_pairs.push_back(pairs[e]);
    sorted_parameters.push_back(parameters[e]);
  }
  pairs = std::move(sorted_pairs);
  parameters = std::move(sorted_parameters);
}

/// The particles that are not fixed, as elements of one participant.
std::vector<std::array<int, 1>> moving(const Particles& particles) {
  std::vector<std::array<int, 1>> all;
  for (std::size_t i = 0; i < particles.fixed.size(); ++i)
    if (!particles.fixed[i]) all.push_back({static_cast<int>(i)});
  return all;
}

/// Springs of length 0 are elements of a law of their own: the others pay nothing for it.
void read_spring(const Value& force, ForcesRead& into) {
  const Particles& particles = into.particles;
  const Value listed = force.at("pairs", "edges");
  const Pairs pairs = read_pairs(listed, particles);
  const auto stiffness = force.at("stiffness").numbers(pairs.size(), non_negative, "spring");
  const Value rest = force.at("rest_length", "initial");
  const bool initial = rest.is_string();
  std::vector<double> length;
  if (initial) {
    rest.one_of({"initial"});
    for (const auto& [a, b] : pairs)
      length.push_back((particles.state.position.row(a) - particles.state.position.row(b)).norm());
  } else {
    length = rest.numbers(pairs.size(), non_negative, "spring");
  }
  Pairs of_some_length, of_none;
  std::vector<std::array<double, 2>> parameters;
  std::vector<std::array<double, 1>> stiffness_of_none;
  for (std::size_t e = 0; e < pairs.size(); ++e) {
    if (initial || length[e] != 0)
      require_apart(listed, particles, pairs, e, "spring", "their spring of rest_length 0");
    if (length[e] != 0) {
      of_some_length.push_back(pairs[e]);
      parameters.push_back({stiffness[e], length[e]});
    } else {
      of_none.push_back(pairs[e]);
      stiffness_of_none.push_back({stiffness[e]});
    }
  }
  sort_elements(of_some_length, parameters);
  sort_elements(of_none, stiffness_of_none);
  if (!of_some_length.empty() || of_none.empty()) into.system.add<Spring>(of_some_length, parameters);
  if (!of_none.empty()) into.system.add<ZeroLengthSpring>(of_none, stiffness_of_none);
  for (const Pairs* drawn : {&of_some_length, &of_none})
    into.drawn.lines.insert(into.drawn.lines.end(), drawn->begin(), drawn->end());
}

void read_gravity(const Value& force, ForcesRead& into) {
  const Particles& particles = into.particles;
  const Value listed = force.at("pairs", "all");
  Pairs pairs = read_pairs(listed, particles);
  const double constant = force.at("constant", 1.0).number();
  const Value soft = force.at("softening", 0.0);
  const double softening = soft.number(non_negative);
  if (softening != 0 && !(1e-100 <= softening && softening <= 1e150))
    soft.refuse("0, or from 1e-100 to 1e150, so that its powers are numbers");
  if (softening != 0) {
    std::vector<std::array<double, 2>> parameters(pairs.size(), {constant, softening});
    sort_elements(pairs, parameters);
    into.system.add<SoftenedGravity>(pairs, parameters);
    return;
  }
  for (std::size_t e = 0; e < pairs.size(); ++e)
    require_apart(listed, particles, pairs, e, "gravity", "its softening > 0");
  std::vector<std::array<double, 1>> parameters(pairs.size(), {constant});
  sort_elements(pairs, parameters);
  into.system.add<Gravity>(pairs, parameters);
}

/// "coefficient" [kg/s], or "rate" [1/s] times the mass.
void read_drag(const Value& force, ForcesRead& into) {
  const std::vector<double> mass(
      into.particles.mass.begin(),
      into.particles.mass.begin() + static_cast<std::ptrdiff_t>(into.particles.own));
  const auto rate = force.find("rate");
  if (rate && force.has("coefficient")) rate->refuse("left out beside coefficient, or coefficient beside it");
  auto coefficient = (rate ? *rate : force.at("coefficient")).numbers(mass.size(), non_negative, "particle");
  if (rate)
    for (std::size_t i = 0; i < mass.size(); ++i) coefficient[i] *= mass[i];
  const auto elements = moving(into.particles);
  std::vector<std::array<double, 1>> parameters;
  for (const auto& [i] : elements) parameters.push_back({coefficient[i]});
  into.system.add<Drag>(elements, parameters);
}

void read_uniform_field(const Value& force, ForcesRead& into) {
  auto g = force.at("acceleration").vector(into.particles.dimension);
  g.resize(3, 0.0);
  into.system.add<UniformField>(moving(into.particles), {{g[0], g[1], g[2]}});
}

/// "frequency" [1/s] counts whole swings.
void read_oscillating_field(const Value& force, ForcesRead& into) {
  auto a = force.at("acceleration").vector(into.particles.dimension);
  a.resize(3, 0.0);
  const double omega = 2 * std::numbers::pi * force.at("frequency").number(positive),
               phase = force.at("phase", 0.0).number();
  into.system.add<OscillatingField>(moving(into.particles), {{a[0], a[1], a[2], omega, phase}});
}

/// Against the uniform fields of a scene, all together, wherever in the list they are; without any the second axis, on a
/// line the only one.
Components upwards(const Value& forces, int dimension) {
  Components sum(dimension, 0.0), up(dimension, 0.0);
  for (std::size_t f = 0; f < forces.size(); ++f) {
    const Value force = forces.at(f);
    const auto type = force.find("type"), acceleration = force.find("acceleration");
    if (!type || !acceleration || !type->is_string() || type->text() != UniformField::name) continue;
    const auto g = acceleration->vector(dimension);
    for (int c = 0; c < dimension; ++c) sum[c] += g[c];
  }
  const double length = std::hypot(sum[0], dimension > 1 ? sum[1] : 0.0, dimension > 2 ? sum[2] : 0.0);
  if (!(length > 0 && std::isfinite(length))) {
    up[dimension == 1 ? 0 : 1] = 1.0;
    return up;
  }
  for (int c = 0; c < dimension; ++c) up[c] = 0.0 - sum[c] / length;  // never -0
  return up;
}

/// "normal", made of length 1; up where it is left out.
std::array<double, 3> read_normal(const Value& force, int dimension, const Components& up) {
  const Value normal = force.at("normal", up);
  const auto n = normal.vector(dimension);
  const double length = std::hypot(n[0], dimension > 1 ? n[1] : 0.0, dimension > 2 ? n[2] : 0.0);
  if (!(length > 0 && std::isfinite(length))) normal.refuse("a direction: numbers that are not all 0");
  std::array<double, 3> unit{};
  for (int c = 0; c < dimension; ++c) unit[c] = n[c] / length;
  return unit;
}

void read_floor(const Value& force, ForcesRead& into) {
  const Particles& particles = into.particles;
  const double stiffness = force.at("stiffness").number(non_negative),
               height = force.at("height", 0.0).number();
  const auto [x, y, z] = read_normal(force, particles.dimension, into.up);
  if (force.at("power", 1).integer(1, 2) == 1)
    into.system.add<Floor>(moving(particles), {{stiffness, height, x, y, z}});
  else
    into.system.add<QuadraticFloor>(moving(particles), {{stiffness, height, x, y, z}});
}

}  // namespace

namespace {

std::vector<ForceRecord> records_of_particles() {
  const SceneKey stiffness{"stiffness", "[N/m], >= 0: one for all or one for each", "required"};
  return {
      {Spring::name,
       "Springs between pairs of particles",
       {{"pairs", "a list, `edges` of the mesh, `all`", "edges"},
        stiffness,
        {"rest_length",
         "[m], >= 0: one for all or one for each; `initial`: what it is at the beginning. At 0 the force is "
         "k d, "
         "and the ends may coincide",
         "initial"}},
       read_spring},
      {Drag::name,
       "A force against the velocity of each particle",
       {{"coefficient", "[kg/s], >= 0: one for all or one for each", "required, or `rate`"},
        {"rate", "[1/s], >= 0, times the mass of each particle: one for all or one for each", "none"}},
       read_drag},
      {UniformField::name,
       "The same acceleration of all particles",
       {{"acceleration", "[m/s^2], a component for each dimension", "required"}},
       read_uniform_field},
      {OscillatingField::name,
       "The same acceleration of all particles, that swings: a sin(2 pi f t + phase)",
       {{"acceleration", "a [m/s^2], a component for each dimension", "required"},
        {"frequency", "f [1/s], > 0", "required"},
        {"phase", "[rad]", "0"}},
       read_oscillating_field},
      {Gravity::name,
       "Attraction of pairs of particles by their masses",
       {{"pairs", "a list, `edges` of the mesh, `all`", "all"},
        {"constant", "G [m^3/(kg s^2)]", "1"},
        {"softening",
         "epsilon [m], >= 0, of Plummer: G m_1 m_2 d / (|d|^2 + epsilon^2)^(3/2), where particles may meet",
         "0"}},
       read_gravity},
      {Floor::name,
       "A floor that pushes back what is below it. Steps of `taylor` and `random_taylor` that a control "
       "chooses, "
       "and those of clocks of particles, end at its surface; other methods go over it",
       {{"stiffness", "[N/m], of power 2 [N/m^2], >= 0", "required"},
        {"height", "[m] along its normal", "0"},
        {"normal", "its way out, of any length but 0",
         "none: up, against the sum of all `uniform_field`, without any along the second axis"},
        {"power", "of the depth, 1 or 2", "1"}},
       read_floor}};
}

}  // namespace

const std::vector<ForceRecord>& force_records() {
  static const std::vector<ForceRecord> records = [] {
    std::vector<ForceRecord> all = records_of_particles();
    for (auto* more : {&solid_records, &cloth_records, &molecular_records, &contact_records})
      std::ranges::move(more(), std::back_inserter(all));
    return all;
  }();
  return records;
}

ForcesFound read_forces(const Value& forces, const Particles& particles, System<double>& system) {
  const std::vector<std::string> types = names_of(force_records());
  const Components up = upwards(forces, particles.dimension);
  ForcesRead into{particles, up, system};
  for (std::size_t f = 0; f < forces.size(); ++f) {
    const Value force = forces.at(f);
    if (!force.is_object()) force.refuse("an object with a type");
    const ForceRecord& record = named(force_records(), force.at("type").one_of(types));
    std::vector<std::string_view> keys = {"type"};
    for (const SceneKey& key : record.keys) keys.push_back(key.key);
    record.read(force.only(keys), into);
  }
  return {std::move(into.drawn), std::move(into.warnings), std::move(into.contacts)};
}

}  // namespace jetlag
