// SPDX-License-Identifier: MIT
#pragma once
// What a force law is, and what it looks like when it has been recorded.
//
// A law is a struct without data. It is a template over its scalar and knows nothing of series:
//
//   struct Spring {
//     static constexpr const char* name = "spring";
//     static constexpr int participants = 2;                              // 1 to 8
//     static constexpr std::array parameters{"stiffness", "rest_length"};
//
//     template <class T, int D>     // force on participant 0 [N]; participant 1 gets the opposite
//     static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness, const T& rest_length);
//   };
//
// Which forces it gives. A law acts between its participants, and gives the forces on all but the last, which gets minus
// their sum; or it is *external*, and gives those on all. A law of one participant is external, another one says so. One
// force is called `force`, several are an array:
//
//     static std::array<Vector<T, D>, 3> forces(const Participants<T, D, 4>& p, ...);
//
// A law that has an `energy` and no forces gets them from it: minus its derivatives by the positions, which are recorded
// once and then cost about what forces written by hand do (tape/derivative.hpp). A whole law is ten lines:
//
//   struct Angle {       // E = k/2 (cos - c)^2 of the angle at the second of three particles
//     static constexpr const char* name = "angle";
//     static constexpr int participants = 3;
//     static constexpr std::array parameters{"stiffness", "cosine"};
//     template <class T, int D>
//     static T energy(const Participants<T, D, 3>& p, const T& k, const T& cosine) {
//       const Vector<T, D> a = p.position[0] - p.position[1], b = p.position[2] - p.position[1];
//       const T off = T(a.dot(b)) / (a.norm() * b.norm()) - cosine;
//       return T(0.5) * k * off * off;
//     }
//   };
//
// Where an energy has no series, its forces have none, but for r / r: of E = k/2 |d|^2 they exist at d = 0. Choices in it are
// those of the forces; |u| has the slope 0 where u is. Such an energy may depend on the time, but not on velocities; that of a
// law between particles is written in differences of positions.
//
// What else it may have:
//
//     static constexpr bool external = true;                // gives the force on each of two participants or more
//     static constexpr std::array dimensions{2, 3};         // of space, where it is not defined in all of 1, 2 and 3
//
//     template <class T, int D>     // potential energy [J]
//     static T energy(const Participants<T, D, 2>& p, const T& stiffness, const T& rest_length);
//
//     // how its parameters follow from where its participants are at rest [m] and from what they are made of; throws
//     // std::invalid_argument for what cannot be, see System::add_at_rest (model/system.hpp)
//     static constexpr std::array material{"lame_lambda", "lame_mu"};
//     template <class T>            // T: the numbers of a system
//     static std::array<T, parameters.size()> at_rest(const std::array<Vector<T, 3>, 4>& x, const T& lambda, const T& mu);
//
//     static double stiffness(double k, double);            // k [N/m], of the parameters: for the Courant limit
//     static double damping(double c);                      // c [kg/s], of the parameters: for the Courant limit
//     static constexpr bool unbounded = true;               // there is no stiffness: Courant limits go without the law
//
//     static constexpr int unrolled_orders = 20;            // compiled as one function too, for systems of a single
//                                                           // element (law_kernel.hpp)
//
//     template <int D>              // the way to where the force has a kink or jumps [m]
//     static Vector<double, D> kink(const Positions<D, 2>& x, double stiffness, double rest_length);
//
// A force may make choices: select, abs, min, max, and roots that come to zero. Steps end where one of
// them changes, found from the series of what decides it; pow(max(d, 0), 1.5) is zero to all orders where d < 0.
// A `kink` takes their place: it costs less, since particles far from it are not looked at.
//
// What a series cannot tell, no step sees: a pulse whose coefficients at the beginning are below their rounding, as of
// exp(-50 (t - 5)^2) at t = 0, and what is shorter than a step and no choice, as the cut of atan2 where it is crossed twice.
// A max_step shorter than it, or a choice (select), finds it.
//
// Invariants, tested for every law of the register (forces.hpp):
//   - a law between particles conserves momentum: the forces of an element add up to zero to the last bit, those given
//     in their order, then that on the last participant;
//   - it also turns with the world: it depends on no direction of space;
//   - where `energy` exists, force = -d energy / d position;
//   - `stiffness` bounds the eigenvalues of -d force_i / d x_i of each participant i, in any state, or in those that its
//     comment names. Then no mode of one element is faster than  omega^2 = k sum_i 1/m_i.  A law that acts on positions
//     and has none is bounded at one state at a time, by its tangent (control/frequency_bound.hpp);
//   - `damping` is of a law of one participant: its force is -c v and something that does not depend on v;
//   - where `kink` exists, it has 1 to 3 components, vanishes where no series of the force goes on, comes out on the other
//     side turned round by more than a right angle, and changes by no more than the ways of the participants together,
//     that of a law between particles not at all where they move alike.
//     Of a spring it is the vector from end to end, of a floor the height above it. Not for kinks that move by themselves
//     or depend on velocities.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <concepts>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/forces/law.hpp"
#include "jetlag/forces/law_kernel.hpp"
#include "jetlag/series/jet.hpp"
#include "jetlag/tape/derivative.hpp"
#include "jetlag/tape/fusion.hpp"
#include "jetlag/tape/recording.hpp"
#include "jetlag/tape/tape.hpp"

