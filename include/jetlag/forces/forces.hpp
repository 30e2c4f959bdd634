// SPDX-License-Identifier: MIT
#pragma once
// The register of force laws: to add a law, write its file and add its line here.

#include <type_traits>

#include "jetlag/forces/cloth/bending.hpp"
#include "jetlag/forces/cloth/hinge.hpp"
#include "jetlag/forces/cloth/membrane.hpp"
#include "jetlag/forces/contact/barrier.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/floor.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/forces/molecular/angle.hpp"
#include "jetlag/forces/molecular/dihedral.hpp"
#include "jetlag/forces/oscillating_field.hpp"
#include "jetlag/forces/softened_gravity.hpp"
#include "jetlag/forces/solids/corotated.hpp"
#include "jetlag/forces/solids/kelvin_voigt.hpp"
#include "jetlag/forces/solids/neo_hookean.hpp"
#include "jetlag/forces/solids/pressure.hpp"
#include "jetlag/forces/solids/stable_neo_hookean.hpp"
#include "jetlag/forces/solids/stvk.hpp"
#include "jetlag/forces/solids/traction.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "jetlag/forces/zero_length_spring.hpp"

namespace jetlag {

template <ForceLaw... L>
struct LawList {
  /// f(std::type_identity<L>{}) for each law.
  template <class F>
  static void for_each(F f) {
    (f(std::type_identity<L>{}), ...);
  }
};

using Forces = LawList<Spring,            //
                       ZeroLengthSpring,  //
                       UniformField,      //
                       OscillatingField,  //
                       Drag,              //
                       Gravity,           //
                       SoftenedGravity,   //
                       Floor,             //
                       QuadraticFloor,    //
                       // solids
                       NeoHookean, PlaneNeoHookean,                      //
                       StableNeoHookean, PlaneStableNeoHookean,          //
                       PolynomialNeoHookean, PlanePolynomialNeoHookean,  //
                       Stvk, PlaneStvk,                                  //
                       Corotated, PlaneCorotated,                        //
                       KelvinVoigt, PlaneKelvinVoigt,                    //
                       Pressure, Traction,                               //
                       // cloth
                       Membrane, MembraneKelvinVoigt,  //
                       Bending, Hinge,                 //
                       // molecules
                       Angle, Dihedral<1>, Dihedral<2>, Dihedral<3>,  //
                       // contact; their logarithms, for comparison, are not in it
                       BarrierVertexVertex, BarrierVertexEdge, BarrierVertexFace, BarrierEdgeEdge,
                       BarrierMollifiedEdgeEdge>;

}  // namespace jetlag
