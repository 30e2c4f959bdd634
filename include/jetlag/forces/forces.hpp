// SPDX-License-Identifier: MIT
#pragma once
// The register of force laws: to add a law, write its file and add its line here.

#include <type_traits>

#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/floor.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"

namespace jetlag {

template <ForceLaw... L>
struct LawList {
  /// f(std::type_identity<L>{}) for each law.
  template <class F>
  static void for_each(F f) {
    (f(std::type_identity<L>{}), ...);
  }
};

using Forces = LawList<Spring,        //
                       UniformField,  //
                       Drag,          //
                       Gravity,       //
                       Floor,         //
                       QuadraticFloor>;

}  // namespace jetlag
