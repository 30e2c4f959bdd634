// SPDX-License-Identifier: MIT
#include "jetlag/output/output_options.hpp"

#include <gmock/gmock.h>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag {
namespace {

using testing::HasSubstr;

TEST(OutputOptions, AreKeysOfAScene) {
  for (const OutputKey& key : output_keys)
    for (const bool asked : {false, true}) {
      const std::string value = asked ? "true" : "false";
      const Scene scene = load_scene("chain", {"output." + std::string(key.name) + "=" + value});
      EXPECT_EQ(scene.output.*key.asked, asked) << key.name;
      EXPECT_THAT(scene.json, HasSubstr('"' + std::string(key.name) + "\": " + value));
    }
  EXPECT_THROW(load_scene("chain", {"output.energies=true"}), SceneError);
}

TEST(OutputOptions, OfASceneThatNamesNoneAreThoseOfTheProgram) {
  const OutputOptions of_scene = load_scene("chain", {"output={}"}).output, own;
  EXPECT_EQ(of_scene.frames, own.frames);
  for (const OutputKey& key : output_keys) EXPECT_EQ(of_scene.*key.asked, own.*key.asked) << key.name;
}

}  // namespace
}  // namespace jetlag
