// SPDX-License-Identifier: MIT
#pragma once
// Force laws without their types: each is compiled for jets and for numbers, and tests of all of them once.

#include <array>
#include <cstddef>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "problems/from_energy.hpp"
#include "support/close.hpp"
#include "support/laws/laws_of_many.hpp"

namespace jetlag::testing::force_laws_test {

constexpr int degree = 8;
using Number = RunningError<double>;
using Tracked = Jet<Number, degree>;  // serves numbers as coefficient 0, derivatives as coefficient 1

/// Participants along polynomials of the time, or at rest: then coefficients from 1 on are 0.
struct Moving {
  std::vector<Tracked> position, velocity;  // shape (participants, dimension), row by row
  std::vector<double> mass;
  Tracked time;
};
using Parameters = std::vector<double>;

struct LawInDimension {
  int dimension;
  RecordedLaw (*recorded)(int dimension);
  std::vector<Tracked> (*given)(const Moving&, const Parameters&);  // forces, component by component
  std::vector<double> (*given_on_numbers)(const Moving&, const Parameters&);
  Tracked (*energy)(const Moving&, const Parameters&);  // null: it has none
  /// The parameters of a rest shape, of positions as in Moving, and of a material; null: they may be any.
  Parameters (*at_rest)(const std::vector<double>& positions, const std::vector<double>& material);
  std::size_t materials;
  bool flat_at_rest = false;  // its rest shape must lie in a plane
};
struct LawOnJets {
  std::string name;
  int participants;
  bool external;
  std::size_t parameters;
  bool has_energy;
  std::vector<LawInDimension> in_dimensions;
  friend void PrintTo(const LawOnJets& law, std::ostream* out) { *out << law.name; }
};

template <class T>
T as(const Tracked& u) {
  if constexpr (std::is_same_v<T, double>)
    return u[0].value;
  else
    return u;
}

template <class T, int D, int P>
Participants<T, D, P> participants_of(const Moving& all) {
  Participants<T, D, P> p;
  for (int i = 0; i < P; ++i) {
    for (int c = 0; c < D; ++c) {
      p.position[i][c] = as<T>(all.position[i * D + c]);
      p.velocity[i][c] = as<T>(all.velocity[i * D + c]);
    }
    p.mass[i] = T(all.mass[i]);
  }
  p.time = as<T>(all.time);
  return p;
}

template <class L>
using EachParameter = std::make_index_sequence<L::parameters.size()>;

template <class L, class T, int D>
std::vector<T> given_forces(const Moving& all, const Parameters& c) {
  const auto p = participants_of<T, D, L::participants>(all);
  const auto given = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return forces_of<L>(p, T(c[I])...);
  }(EachParameter<L>{});
  std::vector<T> components;
  for (const auto& f : given) components.insert(components.end(), f.data(), f.data() + D);
  return components;
}

template <class L, int D>
Tracked energy_of(const Moving& all, const Parameters& c) {
  const auto p = participants_of<Tracked, D, L::participants>(all);
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return Tracked(L::energy(p, Tracked(c[I])...));
  }(EachParameter<L>{});
}

template <class L, int D>
Parameters parameters_at_rest(const std::vector<double>& positions, const std::vector<double>& material) {
  Positions<D, L::participants> x;
  for (int i = 0; i < L::participants; ++i) x[i] = Vector<double, D>::Map(positions.data() + i * D);
  const auto c = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return L::at_rest(x, material[I]...);
  }(std::make_index_sequence<L::material.size()>{});
  return {c.begin(), c.end()};
}

template <class L>
constexpr int some_dimension = is_defined_in<L>(3) ? 3 : 2;
template <class L>
constexpr bool has_energy = requires(Participants<double, some_dimension<L>, L::participants> p) {
  []<std::size_t... I>(const auto& q,
                       std::index_sequence<I...>) -> decltype(L::energy(q, ((void)I, 0.0)...)) {
    return {};
  }(p, EachParameter<L>{});
};

template <class L, int D>
void add_dimension(LawOnJets& law) {
  if constexpr (is_defined_in<L>(D)) {
    law.in_dimensions.push_back(
        {D, record_law<L>, given_forces<L, Tracked, D>, given_forces<L, double, D>, nullptr, nullptr, 0});
    if constexpr (HasRestShape<L>) {
      law.in_dimensions.back().at_rest = parameters_at_rest<L, D>;
      law.in_dimensions.back().materials = L::material.size();
      law.in_dimensions.back().flat_at_rest = std::is_base_of_v<Bending, L>;
    }
    if constexpr (has_energy<L>) law.in_dimensions.back().energy = energy_of<L, D>;
  }
}

template <class L>
LawOnJets on_jets() {
  LawOnJets law{L::name, L::participants, is_external<L>(), L::parameters.size(), has_energy<L>, {}};
  add_dimension<L, 1>(law);
  add_dimension<L, 2>(law);
  add_dimension<L, 3>(law);
  return law;
}

/// A law, and its energy as a law of its own, where it has forces beside it.
template <class L>
void add_law(std::vector<LawOnJets>& all) {
  all.push_back(on_jets<L>());
  constexpr int D = some_dimension<L>;
  if constexpr (jetlag::detail::has_force<L, D, Recorded> || jetlag::detail::has_forces<L, D, Recorded>)
    if constexpr (has_energy<L>) all.push_back(on_jets<problems::FromEnergy<L>>());
}

/// The register, and laws of many.
inline std::vector<LawOnJets> all_laws() {
  std::vector<LawOnJets> all;
  Forces::for_each([&]<class L>(std::type_identity<L>) { add_law<L>(all); });
  add_law<AngleByHand>(all);
  add_law<Bend>(all);
  add_law<Tetrahedron>(all);
  add_law<Anchors>(all);
  return all;
}

}  // namespace jetlag::testing::force_laws_test