namespace jetlag {

/// Whether it is defined in a dimension of space.
template <ForceLaw L>
constexpr bool is_defined_in(int dimension) {
  if constexpr (requires { L::dimensions; })
    return std::ranges::find(L::dimensions, dimension) != L::dimensions.end();
  else
    return 1 <= dimension && dimension <= 3;
}

namespace detail {

/// Minus the derivatives of the energy by the positions: of recorded values from the recording, all at once; of numbers and
/// series one by one, as coefficient 1 of the energy on jets that start along one axis each.
template <ForceLaw L, class T, int D, class... C>
std::array<Vector<T, D>, forces_given<L>> forces_from_energy(const Participants<T, D, L::participants>& p,
                                                             const C&... c) {
  std::array<Vector<T, D>, forces_given<L>> forces;
  if constexpr (std::same_as<T, Recorded>) {
    std::vector<Recorded> positions;
    for (int i = 0; i < forces_given<L>; ++i)
      positions.insert(positions.end(), p.position[i].data(), p.position[i].data() + D);
    const Recorded energy = L::energy(p, c...);
    const auto slopes = derivatives(*positions[0].recording(), -energy, positions);
    for (int i = 0; i < forces_given<L>; ++i)
      for (int axis = 0; axis < D; ++axis) forces[i][axis] = slopes[i * D + axis];
  } else {
    using Moved = Jet<T, 1>;
    Participants<Moved, D, L::participants> moved;
    for (int i = 0; i < L::participants; ++i) {
      moved.position[i] = p.position[i].template cast<Moved>();
      moved.velocity[i] = p.velocity[i].template cast<Moved>();
      moved.mass[i] = Moved(p.mass[i]);
    }
    moved.time = Moved(p.time);
    for (int i = 0; i < forces_given<L>; ++i)
      for (int axis = 0; axis < D; ++axis) {
        moved.position[i][axis][1] = T(1.0);
        const Moved energy = L::energy(moved, Moved(c)...);
        forces[i][axis] = -energy[1];
        moved.position[i][axis][1] = T(0.0);
      }
  }
  return forces;
}

}  // namespace detail

/// The forces that a law gives [N], or that its energy gives.
template <ForceLaw L, class T, int D, class... C>
std::array<Vector<T, D>, forces_given<L>> forces_of(const Participants<T, D, L::participants>& p,
                                                    const C&... c) {
  if constexpr (requires { L::force(p, c...); }) {
    static_assert(forces_given<L> == 1, "a law that gives several forces has an array of them, `forces`");
    return {Vector<T, D>(L::force(p, c...))};
  } else if constexpr (requires { L::forces(p, c...); }) {
    return L::forces(p, c...);
  } else {
    static_assert(requires { L::energy(p, c...); }, "a law has a `force`, `forces` or an `energy`");
    return detail::forces_from_energy<L>(p, c...);
  }
}

/// A law recorded for one dimension of space. Its parameters are those of the law, then the participants' masses.
struct RecordedLaw {
  std::string name;
  int dimension;
  int participants;
  std::vector<std::string> parameters;  // names, without the masses
  Tape force;  // outputs: the forces on the first `given` participants, component by component
  std::optional<Tape> energy;  // output: the potential energy
  int given = 1;               // all participants, or all but the last, which gets minus the sum

  /// What the law says of its elements by their parameters; null where it says nothing.
  using OfParameters = double (*)(const double* parameters);
  OfParameters stiffness = nullptr;  // [N/m]
  OfParameters damping = nullptr;    // [kg/s]
  bool unbounded = false;            // says itself that no stiffness bounds it

  /// What the law says of its kinks, from the positions of the participants, shape (participants, dimension), and the
  /// parameters; zero from its last component on. Null where it has none.
  using Kink = Eigen::Vector3d (*)(const double* positions, const double* parameters);
  Kink kink = nullptr;
  int kink_components = 0;

