// SPDX-License-Identifier: MIT
#pragma once
// Model: the one compiled form of a system, which all share that run it.
//
// A system is built up, law by law. A model is made of it once and never changes, so that a copy is the same model:
// particles, the laws with their elements, who takes part in which, and the constants of every force. What only some need
// is computed when it is asked for first.
//
// Elements that come and go make the next epoch of a model:
//
//   Model<> next = model.with(law, particles, parameters);
//
// Its other laws are those of the model before. Whoever runs a model moves on to the next one (`move_to` of Expansion,
// PartialExpansion, EnergyMeter) at the cost of the law that is another.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/base/on_demand.hpp"
#include "jetlag/model/element_blocks.hpp"
#include "jetlag/model/particle_order.hpp"
#include "jetlag/model/system.hpp"

namespace jetlag {

/// A list for each particle, one after another.
struct ParticleLists {
  std::vector<int> first{0}, entries;
  std::span<const int> of(int particle) const {
    return {entries.data() + first[particle], entries.data() + first[particle + 1]};
  }
};

template <class T = double>
class Model {
 public:
  /// A law and its elements, as they were given.
  class Law {
   public:
    Law(const Model& model, Elements<T> elements);

    const Elements<T>& elements() const { return elements_; }
    const std::vector<int>& all() const { return all_; }  // the numbers of its elements: 0, 1, ..
    std::size_t count() const { return all_.size(); }
    std::span<const int> particles_of(int element) const {
      const std::size_t p = elements_.law.participants;
      return {elements_.particles.data() + element * p, p};
    }

    /// The elements that a particle takes part in, ascending.
    std::span<const int> of(int particle) const {
      return of_particle_([this] { return elements_of_particles(); }).of(particle);
    }

    /// All elements with their constants, from which others take theirs: the forces, and blocks of an energy.
    const ElementBlocks<T>& forces() const {
      return forces_([this] { return blocks(elements_.law.force, kernels<T>(), all_); });
    }
    ElementBlocks<T> blocks(const Tape& tape, const KernelTable<T>& table,
                            std::span<const int> chosen) const {
      return ElementBlocks<T>(elements_.law.dimension, *mass_, elements_, tape, table, chosen);
    }

   private:
    ParticleLists elements_of_particles() const;

    std::shared_ptr<const std::vector<T>> mass_;
    Elements<T> elements_;
    std::vector<int> all_;
    OnDemand<ParticleLists> of_particle_;
    OnDemand<ElementBlocks<T>> forces_;
  };

  /// Keeps no reference to the system. Implicit: whoever runs a model takes a system as well. Throws std::invalid_argument for
  /// elements that come and go: who follows them has a ModelAlong (changing_elements.hpp).
  Model(const System<T>& system)  // NOLINT
      : Model(without_changing(system)) {
    if (!system.changing().empty())
      throw std::invalid_argument(
          "this method does not follow elements that come and go, as those of contacts; Taylor's method with "
          "one clock does");
  }
  /// With the elements of a system that are always there.
  static Model without_changing(const System<T>& system);

  /// The next epoch: another set of elements of one law. Shapes as in System::add.
  /// Throws std::invalid_argument as System::add, and for a law that the model does not have.
  Model with(std::size_t law, std::vector<int> particles, std::vector<T> parameters) const;

  /// Throws std::invalid_argument unless both are epochs of one model: nobody can move on to another.
  void require_epoch_of(const Model& other) const {
    if (parts_->mass != other.parts_->mass || laws().size() != other.laws().size())
      throw std::invalid_argument(
          "Model: one can only move on to another epoch of the same model, see Model::with");
  }

  /// 0 of a model that was made of a system, one more for each set of elements since.
  std::uint64_t epoch() const { return parts_->epoch; }

  int dimension() const { return parts_->dimension; }
  int particles() const { return static_cast<int>(parts_->mass->size()); }
  const std::vector<T>& mass() const { return *parts_->mass; }
  const std::vector<bool>& fixed() const { return parts_->fixed; }
  bool is_fixed(int particle) const { return parts_->inverse_mass[particle] == T(0); }
  /// 0 for fixed particles [1/kg].
  const T& inverse_mass(int particle) const { return parts_->inverse_mass[particle]; }

  /// In the order of System::elements(); one may have no elements now.
  const std::vector<std::shared_ptr<const Law>>& laws() const { return parts_->laws; }
  const Law& law(std::size_t number) const { return *parts_->laws[number]; }

  /// The other moving particles that share an element with a moving one, ascending, each once.
  std::span<const int> neighbours(int particle) const {
    return parts_->neighbours([this] { return all_neighbours(); }).of(particle);
  }

