// SPDX-License-Identifier: MIT
#pragma once
// Who shares an element with whom, and the elements of a system at hand one by one: what it takes to expand the motion
// of a few particles at a cost that does not depend on how many others there are.

#include <span>
#include <vector>

#include "jetlag/model/element_blocks.hpp"
#include "jetlag/model/system.hpp"
#include "jetlag/tape/kernels.hpp"

namespace jetlag {

class Neighbourhoods {
 public:
  explicit Neighbourhoods(const System<double>& system, const KernelTable<double>& table = kernels<double>());

  int particles() const { return static_cast<int>(inverse_mass_.size()); }
  int dimension() const { return dimension_; }
  const KernelTable<double>& table() const { return table_; }

  /// 0 for fixed particles [1/kg].
  double inverse_mass(int particle) const { return inverse_mass_[particle]; }
  bool is_fixed(int particle) const { return inverse_mass_[particle] == 0; }

  /// The laws that act, each with all its elements in the order of the system, constants and parameters set.
  const std::vector<ElementBlocks<double>>& laws() const { return laws_; }

  /// The particles of all elements of a law. Shape (elements, participants).
  std::span<const int> particles_of(std::size_t law) const { return particles_[law]; }

  /// The elements of a law that a particle takes part in, ascending.
  std::span<const int> elements_of(std::size_t law, int particle) const {
    return elements_[law].of(particle);
  }

  /// The other moving particles that share an element with a moving one, ascending, each once.
  std::span<const int> neighbours(int particle) const { return neighbours_.of(particle); }

 private:
  /// A list for each particle, one after another.
  struct Lists {
    std::vector<int> first{0}, entries;
    std::span<const int> of(int particle) const {
      return {entries.data() + first[particle], entries.data() + first[particle + 1]};
    }
  };
  Lists elements_of_law(std::size_t law) const;
  Lists all_neighbours() const;

  int dimension_;
  const KernelTable<double>& table_;
  std::vector<double> inverse_mass_;
  std::vector<ElementBlocks<double>> laws_;
  std::vector<std::vector<int>> particles_;  // of each law
  std::vector<Lists> elements_;              // of each law
  Lists neighbours_;
};

}  // namespace jetlag
