// SPDX-License-Identifier: MIT
// Solids in scenes that cannot be: refused with the key and the reason.
#include <gmock/gmock.h>

#include "jetlag/scenes/error.hpp"
#include "scenes/solid_scenes.hpp"

namespace jetlag::testing::refused_solids_test {
namespace {

using solid_scenes::Json, solid_scenes::scene, solid_scenes::rubber;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A force that has no type is stvk of rubber with some keys replaced. Texts: nested braces of JSON take long to compile.
struct Refused {
  const char *name, *particles, *force, *key, *says;
  int dimension = 3;
};
void PrintTo(const Refused& scene, std::ostream* out) { *out << scene.name; }

class RefusedSolid : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedSolid, NamesKeyAndReason) {
  const Refused& p = GetParam();
  const Json given = Json::parse(p.force);
  const Json force = given.contains("type") ? given : rubber("stvk", given);
  EXPECT_THAT(([&] { scene(Json::parse(p.particles), {force}, p.dimension); }),
              ThrowsMessage<SceneError>(AllOf(HasSubstr(p.key), HasSubstr(p.says))));
}

constexpr const char* cube = R"({"box": {"lengths": [1, 1, 1], "cells": [2, 2, 2]}, "density": 960})";
constexpr const char* four = R"({"position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]})";
constexpr const char* flat = R"({"position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]})";
constexpr const char* plane = R"({"box": {"lengths": [1, 1], "cells": [1, 1]}})";

