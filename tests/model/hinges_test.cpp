// SPDX-License-Identifier: MIT
#include "jetlag/model/hinges.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace jetlag::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;
using Triangles = std::vector<std::array<int, 3>>;

TEST(Hinges, AreTheInnerEdgesWithTheVerticesOppositeToThem) {
  EXPECT_THAT(hinges_of({{0, 1, 2}}), IsEmpty());
  //  2---3---5     (0, 1, 2) is passed round from 1 to 2, (1, 3, 2) from 2 to 1
  //   0---1---4
  EXPECT_THAT(hinges_of({{0, 1, 2}, {1, 3, 2}, {4, 3, 1}, {4, 5, 3}}),
              ElementsAre(std::array{1, 2, 0, 3}, std::array{1, 3, 2, 4}, std::array{3, 4, 5, 1}));
  EXPECT_THAT(hinges_of({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}).size(), 6u);  // a closed surface
}

TEST(Hinges, AreRefusedWhereThreeTrianglesMeet) {
  const Triangles book{{0, 1, 2}, {4, 9, 0}, {5, 6, 7}, {9, 4, 1}, {4, 9, 8}};
  EXPECT_THAT([&] { hinges_of(book); },
              ThrowsMessage<std::invalid_argument>(
                  "edge 4-9 belongs to triangles 1, 3, 4: a surface has at most two there"));
}

TEST(Hinges, AreRefusedOfTrianglesThatDisagree) {
  const Triangles flipped{{0, 1, 2}, {1, 2, 3}};
  EXPECT_THAT([&] { hinges_of(flipped); },
              ThrowsMessage<std::invalid_argument>("triangles 0 and 1 disagree in orientation at edge 1-2: "
                                                   "exchange two vertices of one of them"));
  for (const std::array<int, 3>& bad : {std::array{0, 1, 0}, std::array{0, 1, -1}})
    EXPECT_THAT([&] { hinges_of({bad}); },
                ThrowsMessage<std::invalid_argument>("triangle 0: needs three different vertices, all >= 0"));
}

}  // namespace
}  // namespace jetlag::testing
