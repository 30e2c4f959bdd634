// SPDX-License-Identifier: MIT
#pragma once
// A force law to the compiler: what it sees of the particles on which it acts, and which forces it gives (force.hpp).

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <utility>

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

/// The distance between rows of padded coordinates: a power of two, so that rows do not straddle cache lines.
constexpr int padded(int dimension) { return dimension == 3 ? 4 : dimension; }

constexpr int most_participants = 8;

template <class L>
concept ForceLaw = requires {
  { L::name } -> std::convertible_to<const char*>;
  { L::participants } -> std::convertible_to<int>;
  L::parameters.size();
} && (1 <= L::participants && L::participants <= most_participants);

/// A law whose parameters follow from a rest shape and a material.
template <class L>
concept HasRestShape = ForceLaw<L> && requires { L::material.size(); };

/// Whether a law gives the forces on all of its participants.
template <ForceLaw L>
constexpr bool is_external() {
  if constexpr (requires { L::external; })
    return L::external || L::participants == 1;
  else
    return L::participants == 1;
}

namespace detail {
/// Whether a law has a force of its own, and whether an array of them, for numbers T.
template <ForceLaw L, int D, class T>
constexpr bool has_force = requires(const Participants<T, D, L::participants>& p) {
  []<std::size_t... I>(const auto& q, std::index_sequence<I...>)
    requires requires { L::force(q, ((void)I, T())...); }
  {}(p, std::make_index_sequence<L::parameters.size()>{});
};
template <ForceLaw L, int D, class T>
constexpr bool has_forces = requires(const Participants<T, D, L::participants>& p) {
  []<std::size_t... I>(const auto& q, std::index_sequence<I...>)
    requires requires { L::forces(q, ((void)I, T())...); }
  {}(p, std::make_index_sequence<L::parameters.size()>{});
};
}  // namespace detail

/// How many forces it gives: on its first participants.
template <ForceLaw L>
constexpr int forces_given = is_external<L>() ? L::participants : L::participants - 1;

}  // namespace jetlag
