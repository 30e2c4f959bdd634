// SPDX-License-Identifier: MIT
#include "jetlag/model/neighbourhoods.hpp"

#include <algorithm>

namespace jetlag {

Neighbourhoods::Neighbourhoods(const System<double>& system, const KernelTable<double>& table)
    : dimension_(system.dimension()), table_(table) {
  for (int i = 0; i < system.particles(); ++i)
    inverse_mass_.push_back(system.fixed()[i] ? 0.0 : 1.0 / system.mass()[i]);
  for (const Elements<double>& elements : system.elements()) {
    if (elements.count() == 0) continue;
    laws_.emplace_back(system, elements, elements.law.force, table);
    particles_.push_back(elements.particles);
  }
  for (std::size_t law = 0; law < laws_.size(); ++law) elements_.push_back(elements_of_law(law));
  neighbours_ = all_neighbours();
}

Neighbourhoods::Lists Neighbourhoods::elements_of_law(std::size_t law) const {
  const auto& members = particles_[law];
  Lists lists;
  lists.first.assign(particles() + 1, 0);
  for (int i : members) ++lists.first[i + 1];
  for (int i = 0; i < particles(); ++i) lists.first[i + 1] += lists.first[i];
  lists.entries.resize(members.size());
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  for (std::size_t m = 0; m < members.size(); ++m)
    lists.entries[next[members[m]]++] = static_cast<int>(m / laws_[law].participants());
  return lists;
}

Neighbourhoods::Lists Neighbourhoods::all_neighbours() const {
  Lists lists;
  std::vector<int> found;
  for (int i = 0; i < particles(); ++i) {
    found.clear();
    for (std::size_t law = 0; law < laws_.size() && !is_fixed(i); ++law)
      for (int e : elements_of(law, i))
        for (int p = 0; p < laws_[law].participants(); ++p)
          if (const int other = particles_[law][e * laws_[law].participants() + p];
              other != i && !is_fixed(other))
            found.push_back(other);
    std::ranges::sort(found);
    found.erase(std::ranges::unique(found).begin(), found.end());
    lists.entries.insert(lists.entries.end(), found.begin(), found.end());
    lists.first.push_back(static_cast<int>(lists.entries.size()));
  }
  return lists;
}

}  // namespace jetlag
