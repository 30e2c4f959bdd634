// SPDX-License-Identifier: MIT
// Clocks of a run: what the table keeps of long ones, and what the picture shows.
#include "jetlag/output/clock_table.hpp"

#include <gmock/gmock.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <functional>
#include <set>

#include "jetlag/output/files.hpp"
#include "jetlag/pictures/pictures.hpp"
#include "output/scratch.hpp"

namespace jetlag::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;

using ClocksOfARun = Scratch;
using Tree = boost::property_tree::ptree;

TEST_F(ClocksOfARun, AreATableOfUpdates) {
  ClockTable clocks({false, true, false});
  clocks.add({0, 0.0, 0.5, 3});
  clocks.add({1, 0.0, 0.5, 3});  // fixed
  clocks.add({2, 0.0, 0.1, 6});
  clocks.add({2, 0.1, 1.0 / 3.0, 4});
  write_clocks_csv(folder / "clocks.csv", clocks);
  EXPECT_EQ(read_file(folder / "clocks.csv"),
            "particle,time,step,degree\n0,0,0.5,3\n2,0,0.1,6\n2,0.1,0.3333333333333333,4\n");
  EXPECT_THAT(clocks.step(), ElementsAre(0.5, 0.0, 1.0 / 3.0));
  EXPECT_THAT(clocks.degree(), ElementsAre(3, 0, 4));
}

TEST_F(ClocksOfARun, KeepEverySecondFourthEighthUpdateOfEachParticleInLongRuns) {
  // Particle 0 is updated three times as often as particle 1: both are thinned alike, and none of both is lost.
  ClockTable clocks({false, false});
  constexpr int n = 450'000;
  for (int k = 0; k < n; ++k) {
    clocks.add({0, 1.0 * k, 1.0, 3});
    if (k % 3 == 0) clocks.add({1, 1.0 * k, 3.0, 3});
  }
  EXPECT_EQ(clocks.stride(), 8u);  // 600000 / 4 is more than 100000
  EXPECT_THAT(clocks.rows().size(), Le(ClockTable::most_rows));
  double next[] = {0, 0};
  for (const Update& row : clocks.rows()) {
    EXPECT_EQ(row.begin, next[row.particle]);
    next[row.particle] += 8 * row.step;
  }
  EXPECT_THAT(next[0], Ge(n));
  EXPECT_THAT(next[1], Ge(n));
}

TEST_F(ClocksOfARun, AreDrawnAsABarForEachStepColouredByItsLength) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  ClockTable clocks({false, true, false});
  clocks.add({0, 0.0, 4.0, 3});
  clocks.add({0, 4.0, 4.0, 3});
  for (int k = 0; k < 16; ++k) clocks.add({2, 0.5 * k, 0.5, 3});
  draw_clocks(folder / "clocks.svg", clocks, 8.0, "two clocks");
  Tree tree;
  boost::property_tree::read_xml((folder / "clocks.svg").string(), tree);
  std::multiset<std::string> fills;
  std::string texts;
  const std::function<void(const Tree&)> visit = [&](const Tree& part) {
    for (const auto& [name, child] : part) {
      if (name == "polygon") fills.insert(child.get<std::string>("<xmlattr>.fill"));
      if (name == "text") texts += child.data() + "\n";
      visit(child);
    }
  };
  visit(tree.get_child("svg"));
  EXPECT_EQ(fills.count("rgb( 68, 119, 170)"), 2u);   // cool: the longest
  EXPECT_EQ(fills.count("rgb(192,  48,  43)"), 16u);  // warm: the shortest
  for (const char* text : {"two clocks", "particle", "time", "0.5 s", "4 s"})
    EXPECT_THAT(texts, HasSubstr(text));
}

}  // namespace
}  // namespace jetlag::testing
