// SPDX-License-Identifier: MIT
#pragma once
// A mechanical system: particles and the elements that act between them.  M x'' = F(t, x, x').

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/forces/force.hpp"
#include "jetlag/forces/lambda_law.hpp"

#if EIGEN_DEFAULT_ALIGN_BYTES != 64
#error \
    "jetlag: define EIGEN_MAX_ALIGN_BYTES=64 for the whole program, as the CMake target jetlag::jetlag does: \
matrices that the library and its users hand each other must be allocated in one way, whatever flags they are built with"
#endif

namespace jetlag {

/// One row a particle, one column a component. Shape (particles, dimension).
template <class T = double>
using Coordinates = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <class T = double>
struct State {
  T time{};                 // [s]
  Coordinates<T> position;  // [m]
  Coordinates<T> velocity;  // [m/s]

  /// What rounding has cut off: the positions are position + position_rest, with a rest below half of the last place,
  /// and so are the velocities. Empty: nothing. Integrators with compensated sums keep them, others drop them; whoever
  /// changes a position or a velocity drops them too.
  Coordinates<T> position_rest{}, velocity_rest{};

  void drop_rests() {
    position_rest.resize(0, 0);
    velocity_rest.resize(0, 0);
  }

  /// Without a third one.
  friend void swap(State& a, State& b) {
    std::swap(a.time, b.time);
    a.position.swap(b.position);
    a.velocity.swap(b.velocity);
    a.position_rest.swap(b.position_rest);
    a.velocity_rest.swap(b.velocity_rest);
  }
};

/// Throws std::invalid_argument unless positions and velocities have the shape (particles, dimension), and so their
/// rests where there are any.
template <class T>
void require_shape(const State<T>& state, int particles, int dimension) {
  const auto fits = [&](const Coordinates<T>& rows) {
    return rows.rows() == particles && rows.cols() == dimension;
  };
  const auto fits_or_empty = [&](const Coordinates<T>& rows) { return rows.size() == 0 || fits(rows); };
  if (!fits(state.position) || !fits(state.velocity) || !fits_or_empty(state.position_rest) ||
      !fits_or_empty(state.velocity_rest))
    throw std::invalid_argument("State: positions and velocities, and their rests, must have the shape (" +
                                std::to_string(particles) + ", " + std::to_string(dimension) + ")");
}

/// All elements of one law.
template <class T = double>
struct Elements {
  RecordedLaw law;
  std::vector<int> particles;  // shape (count, law.participants), row by row
  std::vector<T> parameters;   // shape (count, law.parameters.size()), row by row

  std::size_t count() const { return particles.size() / law.participants; }
};

class ChangingElements;  // changing_elements.hpp

/// What a system knows of elements that come and go, and the number of the first of their laws.
struct ChangingLaws {
  std::shared_ptr<const ChangingElements> elements;
  std::size_t first_law;
};

template <class T = double>
class System {
 public:
  /// dimension: 1, 2 or 3. mass: one for each particle [kg], > 0 and finite.
  /// Throws std::invalid_argument.
  System(int dimension, std::vector<T> mass);

  /// Holds a particle where it is, whatever acts on it. It must be at rest.
  void fix(int particle);

  /// Elements of law L. participants: the particles of each element; parameters: those of each element, or
  /// one set for all. Throws std::invalid_argument for an index out of range, for a particle paired with
  /// itself, for a number of parameters that does not fit, and for a law that is not defined in this dimension.
  template <ForceLaw L>
  void add(const std::vector<std::array<int, L::participants>>& participants,
           const std::vector<std::array<T, L::parameters.size()>>& parameters) {
    std::vector<int> particles;
    for (const auto& element : participants)
      particles.insert(particles.end(), element.begin(), element.end());
    std::vector<T> flat;
    for (const auto& set : parameters) flat.insert(flat.end(), set.begin(), set.end());
    add(record_law<L>(dimension_), std::move(particles), std::move(flat));
  }
  void add(RecordedLaw law, std::vector<int> particles, std::vector<T> parameters);