  LawKernel kernel{};  // the law itself, compiled for a single element

  bool is_external() const { return given == participants; }
  /// Whether its kinks are where particles meet, as the ends of a spring, so that hardly any motion hits one.
  bool has_point_kinks() const { return kink != nullptr && participants > 1 && kink_components == dimension; }
};

/// Whether a tape reads a kind of input; positions also by their separations.
bool reads(const Tape& tape, Input::Kind kind);
/// Whether it reads positions otherwise than by separations.
bool reads_places(const Tape& tape);
/// Whether the force of a law depends on it.
bool reads(const RecordedLaw& law, Input::Kind kind);

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

/// L::stiffness(parameters ...) and L::damping(parameters ...), where they are.
template <class L, std::size_t... I>
auto call_stiffness(const double* parameters, std::index_sequence<I...>)
    -> decltype(L::stiffness(parameters[I]...)) {
  return L::stiffness(parameters[I]...);
}
template <class L, std::size_t... I>
auto call_damping(const double* parameters, std::index_sequence<I...>)
    -> decltype(L::damping(parameters[I]...)) {
  return L::damping(parameters[I]...);
}

template <ForceLaw L>
void add_bounds(RecordedLaw& law) {
  using Each = std::make_index_sequence<L::parameters.size()>;
  if constexpr (requires(const double* c) { call_stiffness<L>(c, Each{}); })
    law.stiffness = [](const double* c) -> double { return call_stiffness<L>(c, Each{}); };
  if constexpr (requires { L::unbounded; }) law.unbounded = L::unbounded;
  if constexpr (requires(const double* c) { call_damping<L>(c, Each{}); }) {
    static_assert(L::participants == 1, "only a law of one participant has a damping");
    law.damping = [](const double* c) -> double { return call_damping<L>(c, Each{}); };
  }
}

template <ForceLaw L, int D>
RecordedLaw record_in_dimension() {
  constexpr bool gives_forces = has_force<L, D, Recorded> || has_forces<L, D, Recorded>;
  RecordedLaw law{L::name, D, L::participants, {L::parameters.begin(), L::parameters.end()}, {}, {}};
  law.given = forces_given<L>;
  law.kernel = kernel_of_law<L, D>();
  add_bounds<L>(law);
  add_kink<L, D>(law);
  const int all_parameters = static_cast<int>(L::parameters.size()) + L::participants;
  {
    Recording recording;
    const auto forces =
        call_recorded<L, D>(recording, [](const auto& p, const auto&... c) { return forces_of<L>(p, c...); });
    std::vector<Recorded> components;
    for (const auto& f : forces) components.insert(components.end(), f.data(), f.data() + D);
    law.force = recording.finish(components);
    if (law.kink == nullptr) law.force = with_conditions(std::move(law.force));
    law.force = with_separations(law.force);
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
    if (!gives_forces && reads(*law.energy, Input::Kind::velocity))
      throw std::invalid_argument(std::string(L::name) +
                                  ": forces from an energy that depends on velocities");
    // The last participant gets minus the sum of the others: its own derivative only where nothing but differences counts.
    if (!gives_forces && !is_external<L>() && reads_places(*law.energy))
      throw std::invalid_argument(std::string(L::name) +
                                  ": the energy of a law between particles must be written in differences of "
                                  "positions, x_i - x_j; or the law says that it is external");
  }
  return law;
}

}  // namespace detail

/// The law, called once with the recording scalar. dimension: 1, 2 or 3.
/// Throws std::invalid_argument for another dimension, and for one in which the law is not defined.
/// The library exports it for its own laws. A constraint would be part of its name with clang 18 and newer, and not with g++.
template <class L>
RecordedLaw record_law(int dimension) {
  static_assert(ForceLaw<L>, "a force law has a name, participants (1 to 8) and parameters");
  if (dimension < 1 || dimension > 3)
    throw std::invalid_argument("dimension must be 1, 2 or 3, got " + std::to_string(dimension));
  if constexpr (is_defined_in<L>(1))
    if (dimension == 1) return detail::record_in_dimension<L, 1>();
  if constexpr (is_defined_in<L>(2))
    if (dimension == 2) return detail::record_in_dimension<L, 2>();
  if constexpr (is_defined_in<L>(3))
    if (dimension == 3) return detail::record_in_dimension<L, 3>();
  throw std::invalid_argument(std::string(L::name) + " is not defined in dimension " +
                              std::to_string(dimension));
}

}  // namespace jetlag
