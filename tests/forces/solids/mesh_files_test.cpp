// SPDX-License-Identifier: MIT
// Solids on meshes of other programs. Where the meshes are not there, nothing is tested.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "forces/solids/bodies.hpp"
#include "forces/solids/vibrations.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag::testing::mesh_files_test {
namespace {

using namespace solids;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct File {
  std::string name;
  double volume, omega;  // [m^3]; [1/s], of the lowest mode that is not rigid
};

class SolidsOfFiles : public ::testing::Test {
 protected:
  const std::filesystem::path meshes = std::filesystem::path(JETLAG_SHARED_DIR) / "meshes";
  void SetUp() override {
    if (!std::filesystem::exists(meshes)) GTEST_SKIP() << "no " << meshes;
  }
  Scene scene_of(const std::string& file) const {
    return load_scene("spinning_bar", {"particles={\"mesh\": \"" + (meshes / file).string() +
                                       "\", \"density\": 1000, \"velocity\": [0, 0, 0]}"});
  }
};

TEST_F(SolidsOfFiles, HaveTheirVolumeAndVibrate) {
  for (const File& file :
       {File{"torus.mesh", 0.568944883, 9.213800}, File{"ball.mesh", 3.940972644, 15.597899}}) {
    SCOPED_TRACE(file.name);
    const Scene scene = scene_of(file.name);
    EXPECT_THAT(scene.warnings, IsEmpty());
    double mass = 0;
    for (const double m : scene.system->mass()) mass += m;
    EXPECT_NEAR(mass / density, file.volume, 1e-9);
    // Seven digits are known; a shift as near as that finds the mode in two steps.
    const Vibrations body(*scene.system, scene.initial);
    const double beside = std::pow((1 - 1e-6) * file.omega, 2);
    EXPECT_NEAR(std::sqrt(body.square_beside(beside, 3, body.mixture())), file.omega, 1e-6 * file.omega);
  }
}

TEST_F(SolidsOfFiles, WarnOfTheirSlivers) {  // two tetrahedra of height 1e-10 m
  EXPECT_THAT(scene_of("beam-tet-sliver.mesh").warnings,
              ElementsAre(AllOf(HasSubstr("forces[0].elements"), HasSubstr("the worst of 2 slivers"))));
}

}  // namespace
}  // namespace jetlag::testing::mesh_files_test