  /// A force on each of some particles by a lambda (forces/lambda_law.hpp); D: the dimension of the system. Throws
  /// std::invalid_argument as add, and for another dimension.
  template <int D, class F>
    requires std::same_as<T, double>
  void add(std::string name, const F& force, std::vector<int> particles) {
    add(record_lambda<D>(std::move(name), force), std::move(particles), {});
  }

  /// Elements of a law L whose parameters follow from a rest shape and a material (forces/force.hpp).
  /// rest: where particles are at rest [m], shape (particles, dimension); material: L::material of each element, or one for
  /// all. Throws std::invalid_argument as add, and for an element that cannot be at rest so: its number and why, as a volume
  /// that is negative, flat elements, numbers that are not finite.
  template <HasRestShape L>
  void add_at_rest(const std::vector<std::array<int, L::participants>>& participants,
                   const Coordinates<T>& rest,
                   const std::vector<std::array<T, L::material.size()>>& material);

  /// Elements that come and go with the motion, of these laws. There are none of them in elements().
  void add_changing(std::vector<RecordedLaw> laws, std::shared_ptr<const ChangingElements> elements)
    requires std::same_as<T, double>
  {
    changing_.push_back({std::move(elements), elements_.size()});
    for (RecordedLaw& law : laws) add(std::move(law), {}, {});
  }
  const std::vector<ChangingLaws>& changing() const { return changing_; }

  int dimension() const { return dimension_; }
  int particles() const { return static_cast<int>(mass_.size()); }
  const std::vector<T>& mass() const { return mass_; }
  const std::vector<bool>& fixed() const { return fixed_; }
  const std::vector<Elements<T>>& elements() const { return elements_; }

 private:
  int dimension_;
  std::vector<T> mass_;
  std::vector<bool> fixed_;
  std::vector<Elements<T>> elements_;
  std::vector<ChangingLaws> changing_;
};

/// Number of particles that are not fixed.
template <class T>
int moving_particles(const System<T>& system) {
  return static_cast<int>(std::ranges::count(system.fixed(), false));
}

// ---- definitions -----------------------------------------------------------------------------------------

template <class T>
System<T>::System(int dimension, std::vector<T> mass) : dimension_(dimension), mass_(std::move(mass)) {
  using std::isfinite;
  if (dimension < 1 || dimension > 3)
    throw std::invalid_argument("System: dimension must be 1, 2 or 3, got " + std::to_string(dimension));
  for (std::size_t i = 0; i < mass_.size(); ++i)
    if (!(mass_[i] > T(0)) || !isfinite(mass_[i]) || !isfinite(T(1) / mass_[i]))
      throw std::invalid_argument("System: the mass of particle " + std::to_string(i) +
                                  " must be > 0 and finite, and so must its reciprocal");
  fixed_.assign(mass_.size(), false);
}

template <class T>
void System<T>::fix(int particle) {
  if (particle < 0 || particle >= particles())
    throw std::invalid_argument("System: fixed particle " + std::to_string(particle) +
                                " does not exist, there are " + std::to_string(particles()));
  fixed_[particle] = true;
}

namespace detail {

/// Throws std::invalid_argument unless every element is of different particles that exist, 0 .. count-1.
inline void require_members(const std::string& who, const std::vector<int>& members, int participants,
                            int count) {
  if (members.size() % participants != 0)
    throw std::invalid_argument(who + " acts on " + std::to_string(participants) + " particles");
  for (std::size_t n = 0; n < members.size(); ++n) {
    const int particle = members[n];
    const auto refuse = [&](const std::string& why) {
      throw std::invalid_argument(who + " " + std::to_string(n / participants) + ": particle " +
                                  std::to_string(particle) + why);
    };
    if (particle < 0 || particle >= count) refuse(" does not exist, there are " + std::to_string(count));
    const auto here = members.begin() + static_cast<std::ptrdiff_t>(n);
    if (std::find(here - static_cast<std::ptrdiff_t>(n % participants), here, particle) != here)
      refuse(" cannot be paired with itself");
  }
}

/// L::at_rest(x, material ...) of one element.
template <int D, HasRestShape L, class T>
std::array<T, L::parameters.size()> parameters_at_rest(const std::string& who,
                                                       const std::array<int, L::participants>& element,
                                                       const Coordinates<T>& rest,
                                                       const std::array<T, L::material.size()>& material) {
  using std::isfinite;
  std::array<Vector<T, D>, L::participants> x;
  for (int i = 0; i < L::participants; ++i) x[i] = rest.row(element[i]);
  try {
    const auto parameters = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return L::at_rest(x, material[I]...);
    }(std::make_index_sequence<L::material.size()>{});
    for (const T& c : parameters)
      if (!isfinite(c))
        throw std::invalid_argument("its rest shape, its material and what follows from them must be finite");
    return parameters;
  } catch (const std::invalid_argument& why) {
    throw std::invalid_argument(who + why.what());
  }
}

}  // namespace detail