INSTANTIATE_TEST_SUITE_P(
    Scenes, RefusedSolid,
    ::testing::Values(
        Refused{"InsideOut", four, R"({"elements": [[0, 2, 1, 3]]})", "forces[0].elements[0]",
                "volume -0.166667 m^3 at rest; must be > 0: exchange two of its vertices"},
        Refused{"Flat", flat, R"({"elements": [[0, 1, 2, 3]]})", "forces[0].elements[0]", "flat at rest"},
        Refused{"VertexTwice", four, R"({"elements": [[0, 1, 1, 3]]})", "forces[0].elements[0]",
                "four different particles"},
        Refused{"NoSuchVertex", four, R"({"elements": [[0, 1, 2, 4]]})", "forces[0].elements[0][3]",
                "0 to 3"},
        Refused{"Triangle", four, R"({"elements": [[0, 1, 2]]})", "forces[0].elements[0]", "four particles"},
        Refused{"NoMesh", four, R"({})", "forces[0].elements", "a list of tetrahedra"},
        Refused{"NothingInside", cube, R"({"elements": {"inside": [[5, 5, 5], [6, 6, 6]]}})",
                "forces[0].elements", "such that there are elements"},
        Refused{"Young", cube, R"({"young": 0})", "forces[0].young: got 0", "> 0"},
        Refused{"Incompressible", cube, R"({"poisson": 0.5})", "forces[0].poisson: got 0.5",
                "0.5 is incompressible"},
        Refused{"TooFewYoung", cube, R"({"young": [1, 2]})", "forces[0].young", "48, one for each element"},
        Refused{"LameBesideYoung", cube, R"({"lame": [1, 1]})", "forces[0].lame", "beside young"},
        Refused{"UnstableLame", cube, R"({"type": "stvk", "lame": [-1, 1]})", "forces[0].lame", "-2/3"},
        Refused{"NoMaterial", cube, R"({"type": "stvk"})", "forces[0].young", "missing"},
        Refused{"Damping", cube, R"({"damping_time": -1})", "forces[0].damping_time", ">= 0"},
        Refused{"TwoViscosities", cube, R"({"damping_time": 1, "viscosity": {"shear": 1}})",
                "forces[0].viscosity", "beside damping_time"},
        Refused{"ThicknessInSpace", cube, R"({"thickness": 1})", "forces[0].thickness", "in space"},
        Refused{"PlaneStress", plane,
                R"({"type": "neo_hookean", "young": 1e5, "poisson": 0.3, "plane": "stress"})",
                "forces[0].plane", "stvk has stress", 2},
        Refused{"Thickness", plane, R"({"thickness": 0})", "forces[0].thickness", "> 0", 2},
        Refused{"OnALine", R"({"position": [[0], [1]]})", R"({})", "dimension", "2 or 3 for forces[0]", 1},
        Refused{
            "BeginsInsideOut",
            R"({"position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, -1]], "rest": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "tetrahedra": [[0, 1, 2, 3]]})",
            R"({"type": "neo_hookean", "young": 1e5, "poisson": 0.3})", "forces[0].elements, number 0",
            "use stable_neo_hookean"},
        Refused{"InnerFace", cube, R"({"type": "pressure", "faces": [[0, 13, 26]], "pressure": 1})",
                "forces[0].faces[0]", "exactly one tetrahedron"},
        Refused{"FacesWithoutBody", four, R"({"type": "pressure", "pressure": 1})", "forces[0].faces",
                "no tetrahedra"},
        Refused{"FacesInThePlane", plane, R"({"type": "traction", "stress": [1, 2, 3]})", "dimension",
                "must be 3", 2},
        Refused{"DensityOfPoints", R"({"position": [[0, 0, 0]], "density": 1})", R"({})", "particles.density",
                "mass in its place"},
        Refused{"DensityBesideMass",
                R"({"box": {"lengths": [1, 1, 1], "cells": [1, 1, 1]}, "density": 1, "mass": 1})", R"({})",
                "particles.density", "beside mass"},
        Refused{
            "LooseVertex",
            R"({"position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [5, 5, 5]], "tetrahedra": [[0, 1, 2, 3]], "density": 1})",
            R"({})", "particles.density: gives particle 4 a mass of 0 kg", "in no element"},
        Refused{"RestOfOthers", R"({"box": {"lengths": [1, 1, 1], "cells": [1, 1, 1]}, "rest": [[0, 0, 0]]})",
                R"({})", "particles.rest", "as many positions as particles, 8"},
        Refused{"Lengths", R"({"box": {"lengths": [1, 0, 1], "cells": [1, 1, 1]}})", R"({})",
                "particles.box.lengths[1]", "> 0"},
        Refused{"Cells", R"({"box": {"lengths": [1, 1, 1], "cells": [1, 1]}})", R"({})",
                "particles.box.cells", "3 numbers"},
        Refused{"TooManyCells", R"({"box": {"lengths": [1, 1, 1], "cells": [1000, 1000, 1000]}})", R"({})",
                "particles.box.cells", "at most"},
        Refused{"FixAxis", R"({"box": {"lengths": [1, 1], "cells": [1, 1]}, "fix_axis": "z"})", R"({})",
                "particles.fix_axis", "x", 2},
        Refused{"DragTwice", cube, R"({"type": "drag", "rate": 1, "coefficient": 1})", "forces[0].rate",
                "beside coefficient"},
        Refused{"ElementTwice", four, R"({"elements": [[0, 1, 2, 3], [1, 2, 0, 3]]})",
                "forces[0].elements[1]", "of number 0"},
        Refused{
            "CellTwice",
            R"({"position": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "tetrahedra": [[0, 1, 2, 3], [0, 1, 2, 3]]})",
            "{}", "particles.tetrahedra[1]", "listed once"},
        Refused{"FaceTwice", cube, R"({"type": "pressure", "faces": [[0, 1, 4], [1, 0, 4]], "pressure": 1})",
                "forces[0].faces[1]", "the same particles as of number 0"},
        Refused{"NoElements", cube, R"({"elements": []})", "forces[0].elements",
                "such that there are elements"},
        Refused{"ElementsOfNoKind", cube, R"({"elements": 3})", "forces[0].elements",
                "inside or outside, or a list"},
        Refused{"CornersExchanged", cube, R"({"elements": {"outside": [[1, 1, 1], [0, 0, 0]]}})",
                "forces[0].elements.outside", "lowest first"},
        Refused{"ThicknessOfABody",
                R"({"box": {"lengths": [1, 1, 1], "cells": [1, 1, 1]}, "density": 1, "thickness": 1})", "{}",
                "particles.thickness", "no triangles"},
        Refused{"ThicknessBesideMass",
                R"({"box": {"lengths": [1, 1], "cells": [1, 1]}, "mass": 1, "thickness": 1})", "{}",
                "particles.thickness", "where density is", 2},
        Refused{"NoPositions", R"({"position": [], "tetrahedra": [[0, 1, 2, 3]]})", "{}",
                "particles.position", "at least one"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace jetlag::testing::refused_solids_test
