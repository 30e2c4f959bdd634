// SPDX-License-Identifier: MIT
#include "jetlag/contact/surface.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace jetlag::testing::surface_test {
namespace {

using ::testing::ElementsAre;
using Edge = std::array<int, 2>;
using Triangle = std::array<int, 3>;

TEST(Surface, HasEdgesAndVerticesOfItsTrianglesOnce) {
  const Surface square({{3, 1, 0}, {0, 3, 2}}, {}, {});
  EXPECT_THAT(square.triangles(), ElementsAre(Triangle{0, 1, 3}, Triangle{0, 2, 3}));
  EXPECT_THAT(square.edges(), ElementsAre(Edge{0, 1}, Edge{0, 2}, Edge{0, 3}, Edge{1, 3}, Edge{2, 3}));
  EXPECT_THAT(square.vertices(), ElementsAre(0, 1, 2, 3));
  EXPECT_TRUE(square.loose_edges().empty());
  EXPECT_TRUE(square.loose_vertices().empty());
}

TEST(Surface, KnowsWhatBelongsToNothingLarger) {
  const Surface mixed({{0, 1, 2}}, {{2, 3}, {1, 0}}, {7, 3});
  EXPECT_THAT(mixed.loose_edges(), ElementsAre(Edge{2, 3}));
  EXPECT_THAT(mixed.loose_vertices(), ElementsAre(7));
  EXPECT_THAT(mixed.vertices(), ElementsAre(0, 1, 2, 3, 7));
}

TEST(Surface, TakesAnother) {
  Surface both({}, {{0, 1}}, {5});
  both += Surface({{0, 1, 5}}, {}, {6});
  EXPECT_TRUE(both.loose_edges().empty());
  EXPECT_THAT(both.loose_vertices(), ElementsAre(6));
}

TEST(Surface, RefusesWhatNamesAParticleTwiceOrIsListedTwice) {
  EXPECT_THROW(Surface({{0, 1, 0}}, {}, {}), std::invalid_argument);
  EXPECT_THROW(Surface({}, {{4, 4}}, {}), std::invalid_argument);
  EXPECT_THROW(Surface({{0, 1, 2}, {2, 0, 1}}, {}, {}), std::invalid_argument);
  EXPECT_THROW(Surface({}, {{0, 1}, {1, 0}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace jetlag::testing::surface_test