template <class T>
template <HasRestShape L>
void System<T>::add_at_rest(const std::vector<std::array<int, L::participants>>& participants,
                            const Coordinates<T>& rest,
                            const std::vector<std::array<T, L::material.size()>>& material) {
  const std::string who = "System: " + std::string(L::name);
  RecordedLaw law = record_law<L>(dimension_);
  std::vector<int> members;
  for (const auto& element : participants) members.insert(members.end(), element.begin(), element.end());
  detail::require_members(who, members, L::participants, particles());
  if (rest.rows() != particles() || rest.cols() != dimension_)
    throw std::invalid_argument(who + ": rest positions must have the shape (" + std::to_string(particles()) +
                                ", " + std::to_string(dimension_) + ")");
  if (material.size() != participants.size() && material.size() != 1)
    throw std::invalid_argument(who + ": a material is needed for each of " +
                                std::to_string(participants.size()) + " elements, or once for all");
  std::vector<T> parameters;
  parameters.reserve(participants.size() * L::parameters.size());
  for (std::size_t e = 0; e < participants.size(); ++e) {
    const std::string element = who + " " + std::to_string(e) + ": ";
    const auto& of = material[material.size() == 1 ? 0 : e];
    const auto append = [&]<int D>(std::integral_constant<int, D>) {
      if constexpr (is_defined_in<L>(D)) {
        const auto set = detail::parameters_at_rest<D, L, T>(element, participants[e], rest, of);
        parameters.insert(parameters.end(), set.begin(), set.end());
      }
    };
    if (dimension_ == 2) append(std::integral_constant<int, 2>{});
    if (dimension_ == 3) append(std::integral_constant<int, 3>{});
    if (dimension_ == 1) append(std::integral_constant<int, 1>{});
  }
  add(std::move(law), std::move(members), std::move(parameters));
}

template <class T>
void System<T>::add(RecordedLaw law, std::vector<int> members, std::vector<T> parameters) {
  const std::string who = "System: " + law.name;
  if (law.dimension != dimension_)
    throw std::invalid_argument(who + " was recorded for dimension " + std::to_string(law.dimension));
  detail::require_members(who, members, law.participants, particles());
  const std::size_t count = members.size() / law.participants, width = law.parameters.size();
  if (parameters.size() == width && count != 1) {
    std::vector<T> repeated;
    repeated.reserve(count * width);
    for (std::size_t e = 0; e < count; ++e)
      repeated.insert(repeated.end(), parameters.begin(), parameters.end());
    parameters = std::move(repeated);
  }
  if (parameters.size() != count * width)
    throw std::invalid_argument(who + ": " + std::to_string(width) + " parameters are needed for each of " +
                                std::to_string(count) + " elements, or once for all");
  elements_.push_back({std::move(law), std::move(members), std::move(parameters)});
}

extern template class System<double>;

}  // namespace jetlag
