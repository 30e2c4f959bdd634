// SPDX-License-Identifier: MIT
#include "jetlag/contact/contact_meter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/forces/uniform_field.hpp"

namespace jetlag::testing::contact_meter_test {
namespace {

constexpr double stiffness = 1000, thickness = 0.1, xi = 0.02;

/// f = d kappa / 4 (1 - w)^2 w^-q (3 + q (1 - w) / w),  w = (d^2 - xi^2) / D,  D = dh^2 + 2 xi dh, q = 7.
double force_at(double d) {
  const double w = (d * d - xi * xi) / (thickness * thickness + 2 * xi * thickness);
  return d * stiffness / 4 * std::pow(1 - w, 2) * std::pow(w, -7) * (3 + 7 * (1 - w) / w);
}

/// A point above a place of a fixed triangle, a third one far away; all fall.
struct Scene {
  Coordinates<double> x{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0.08}, {9, 9, 9}};
  System<double> system{3, {1.0, 1.0, 1.0, 1.0, 1.0}};
  Scene() {
    for (int i = 0; i < 3; ++i) system.fix(i);
    system.add<UniformField>({{3}, {4}}, {{0.0, 0.0, -9.8}});
    add(system, ContactBarrier{.surface = Surface({{0, 1, 2}}, {}, {3, 4}),
                               .rest = x,
                               .thickness = thickness,
                               .stiffness = stiffness,
                               .gap = xi});
  }
};

TEST(ContactMeter, TellsForceAndGapOfEachParticle) {
  Scene scene;
  ContactMeter meter(scene.system);
  meter.measure({0.0, scene.x, Coordinates<double>::Zero(5, 3)});
  const double f = force_at(0.08);
  EXPECT_NEAR(meter.force()(3, 2), f, 1e-13 * f);
  EXPECT_NEAR(meter.force()(0, 2), -f / 2, 1e-13 * f);  // by the weights of the place, 1/2, 1/4, 1/4
  EXPECT_NEAR(meter.force()(1, 2), -f / 4, 1e-13 * f);
  EXPECT_NEAR(meter.force()(2, 2), -f / 4, 1e-13 * f);
  EXPECT_NEAR(meter.gap()[3], 0.06, 1e-16);
  EXPECT_NEAR(meter.gap()[0], 0.06, 1e-16);
  EXPECT_EQ(meter.force().row(4).norm(), 0);  // without what is no contact
  EXPECT_EQ(meter.gap()[4], std::numeric_limits<double>::infinity());
}

TEST(ContactMeter, ForgetsWhatIsNoLonger) {
  Scene scene;
  ContactMeter meter(scene.system);
  meter.measure({0.0, scene.x, Coordinates<double>::Zero(5, 3)});
  scene.x(3, 2) = 0.5;
  meter.measure({0.0, scene.x, Coordinates<double>::Zero(5, 3)});
  EXPECT_EQ(meter.force().norm(), 0);
  for (const double gap : meter.gap()) EXPECT_EQ(gap, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace jetlag::testing::contact_meter_test
