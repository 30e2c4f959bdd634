// SPDX-License-Identifier: MIT
#pragma once
// What a force law is, and what it looks like when it has been recorded.
//
// A law is a struct without data. It is a template over its scalar and knows nothing of series:
//
//   struct Spring {
//     static constexpr const char* name = "spring";
//     static constexpr int participants = 2;
//     static constexpr std::array parameters{"stiffness", "rest_length"};
//
//     template <class T, int D>     // force on participant 0 [N]
//     static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness, const T& rest_length);
//
//     static constexpr int stiffness_parameter = 0;   // its number, if one bounds -dF/dx; for the Courant limit
//
//     template <class T, int D>     // potential energy [J]; left out when there is none
//     static T energy(const Participants<T, D, 2>& p, const T& stiffness, const T& rest_length);
//
//     template <int D>              // the way to where the force has a kink or jumps [m]; left out when it does not
//     static Vector<double, D> kink(const Positions<D, 2>& x, double stiffness, double rest_length);
//   };
//
// Invariants, tested for every law of the register (forces.hpp):
//   - one participant: `force` is the force on it; two: the force on participant 0, and participant 1 gets the
//     opposite, so that every law between particles conserves momentum to the last bit;
//   - where `energy` exists, force = -d energy / d position;
//   - a law of two participants turns with the world: it depends on no direction of space;
//   - where `kink` exists, it has 1 to 3 components, vanishes where no series of the force goes on, comes out on the other
//     side turned round by more than a right angle, and changes by no more than the ways of the participants together.
//     Of a spring it is the vector from end to end, of a floor the height above it. Not for kinks that move by themselves
//     or depend on velocities.

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/tape/fusion.hpp"
#include "jetlag/tape/recording.hpp"
#include "jetlag/tape/tape.hpp"

namespace jetlag {

template <class T, int D>
using Vector = Eigen::Matrix<T, D, 1>;

/// The particles on which one element acts, as its law sees them.
template <class T, int D, int P>
struct Participants {
  std::array<Vector<T, D>, P> position;  // [m]
  std::array<Vector<T, D>, P> velocity;  // [m/s]
  std::array<T, P> mass;                 // [kg], no series
  T time;                                // [s]
};

/// Their positions alone, as numbers [m].
template <int D, int P>
using Positions = std::array<Vector<double, D>, P>;

template <class L>
concept ForceLaw = requires {
  { L::name } -> std::convertible_to<const char*>;
  { L::participants } -> std::convertible_to<int>;
  L::parameters.size();
} && (L::participants == 1 || L::participants == 2);

/// A law recorded for one dimension of space. Its parameters are those of the law, then the participants' masses.
struct RecordedLaw {
  std::string name;
  int dimension;
  int participants;
  std::vector<std::string> parameters;  // names, without the masses
  Tape force;                           // outputs: the force on participant 0, component by component
  std::optional<Tape> energy;           // output: the potential energy
  int stiffness_parameter = -1;  // the parameter that bounds the eigenvalues of -dF_0/dx_0 [N/m], if any

  /// What the law says of its kinks, from the positions of the participants, shape (participants, dimension), and the
  /// parameters; zero from its last component on. Null where it has none.
  using Kink = Eigen::Vector3d (*)(const double* positions, const double* parameters);
  Kink kink = nullptr;
  int kink_components = 0;
};

namespace detail {

template <int D, int P>
Participants<Recorded, D, P> recorded_participants(Recording& recording, int parameters) {
  Participants<Recorded, D, P> p;
  for (int i = 0; i < P; ++i) {
    for (int c = 0; c < D; ++c) {
      p.position[i][c] = recording.input({Input::Kind::position, i, c});
      p.velocity[i][c] = recording.input({Input::Kind::velocity, i, c});
    }
    p.mass[i] = recording.parameter(parameters + i);
  }
  p.time = recording.input({Input::Kind::time, 0, 0});
  return p;
}

/// f(participants, parameters...) with recorded arguments.
template <ForceLaw L, int D, class F>
auto call_recorded(Recording& recording, F f) {
  constexpr int n = static_cast<int>(L::parameters.size());
  const auto p = recorded_participants<D, L::participants>(recording, n);
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return f(p, recording.parameter(static_cast<int>(I))...);
  }(std::make_index_sequence<n>{});
}

/// L::kink(positions, parameters ...), where there is one.
template <class L, class X, std::size_t... I>
auto call_kink(const X& x, const double* parameters, std::index_sequence<I...>)
    -> decltype(L::kink(x, parameters[I]...)) {
  return L::kink(x, parameters[I]...);
}

template <ForceLaw L, int D>
void add_kink(RecordedLaw& law) {
  using Places = Positions<D, L::participants>;
  using Each = std::make_index_sequence<L::parameters.size()>;
  if constexpr (requires(const Places& x, const double* c) { call_kink<L>(x, c, Each{}); }) {
    constexpr int components = decltype(call_kink<L>(Places{}, nullptr, Each{}))::RowsAtCompileTime;
    law.kink_components = components;
    law.kink = [](const double* positions, const double* parameters) {
      Places x;
      for (int i = 0; i < L::participants; ++i) x[i] = Vector<double, D>::Map(positions + i * D);
      Eigen::Vector3d padded = Eigen::Vector3d::Zero();
      padded.head<components>() = call_kink<L>(x, parameters, Each{});
      return padded;
    };
  }
}

template <ForceLaw L, int D>
RecordedLaw record_in_dimension() {
  RecordedLaw law{L::name, D, L::participants, {L::parameters.begin(), L::parameters.end()}, {}, {}};
  if constexpr (requires { L::stiffness_parameter; }) law.stiffness_parameter = L::stiffness_parameter;
  add_kink<L, D>(law);
  const int all_parameters = static_cast<int>(L::parameters.size()) + L::participants;
  {
    Recording recording;
    const Vector<Recorded, D> f = call_recorded<L, D>(
        recording, [](const auto& p, const auto&... c) -> Vector<Recorded, D> { return L::force(p, c...); });
    law.force = with_separations(recording.finish({f.data(), f.data() + D}));
    law.force.parameters = all_parameters;
  }
  constexpr bool has_energy = requires(Participants<Recorded, D, L::participants> p) {
    []<std::size_t... I>(const auto& q,
                         std::index_sequence<I...>) -> decltype(L::energy(q, ((void)I, Recorded())...)) {
      return {};
    }(p, std::make_index_sequence<L::parameters.size()>{});
  };
  if constexpr (has_energy) {
    Recording recording;
    const Recorded e = call_recorded<L, D>(
        recording, [](const auto& p, const auto&... c) -> Recorded { return L::energy(p, c...); });
    law.energy = with_separations(recording.finish({e}));
    law.energy->parameters = all_parameters;
  }
  return law;
}

}  // namespace detail

/// The law, called once with the recording scalar. dimension: 1, 2 or 3.
template <ForceLaw L>
RecordedLaw record_law(int dimension) {
  switch (dimension) {
    case 1: return detail::record_in_dimension<L, 1>();
    case 2: return detail::record_in_dimension<L, 2>();
    case 3: return detail::record_in_dimension<L, 3>();
    default: throw std::invalid_argument("dimension must be 1, 2 or 3, got " + std::to_string(dimension));
  }
}

}  // namespace jetlag
