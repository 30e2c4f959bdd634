// SPDX-License-Identifier: MIT
#pragma once
// What laws say of their elements by the parameters alone.

#include "jetlag/model/model.hpp"

namespace jetlag {

/// f(particles, value) for each element whose law has this function of its parameters.
template <class F>
void for_each_with(const Model<double>& model, RecordedLaw::OfParameters RecordedLaw::* function, F use) {
  for (const auto& law : model.laws()) {
    const auto& [recorded, particles, parameters] = law->elements();
    if (recorded.*function == nullptr) continue;
    for (const int e : law->all())
      use(law->particles_of(e), (recorded.*function)(parameters.data() + e * recorded.parameters.size()));
  }
}

}  // namespace jetlag
