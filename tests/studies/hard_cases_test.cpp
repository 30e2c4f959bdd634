// SPDX-License-Identifier: MIT
// The hard cases end where multiprecision arithmetic says, and a method that cannot do one says so.

#include "studies/comparison/hard_cases.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "scenes/parts.hpp"

namespace jetlag::testing::hard_cases_test {
namespace {

using ::testing::HasSubstr;
using Verdict = HardResult::Verdict;

problems::Problem hard_case(const std::string& name) {
  for (problems::Problem& hard : problems::hard_cases())
    if (hard.name.starts_with(name)) return std::move(hard);
  throw std::out_of_range(name);
}
HardMethod hard_method(const std::string& name) {
  for (HardMethod& method : hard_methods())
    if (method.name.starts_with(name)) return std::move(method);
  throw std::out_of_range(name);
}
HardResult result(const std::string& name, const std::string& method, double evaluations = 2e4) {
  return run_hard_case(hard_case(name), hard_method(method), evaluations, 10);
}

TEST(HardCases, AreKnownFromOneToEleven) {
  std::vector<int> counts(12, 0);
  for (const problems::Problem& hard : problems::hard_cases()) ++counts.at(std::stoi(hard.name.substr(1)));
  for (int h = 1; h <= 11; ++h) EXPECT_GT(counts[h], 0) << 'H' << h;
}

TEST(HardCases, AreGivenToEveryMethod) {
  std::set<std::string> given;
  for (const HardMethod& method : hard_methods()) given.insert(method.integrator.at("type"));
  for (const std::string& type : integrator_types())
    EXPECT_TRUE(given.contains(type))
        << type << ": add it to hard_methods() in src/studies/comparison/hard_methods.cpp";
}

TEST(HardCases, EndWhereTaylorSeriesOfDegreeTwentyEnd) {
  // Rounding of 1e-16 grows with the distance of neighbouring motions: 1e5 times for most, 1e8 times for three bodies
  // that meet at 4e-4 (measured: 3e-9). A wrong digit or a wrong law is larger by far.
  for (const problems::Problem& hard : problems::hard_cases()) {
    const HardResult taylor = run_hard_case(hard, hard_method("taylor 20, jorba_zou"), 1, 10);
    EXPECT_EQ(taylor.verdict, Verdict::accurate) << hard.name << taylor.message;
    EXPECT_LT(taylor.error, hard.name.starts_with("H2") ? 1e-7 : 1e-9) << hard.name;
  }
}

TEST(HardCases, TellMethodsApart) {
  EXPECT_EQ(result("H6", "euler").verdict, Verdict::failed);  // h omega = .5: grows beyond the doubles
  EXPECT_EQ(result("H3 masses", "taylor 8").verdict, Verdict::failed);  // h omega = 50: beyond its limit
  EXPECT_EQ(result("H4", "dop853").verdict, Verdict::accurate);
  EXPECT_EQ(result("H1 planet, e = 0.99", "leapfrog", 1000).verdict, Verdict::wrong);  // 62 steps a period
}

TEST(HardCases, AreRefusedWithTheReason) {
  const HardResult avi = result("H7", "avi");
  EXPECT_EQ(avi.verdict, Verdict::refused);
  EXPECT_THAT(avi.message, HasSubstr("depends on velocities"));
  EXPECT_TRUE(std::isnan(avi.error));
}

TEST(HardCases, StopWhatTakesTooLong) {
  const HardResult slow = run_hard_case(hard_case("H6"), hard_method("qss1"), 1, 1e-3);
  EXPECT_EQ(slow.verdict, Verdict::slow);
  EXPECT_TRUE(std::isnan(slow.error));
}

TEST(HardCases, SpendWhatTheyMay) {
  // A fixed step is `until` over a whole number, so that no more than the evaluations allowed are spent.
  for (const char* method : {"leapfrog", "rk4", "taylor 8"}) {
    const double spent = result("H8", method, 5e3).evaluations;
    EXPECT_LE(spent, 5e3 * 1.001 + 1) << method;
    EXPECT_GT(spent, 4.9e3) << method;
  }
}

}  // namespace
}  // namespace jetlag::testing::hard_cases_test
