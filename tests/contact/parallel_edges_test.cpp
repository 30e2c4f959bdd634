// SPDX-License-Identifier: MIT
// Edges that are parallel but for rounding, or hardly more: their lines may cross far away.
#include <gtest/gtest.h>

#include <cmath>

#include "jetlag/contact/contact_barrier.hpp"
#include "jetlag/model/energy.hpp"

namespace jetlag::testing::parallel_edges_test {
namespace {

/// Of an edge of 1 m at half the thickness above a longer one, in whose plane it is turned by `tilt`, and out of it by `twist`.
double energy_of(double tilt, double twist) {
  const Coordinates<double> x{{-.5, .05, -.5 * twist}, {.5, .05 + tilt, .5 * twist}, {-.6, 0, 0}, {.6, 0, 0}};
  System<double> system(3, {1.0, 1.0, 1.0, 1.0});
  add(system,
      ContactBarrier{
          .surface = Surface({}, {{0, 1}, {2, 3}}, {}), .rest = x, .thickness = 0.1, .stiffness = 1000});
  return EnergyMeter(system)({0.0, x, Coordinates<double>::Zero(4, 3)}).potential;
}

// kappa dh^2 / 8 (1 - w)^3 w^-7 of a gap of half the thickness, w = 1/4, times what is left where |sin|^2 = s is below 1e-3 of the
// edges' lengths, 1 and 1.2 m: c / eps (2 - c / eps) with c / eps = 1000 s.
double energy_at(double sine) {
  const double whole = 1000 * 0.01 / 8 * std::pow(0.75, 3) * std::pow(4.0, 7), part = 1000 * sine * sine;
  return whole * part * (2 - part);
}

TEST(ParallelEdges, InOnePlaneHaveNoPlaceWhereTheyMeet) {
  for (const double tilt : {0.0, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7})
    EXPECT_LE(energy_of(tilt, 0), 1.01 * energy_at(tilt)) << tilt;
}

TEST(ParallelEdges,
     ThatAreTwistedMeetInTheMiddle) {  // the weight of 1e-16 below which there is none is missed
  for (const double twist : {1e-7, 1e-6, 1e-5, 1e-4})
    EXPECT_NEAR(energy_of(0, twist), energy_at(twist), 1e-6 * energy_at(twist)) << twist;
}

}  // namespace
}  // namespace jetlag::testing::parallel_edges_test
