// SPDX-License-Identifier: MIT
// Forces where particles meet: springs of rest length 0 and softened gravity, as scenes have them.
#include <gmock/gmock.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <sstream>

#include "jetlag/runs/run_scene.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/scene.hpp"

namespace jetlag::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Scene scene(const std::string& particles, const std::string& forces, const std::string& until = "1") {
  return read_scene(
      R"({"dimension": 2, "particles": )" + particles + R"(, "forces": [)" + forces +
          R"(], "integrator": {"type": "taylor", "degree": 20}, "control": {"type": "jorba_zou"},
                        "until": )" +
          until + R"(, "output": {"frames": 1, "pictures": false}})",
      "test", ".");
}

State<double> end_of(const Scene& scene) {
  const RunResult result = run_scene(scene);
  EXPECT_EQ(result.summary.outcome, Outcome::success) << result.summary.message;
  return {result.summary.time, result.summary.position, result.summary.velocity};
}

TEST(SpringOfRestLengthZero, StartsWhereItsEndsCoincide) {  // x = sin t; at rest it stays
  const std::string spring = R"({"type": "spring", "pairs": [[0, 1]], "stiffness": 1, "rest_length": 0})";
  const auto particles = [](const std::string& v) {
    return R"({"position": [[0, 0], [0, 0]], "velocity": [[0, 0], [)" + v +
           R"(, 0]], "mass": 1, "fixed": [0]})";
  };
  const State<double> moved = end_of(scene(particles("1"), spring));
  EXPECT_NEAR(moved.position(1, 0), std::sin(1.0),
              4e-16);  // degree 20 leaves 1/21!; some roundings of numbers below 1
  EXPECT_NEAR(moved.velocity(1, 0), std::cos(1.0), 4e-16);
  EXPECT_EQ(end_of(scene(particles("0"), spring)).position, Coordinates<double>::Zero(2, 2));
}

TEST(SpringOfRestLengthZero,
     PassesThroughItsOtherEnd) {  // x = cos t, straight through 0: after pi on the other side
  const State<double> end = end_of(scene(
      R"({"position": [[0, 0], [1, 0]], "mass": 1, "fixed": [0]})",
      R"({"type": "spring", "pairs": [[0, 1]], "stiffness": 1, "rest_length": 0})", "3.141592653589793"));
  EXPECT_NEAR(end.position(1, 0), -1, 1e-14);  // some steps, each to 1e-16 and some roundings
  EXPECT_NEAR(end.velocity(1, 0), 0, 1e-14);
}

TEST(SpringOfRestLengthZero, StandsBesideOthersWhichAreAsTheyWere) {
  const std::string particles = R"({"position": [[0, 0], [1, 0], [5, 5], [7, 5]], "mass": 1})";
  const auto springs = [](const std::string& pairs, const std::string& more) {
    return R"({"type": "spring", "pairs": )" + pairs + R"(, "stiffness": )" + more + "}";
  };
  const Scene both = scene(particles, springs("[[2, 3], [0, 1]]", R"([2, 3], "rest_length": [0.0, 1.5])"));
  ASSERT_EQ(both.system->elements().size(), 2u);
  EXPECT_EQ(both.system->elements()[0].law.name, "spring");
  EXPECT_EQ(both.system->elements()[0].count(), 1u);
  EXPECT_EQ(both.shape.lines.size(), 2u);
  const std::string fixed = R"({"position": [[0, 0], [1, 0], [5, 5], [7, 5]], "mass": 1, "fixed": [2, 3]})";
  const std::string alone = springs("[[0, 1]]", R"(3, "rest_length": 1.5)");
  EXPECT_EQ(end_of(scene(fixed, alone + ", " + springs("[[2, 3]]", R"(2, "rest_length": 0)"))).position,
            end_of(scene(fixed, alone)).position);
  // d = 2 cos wt, w^2 = 2 k
  const State<double> end = end_of(both);
  EXPECT_NEAR(end.position(3, 0) - end.position(2, 0), 2 * std::cos(2.0), 1e-14);
}

TEST(SpringOfSomeLength, IsRefusedWhereItsEndsCoincide) {
  const std::string particles = R"({"position": [[0, 0], [0, 0]], "mass": 1})";
  for (const std::string length : {"1", "\"initial\""})
    EXPECT_THAT(
        ([&] {
          scene(particles,
                R"({"type": "spring", "pairs": [[0, 1]], "stiffness": 1, "rest_length": )" + length + "}");
        }),
        ThrowsMessage<SceneError>(
            AllOf(HasSubstr("forces[0].pairs[0]"), HasSubstr("same place"), HasSubstr("rest_length 0"))));
}

/// Two masses of 1/2 let go at distance 2 a fall through each other to the other side: with G = 1 the distance r obeys
/// r'^2 / 2 = 1/s(r) - 1/s(2a), s(r) = sqrt(r^2 + e^2), so half a period takes  2 int_0^{2a} dr / r'.
TEST(SoftenedGravity, FallsThroughAndComesOutInTheTimeOfTheIntegral) {
  const double e = 0.25, start = 1.0;
  const auto s = [e](double r) { return std::sqrt(r * r + e * e); };
  // r = start sin u takes the root at the end away: 1/s - 1/s_0 = (r_0^2 - r^2) / (s s_0 (s + s_0)).
  const double s0 = s(start);
  const auto slowness = [&](double u) {
    const double of = s(start * std::sin(u));
    return std::sqrt(of * s0 * (of + s0) / 2);
  };
  boost::math::quadrature::tanh_sinh<double> integral;
  const double half = 2 * integral.integrate(slowness, 0.0, boost::math::constants::half_pi<double>());
  std::ostringstream until;
  until.precision(17);
  until << half;
  const Scene falls = scene(R"({"position": [[0, 0], [1, 0]], "mass": 0.5})",
                            R"({"type": "gravity", "softening": 0.25})", until.str());
  const State<double> end = end_of(falls);
  // At rest again, places exchanged; steps to 1e-16 each, the integral to some 1e-15, where r'' = 0.9.
  EXPECT_NEAR(end.position(0, 0), 1, 1e-13);
  EXPECT_NEAR(end.position(1, 0), 0, 1e-13);
  EXPECT_NEAR(end.velocity(1, 0), 0, 1e-13);
}

TEST(SoftenedGravity, LetsParticlesStartInTheSamePlace) {
  const State<double> end = end_of(
      scene(R"({"position": [[1, 2], [1, 2]], "mass": 1})", R"({"type": "gravity", "softening": 0.1})"));
  EXPECT_EQ(end.position, (Coordinates<double>(2, 2) << 1, 2, 1, 2).finished());
}

TEST(SoftenedGravity, OfNothingIsGravity) {
  const auto with = [](const std::string& keys) {
    return scene(R"({"position": [[0, 0], [1, 0.5], [-1, 2]], "mass": [1, 2, 3]})",
                 R"({"type": "gravity")" + keys + "}");
  };
  const Scene without = with("");
  EXPECT_EQ(without.system->elements()[0].law.name, "gravity");
  EXPECT_THAT(without.json, HasSubstr("\"softening\": 0.0"));
  for (const std::string none : {", \"softening\": 0", ", \"softening\": -0.0"}) {
    EXPECT_EQ(with(none).system->elements()[0].law.name, "gravity");
    EXPECT_EQ(end_of(with(none)).position, end_of(without).position);
  }
  EXPECT_NE(end_of(with(", \"softening\": 0.1")).position, end_of(without).position);
}

}  // namespace
}  // namespace jetlag::testing
