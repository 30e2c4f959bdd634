// SPDX-License-Identifier: MIT
// Kinks of elements of many particles, and the room that those of an element leave each other.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "jetlag/forces/spring.hpp"
#include "model/paths_for_tests.hpp"

namespace jetlag::testing::kinks_of_many_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Of as many particles as it is said: a force that turns round where the last one is in the middle of the others.
template <int count>
struct Midst {
  static constexpr const char* name = "midst";
  static constexpr int participants = count;
  static constexpr std::array<const char*, 0> parameters{};
  template <class T, int D>
  static std::array<Vector<T, D>, count - 1> forces(const Participants<T, D, count>& p) {
    Vector<T, D> way = p.position[count - 1];
    for (int i = 0; i + 1 < count; ++i) way -= T(1.0 / (count - 1)) * p.position[i];
    std::array<Vector<T, D>, count - 1> f;
    f.fill(Vector<T, D>(way / way.norm()));
    return f;
  }
  template <int D>
  static Vector<double, D> kink(const Positions<D, count>& x) {
    Vector<double, D> way = x[count - 1];
    for (int i = 0; i + 1 < count; ++i) way -= x[i] / (count - 1);
    return way;
  }
};

TEST(Kinks, EndTheMeetingOfManyParticles) {
  // The last of eight flies at 0.5 m/s through the middle of the others, which come towards it at as much, from 1 m.
  System<double> system = masses(3, 8);
  system.add<Midst<8>>({{0, 1, 2, 3, 4, 5, 6, 7}}, {});
  Polynomials paths(3);
  for (int i = 0; i < 7; ++i) {
    const double angle = 2 * std::numbers::pi * i / 7;
    paths.c.push_back({{std::cos(angle), std::sin(angle), 0}, {0, 0, 0.5}});
  }
  paths.c.push_back({{0, 0, 1}, {0, 0, -0.5}});
  EXPECT_NEAR(shortened(system, paths, 8.5, 1e-6), 1 + 1e-6, 8 * eps);
  EXPECT_EQ(shortened(system, paths, 0.9, 1e-6), 0.9);
}

/// The farthest that a particle may leave its track in a step of this length without being looked at.
double farthest(const Kinks& kinks, const Polynomials& paths, int particle, double h) {
  double most = 0, too_far = 16;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (most + too_far);
    Kinks probe = kinks;
    const bool is_taken = probe.take({particle, h, middle}, paths.time, paths.c[particle][0].data(),
                                     paths.c[particle][1].data());
    (is_taken ? most : too_far) = middle;
  }
  return most;
}

TEST(Kinks, LeaveRoomForThoseWhoWereNotLookedAt) {
  // All are looked at, then one of them again: whatever way all of them go as far as they may, and for as long, they do
  // not meet. They come together at a speed of 0.5 from a distance of 1.
  const auto expect_room = [](const System<double>& system, const Polynomials& paths) {
    for (int again = 0; again < system.particles(); ++again) {
      Kinks kinks(system);
      std::vector<Kinks::Step> all, one{paths.step(again, 1e-9)};
      for (int i = 0; i < system.particles(); ++i) all.push_back(paths.step(i, 1e-9));
      kinks.shorten(all, 1e-9, paths);
      kinks.shorten(one, 1e-9, paths);
      for (const double h : {1e-9, 0.45, 0.99}) {
        double used = 0.5 * h;
        for (int i = 0; i < system.particles(); ++i) used += farthest(kinks, paths, i, h);
        EXPECT_LE(used, 1.0) << "particle " << again << " again, for " << h << " s";
        if (h < 0.9) {
          EXPECT_GE(used, 0.49) << "there is no room";
        }
      }
    }
  };
  System<double> pair = masses(1, 2);
  pair.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  Polynomials paths(1);
  paths.c = {{{0}, {0.25}}, {{1}, {-0.25}}};
  expect_room(pair, paths);
  System<double> three = masses(1, 3);
  three.add<Midst<3>>({{0, 1, 2}}, {});
  paths.c = {{{0.5}, {0.25}}, {{-0.5}, {0.25}}, {{1}, {-0.25}}};
  expect_room(three, paths);
}

}  // namespace
}  // namespace jetlag::testing::kinks_of_many_test
