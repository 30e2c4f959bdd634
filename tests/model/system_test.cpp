// SPDX-License-Identifier: MIT
// What a system accepts, what it makes of it, and what it refuses by name.

#include "jetlag/model/system.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/forces/drag.hpp"
#include "jetlag/forces/spring.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

auto refused(const char* who, const char* what) {
  return ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(who), HasSubstr(what)));
}

TEST(System, RefusesDimensionsOtherThanOneToThree) {
  EXPECT_THAT([] { System<>(0, {1.0}); }, refused("dimension", "got 0"));
  EXPECT_THAT([] { System<>(4, {1.0}); }, refused("dimension", "got 4"));
}

TEST(System, RefusesMassesThatAreNotPositiveAndFinite) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (double mass : {0.0, -1.0, inf, nan}) {
    EXPECT_THAT([mass] { System<>(3, {1.0, 1.0, mass}); }, refused("mass of particle 2", "> 0 and finite"));
  }
}

TEST(System, RefusesToFixWhatDoesNotExist) {
  System<> system(1, {1.0, 1.0});
  EXPECT_THAT([&] { system.fix(2); }, refused("fixed particle 2", "there are 2"));
  EXPECT_THAT([&] { system.fix(-1); }, refused("fixed particle -1", "there are 2"));
  system.fix(1);
  EXPECT_THAT(system.fixed(), ElementsAre(false, true));
}

TEST(System, RefusesElementsOnParticlesThatDoNotExist) {
  System<> system(2, {1.0, 1.0});
  EXPECT_THAT([&] { system.add<Spring>({{0, 1}, {1, 2}}, {{1.0, 1.0}}); }, refused("spring 1", "particle 2"));
  EXPECT_THAT([&] { system.add<Spring>({{-1, 0}}, {{1.0, 1.0}}); }, refused("spring 0", "particle -1"));
  EXPECT_THAT([&] { system.add<Drag>({{5}}, {{1.0}}); }, refused("drag 0", "particle 5"));
  EXPECT_TRUE(system.elements().empty());
}

TEST(System, RefusesAParticlePairedWithItself) {
  System<> system(2, {1.0, 1.0});
  EXPECT_THAT([&] { system.add<Spring>({{0, 1}, {1, 1}}, {{1.0, 1.0}}); }, refused("spring 1", "itself"));
}

TEST(System, RefusesANumberOfParametersThatDoesNotFit) {
  System<> system(2, {1.0, 1.0, 1.0});
  EXPECT_THAT([&] { system.add<Spring>({{0, 1}, {1, 2}, {0, 2}}, {{1.0, 1.0}, {2.0, 1.0}}); },
              refused("spring", "2 parameters are needed for each of 3 elements"));
  EXPECT_THAT([&] { system.add(record_law<Spring>(2), {0, 1, 2}, {1.0, 1.0}); },
              refused("spring", "2 particles"));
}

TEST(System, RefusesALawOfAnotherDimension) {
  System<> system(2, {1.0, 1.0});
  EXPECT_THAT([&] { system.add(record_law<Spring>(3), {0, 1}, {1.0, 1.0}); },
              refused("spring", "dimension 3"));
}

TEST(System, RepeatsOneSetOfParametersForAllElements) {
  System<> system(2, {1.0, 2.0, 3.0});
  system.add<Spring>({{0, 1}, {1, 2}}, {{5.0, 0.5}});
  ASSERT_EQ(system.elements().size(), 1u);
  EXPECT_EQ(system.elements()[0].count(), 2u);
  EXPECT_THAT(system.elements()[0].particles, ElementsAre(0, 1, 1, 2));
  EXPECT_THAT(system.elements()[0].parameters, ElementsAre(5.0, 0.5, 5.0, 0.5));
}

TEST(System, KeepsOneSetOfParametersForEachElement) {
  System<> system(1, {1.0, 2.0, 3.0});
  system.add<Spring>({{0, 1}, {1, 2}}, {{5.0, 0.5}, {6.0, 0.25}});
  EXPECT_THAT(system.elements()[0].parameters, ElementsAre(5.0, 0.5, 6.0, 0.25));
}

TEST(System, MayHaveNoElementsOfALaw) {
  System<> system(1, {1.0});
  system.add<Spring>({}, {{5.0, 0.5}});
  EXPECT_EQ(system.elements()[0].count(), 0u);
}

TEST(Outcome, HasTheNameOfTheSummary) {
  EXPECT_STREQ(to_string(Outcome::success), "success");
  EXPECT_STREQ(to_string(Outcome::step_underflow), "step_underflow");
  EXPECT_STREQ(to_string(Outcome::non_finite), "non_finite");
  EXPECT_STREQ(to_string(Outcome::step_limit), "step_limit");
  EXPECT_STREQ(to_string(Outcome::interrupted), "interrupted");
}

}  // namespace
}  // namespace jetlag::testing