  /// The rank of each particle in an order in which neighbours are near each other (particle_order.hpp), the same in all
  /// epochs; empty where order does not matter.
  const std::vector<int>& rank() const {
    return parts_->rank([this] { return particle_order(particles(), pairs()); });
  }
  /// The elements of a law by the lowest, then the highest rank of their particles.
  std::vector<int> running_order(const Law& law) const;

 private:
  struct Parts {
    int dimension;
    std::shared_ptr<const std::vector<T>> mass;
    std::vector<T> inverse_mass;
    std::vector<bool> fixed;
    std::vector<std::shared_ptr<const Law>> laws;
    std::uint64_t epoch = 0;
    OnDemand<std::vector<int>> rank;
    OnDemand<ParticleLists> neighbours;
  };

  explicit Model(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::vector<int> pairs() const;
  ParticleLists all_neighbours() const;

  std::shared_ptr<const Parts> parts_;
};

// ---- definitions -----------------------------------------------------------------------------------------

template <class T>
Model<T>::Law::Law(const Model& model, Elements<T> elements)
    : mass_(model.parts_->mass), elements_(std::move(elements)), all_(elements_.count()) {
  std::iota(all_.begin(), all_.end(), 0);
}

template <class T>
ParticleLists Model<T>::Law::elements_of_particles() const {
  const auto& members = elements_.particles;
  const std::size_t particles = mass_->size();
  ParticleLists lists;
  lists.first.assign(particles + 1, 0);
  for (int i : members) ++lists.first[i + 1];
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  lists.entries.resize(members.size());
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  for (std::size_t m = 0; m < members.size(); ++m)
    lists.entries[next[members[m]]++] = static_cast<int>(m / elements_.law.participants);
  return lists;
}

template <class T>
Model<T> Model<T>::without_changing(const System<T>& system) {
  const auto parts = std::make_shared<Parts>();
  parts->dimension = system.dimension();
  parts->mass = std::make_shared<const std::vector<T>>(system.mass());
  parts->fixed = system.fixed();
  for (int i = 0; i < system.particles(); ++i)
    parts->inverse_mass.push_back(system.fixed()[i] ? T(0) : T(1) / system.mass()[i]);
  const Model model{std::shared_ptr<const Parts>(parts)};
  for (const Elements<T>& elements : system.elements())
    parts->laws.push_back(std::make_shared<const Law>(model, elements));
  return model;
}

template <class T>
Model<T> Model<T>::with(std::size_t number, std::vector<int> particles, std::vector<T> parameters) const {
  if (number >= laws().size())
    throw std::invalid_argument("Model: law " + std::to_string(number) + " does not exist, there are " +
                                std::to_string(laws().size()));
  System<T> checked(dimension(), mass());
  checked.add(law(number).elements().law, std::move(particles), std::move(parameters));
  const auto parts = std::make_shared<Parts>();
  parts->dimension = dimension();
  parts->mass = parts_->mass;
  parts->inverse_mass = parts_->inverse_mass;
  parts->fixed = parts_->fixed;
  parts->laws = parts_->laws;
  parts->laws[number] = std::make_shared<const Law>(*this, checked.elements().front());
  parts->epoch = epoch() + 1;
  parts->rank([this] { return rank(); });
  return Model(std::shared_ptr<const Parts>(parts));
}

template <class T>
std::vector<int> Model<T>::running_order(const Law& law) const {
  std::vector<int> order = law.all();
  if (rank().empty()) return order;
  const auto key = [&, &rank = rank()](int element) {
    const auto particles = law.particles_of(element);
    std::array ends{rank[particles.front()], rank[particles.front()]};
    for (const int i : particles) ends = {std::min(ends[0], rank[i]), std::max(ends[1], rank[i])};
    return std::pair(ends, element);
  };
  std::ranges::sort(order, {}, key);
  return order;
}

/// Those that share an element, two numbers each.
template <class T>
std::vector<int> Model<T>::pairs() const {
  std::vector<int> found;
  for (const auto& law : laws())
    for (const int e : law->all()) {
      const auto members = law->particles_of(e);
      for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j)
          found.insert(found.end(), {members[i], members[j]});
    }
  return found;
}

template <class T>
ParticleLists Model<T>::all_neighbours() const {
  ParticleLists lists;
  std::vector<int> found;
  for (int i = 0; i < particles(); ++i) {
    found.clear();
    if (!is_fixed(i))
      for (const auto& law : laws())
        for (const int e : law->of(i))
          for (const int other : law->particles_of(e))
            if (other != i && !is_fixed(other)) found.push_back(other);
    std::ranges::sort(found);
    found.erase(std::ranges::unique(found).begin(), found.end());
    lists.entries.insert(lists.entries.end(), found.begin(), found.end());
    lists.first.push_back(static_cast<int>(lists.entries.size()));
  }
  return lists;
}

extern template class Model<double>;

}  // namespace jetlag
