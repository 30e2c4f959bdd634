// SPDX-License-Identifier: MIT
// Where the force of an element has a kink, steps end just beyond it, and no element is looked at for nothing.
#include "jetlag/model/kinks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "model/paths_for_tests.hpp"
#include "support/random.hpp"

namespace jetlag::testing::kinks_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(Kinks, EndAFallJustBelowTheFloor) {
  // 1 m above a floor of height -2, from rest with g = 2: 1 - t^2 = -depth. The time is bisected to its last bit, the way
  // is rounded by some eps of 3 m, at a speed of 2 m/s.
  System<double> system = masses(2, 1);
  system.add<Floor>({{0}}, {{100.0, -2.0, 0.0, 1.0, 0.0}});
  Polynomials paths(2);
  paths.c = {{{5, -1}, {0, 0}, {0, -1}}};
  for (double depth : {1e-3, 1e-6, 1e-12})
    EXPECT_NEAR(shortened(system, paths, 10.0, depth), std::sqrt(1 + depth), 4 * eps) << depth;
  EXPECT_EQ(shortened(system, paths, 0.99, 1e-6), 0.99);
}

TEST(Kinks, EndTheMeetingOfTwoEnds) {
  // Head-on at 0.5 m/s each from 1 m: the spring has turned round and is `depth` long after 1 + depth seconds. Past each
  // other at 1 mm the force turns too, by a right angle where 1 - t + 1e-6 = 0.
  System<double> system = masses(2, 2);
  system.add<Spring>({{0, 1}}, {{1.0, 2.0}});
  Polynomials paths(2);
  paths.c = {{{0, 0}, {0.5, 0}}, {{1, 0}, {-0.5, 0}}};
  EXPECT_NEAR(shortened(system, paths, 8.5, 1e-6), 1 + 1e-6, 8 * eps);
  paths.c[1][0][1] = 1e-3;
  EXPECT_NEAR(shortened(system, paths, 8.5, 1e-9), 1 + 1e-6, 8 * eps);
}

TEST(Kinks, TellWhoIsNearAPoint) {
  // Within a thousand depths the force may turn in no time. Away from a point no step goes farther than twice the distance.
  System<double> system = masses(2, 2);
  system.add<Spring>({{0, 1}}, {{1.0, 2.0}});
  Polynomials paths(2);
  for (const auto& [distance, speed, end] : {std::tuple(-0.9e-3, 0.5, 2 * (0.9e-3 + 1e-6)),
                                             {0.9e-3, 0.5, 2 * 0.9e-3},
                                             {0.9e-3, 1e-4, 1.0},
                                             {1.1e-3, 0.5, 2 * 1.1e-3},  // shortened there
                                             {1.1e-3, 1e-4, 1.0}}) {
    paths.c = {{{0, 0}, {0, 0}}, {{distance, 0}, {speed, 0}}};
    Kinks kinks(system);
    std::vector<Kinks::Step> steps{paths.step(0, 1.0), paths.step(1, 1.0)};
    kinks.shorten(steps, 1e-6, paths);
    EXPECT_NEAR(steps[0].h, end, 1e-15) << distance;
    if (speed > 0.1) {
      EXPECT_TRUE(steps[0].near_point && steps[1].near_point) << distance;
    } else if (distance > 1e-3) {
      EXPECT_FALSE(steps[0].near_point || steps[1].near_point) << distance;
    }
  }
}

TEST(Kinks, LetASpringTurnRoundInPeace) {
  // A quarter of a turn in each eighth of the step is no kink: the series of the circle to order 30 at 2 pi.
  System<double> system = masses(2, 2);
  system.add<Spring>({{0, 1}}, {{1.0, 2.0}});
  Polynomials paths(2);
  paths.c = {{{0, 0}, {0, 0}}, {}};
  double factor = 1;
  for (int n = 0; n <= 30; factor /= ++n) {
    const double cosine = n % 2 == 0 ? (n % 4 == 0 ? 1 : -1) : 0,
                 sine = n % 2 == 1 ? (n % 4 == 1 ? 1 : -1) : 0;
    paths.c[1].push_back({cosine * factor, sine * factor});
  }
  EXPECT_EQ(shortened(system, paths, 6.2, 1e-9), 6.2);
}

TEST(Kinks, AreNotWhereTheForceIsSmooth) {
  // Springs of length 0 are smooth at their ends, gravity has a pole, which its series see.
  Polynomials paths(1);
  paths.c = {{{0}, {0.5}}, {{1}, {-0.5}}};
  System<double> spring = masses(1, 2), pull = masses(1, 2), held = masses(1, 2);
  spring.add<Spring>({{0, 1}}, {{1.0, 0.0}});
  EXPECT_EQ(shortened(spring, paths, 8.0, 1e-6), 8.0);
  pull.add<Gravity>({{0, 1}}, {{1.0}});
  EXPECT_TRUE(Kinks(pull).none());
  held.fix(0);
  held.fix(1);
  held.add<Spring>({{0, 1}}, {{1.0, 1.0}});
  EXPECT_TRUE(Kinks(held).none());
}

TEST(Kinks, LetNobodyStayWhoBeginsOnOne) {
  // On the surface no side is known: the step ends where one is, four depths away; a mass that lies there may stay.
  System<double> system = masses(1, 1);
  system.add<Floor>({{0}}, {{100.0, 0.0, 1.0, 0.0, 0.0}});
  Polynomials paths(1);
  for (double speed : {-2.0, 2.0}) {
    paths.c = {{{0}, {speed}}};
    EXPECT_NEAR(shortened(system, paths, 1.0, 1e-6), 2e-6, 1e-21);
  }
  paths.c = {{{0}, {0}}};
  EXPECT_EQ(shortened(system, paths, 1.0, 1e-6), 1.0);
}

// ---- many elements ----------------------------------------------------------------------------------------

/// Particles in a box that jump about: each has its own steps, cubic paths, and springs to some others.
struct Crowd {
  static constexpr int count = 12;
  static constexpr double depth = 1e-4;
  System<double> system = masses(2, count);
  std::vector<std::array<int, 2>> pairs;
  std::vector<double> begin = std::vector<double>(count, 0.0), end = begin;
  std::vector<std::vector<std::vector<double>>> c;  // about begin
  Uniform random{7};

  Crowd() {
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j)
        if ((i + j) % 3 == 0) pairs.push_back({i, j});
    system.add<Spring>(pairs, {{1.0, 1.0}});
    std::vector<std::array<int, 1>> all;
    for (int i = 0; i < count; ++i) all.push_back({i});
    system.add<Floor>(all, {{1.0, -1.0, 0.0, 1.0, 0.0}});
    for (int i = 0; i < count; ++i) c.push_back({{random(-1, 1), random(-1, 1)}, {0, 0}, {0, 0}, {0, 0}});
  }
  std::array<double, 2> place(int i, double t) const {
    std::array<double, 2> x{};
    for (int n = 3; n >= 0; --n)
      for (int d = 0; d < 2; ++d) x[d] = x[d] * (t - begin[i]) + c[i][n][d];
    return x;
  }
  /// The polynomials of all about a time.
  Polynomials at(double t) const {
    Polynomials paths(2);
    paths.time = t;
    paths.c = c;
    for (int i = 0; i < count; ++i)
      for (int d = 0; d < 2; ++d) {
        const double s = t - begin[i], a = c[i][0][d], b = c[i][1][d], e = c[i][2][d], f = c[i][3][d];
        paths.c[i][0][d] = a + s * (b + s * (e + s * f));
        paths.c[i][1][d] = b + s * (2 * e + 3 * s * f);
        paths.c[i][2][d] = e + 3 * s * f;
      }
    return paths;
  }
};

/// kick [m/s]: by how much a particle changes its mind at each step.
void expect_warnings(double kick) {
  // Whoever crosses a kink by more than the depth within a step has been told: its step was shortened to end there, or
  // that of its partner, and it was woken. So at the end of each step, looked at with all paths at hand, an element that
  // turned round since the step of one of its particles began is nearer than its depth or has just been crossed.
  Crowd crowd;
  Kinks kinks(crowd.system);
  std::size_t crossings = 0, taken = 0, looked = 0, woken = 0;
  for (int event = 0; event < 6000; ++event) {
    const int i = static_cast<int>(std::ranges::min_element(crowd.end) - crowd.end.begin());
    const double t = crowd.end[i];
    Polynomials paths = crowd.at(t);
    // A new path: back towards the middle, with some will of its own.
    const double h = std::exp(crowd.random(-5, -1));
    auto& own = paths.c[i];
    for (int d = 0; d < 2; ++d) {
      own[1][d] += kick * crowd.random(-1, 1) - 0.5 * h * (own[0][d] + own[1][d]);
      own[2][d] = kick * crowd.random(-1, 1);
      own[3][d] = kick * crowd.random(-1, 1);
    }
    double length = h;
    if (paths.take(kinks, i, h)) {
      ++taken;
    } else {
      ++looked;
      std::vector<Kinks::Step> steps{paths.step(i, h)};
      for (const Kinks::Step& other : kinks.shorten(steps, Crowd::depth, paths))
        if (t + other.h < crowd.end[other.particle]) {
          crowd.end[other.particle] = t + other.h;
          ++woken;
        }
      length = steps[0].h;
      crossings += length < h;
    }
    crowd.c[i] = own;
    crowd.begin[i] = t;
    crowd.end[i] = t + length;

    // The truth, in 200 parts of this step, as far as the partners' steps go.
    const auto stays = [&](const std::function<std::array<double, 2>(double)>& kink, double until) {
      const auto first = kink(t);
      std::array<double, 2> side = first;
      const double start = std::hypot(first[0], first[1]);
      if (start <= 4 * Crowd::depth) return true;  // on no side yet
      for (int part = 1; part <= 200; ++part) {
        const auto way = kink(t + (until - t) * part / 200);
        const double size = std::hypot(way[0], way[1]);
        if (way[0] * side[0] + way[1] * side[1] < 0 && size > 1.01 * Crowd::depth && part < 200) return false;
        if (size > Crowd::depth) side = way;
      }
      return true;
    };
    ASSERT_TRUE(stays([&](double s) { return std::array{0.0, crowd.place(i, s)[1] + 1}; }, crowd.end[i]))
        << "floor, event " << event;
    for (const auto& [a, b] : crowd.pairs) {
      if (a != i && b != i) continue;
      const auto between = [&](double s) {
        const auto x = crowd.place(a, s), y = crowd.place(b, s);
        return std::array{y[0] - x[0], y[1] - x[1]};
      };
      ASSERT_TRUE(stays(between, std::min(crowd.end[a], crowd.end[b])))
          << a << ", " << b << ", event " << event;
    }
  }
  EXPECT_GT(crossings, 50u);  // the test is not idle
  EXPECT_GT(taken, 1000u);
  EXPECT_GT(looked, 1000u);
  EXPECT_GT(woken, 5u);
}

TEST(Kinks, AreCrossedByNobodyWhoWasNotWarned) {
  for (double kick : {1.0, 0.1, 0.01}) {
    SCOPED_TRACE(kick);
    expect_warnings(kick);
  }
}

TEST(Kinks, HoldAgainstWhoeverUsesUpHisRoom) {
  // Three masses on a line, each of which, at random times, takes the strongest pull towards another that it can have
  // without being looked at: all rooms and all time are used up. Still nobody meets another unseen.
  System<double> system = masses(1, 3);
  system.add<Spring>({{0, 1}, {1, 2}, {0, 2}}, {{1.0, 1.0}});
  std::size_t hidden = 0, seen = 0;
  for (int game = 0; game < 3000; ++game) {
    Uniform random(game);
    Kinks kinks(system);
    std::array<double, 3> begin{}, end{}, x{0, 1, 2.5}, v{}, pull{};
    for (double& speed : v) speed = random(-0.3, 0.3);
    const auto place = [&](int i, double t) {
      const double s = t - begin[i];
      return x[i] + s * (v[i] + s * pull[i]);
    };
    const std::array<double, 3> order{place(0, 0), place(1, 0), place(2, 0)};
    bool met = false;
    for (int event = 0; event < 60 && !met; ++event) {
      const int i = static_cast<int>(std::ranges::min_element(end) - end.begin());
      const int towards = (i + 1 + (random(0, 1) < 0.5)) % 3;
      const double t = end[i], h = random(0.05, 0.5), place_now = place(i, t),
                   speed = v[i] + 2 * pull[i] * (t - begin[i]), sign = place(towards, t) > place_now ? 1 : -1;
      Polynomials paths(1);
      paths.time = t;
      for (int k = 0; k < 3; ++k) {
        const double s = t - begin[k];
        paths.c.push_back({{place(k, t)}, {v[k] + 2 * pull[k] * s}, {pull[k]}});
      }
      double most = 0;
      paths.c[i][2][0] = 0;
      bool hides = paths.take(kinks, i, h);
      for (double step = 8; hides && step > 1e-4; step /= 2) {
        paths.c[i][2][0] = sign * (most + step);
        if (paths.take(kinks, i, h)) most += step;
      }
      paths.c[i][2][0] = sign * most;
      hides = hides && paths.take(kinks, i, h);
      double length = h;
      if (!hides) {
        std::vector<Kinks::Step> steps{paths.step(i, h)};
        for (const Kinks::Step& other : kinks.shorten(steps, 1e-9, paths)) {
          end[other.particle] = std::min(end[other.particle], t + other.h);
          met = true;
        }
        length = steps[0].h;
        met = met || length < h;
        seen += met;
      }
      hidden += hides;
      x[i] = place_now;
      v[i] = speed;
      pull[i] = sign * most;
      begin[i] = t;
      end[i] = t + length;
      for (int a = 0; a < 3 && !met; ++a)
        for (int b = 0; b < a; ++b) {
          const double until = std::min(end[a], end[b]);
          for (int part = 0; part <= 20; ++part) {
            const double s = t + (until - t) * part / 20;
            ASSERT_GT((place(a, s) - place(b, s)) * (order[a] - order[b]), 0)
                << a << b << " in game " << game;
          }
        }
    }
  }
  EXPECT_GT(hidden, 2000u);
  EXPECT_GT(seen, 100u);
}

TEST(Kinks, DoNotDependOnTheOrderOfSteps) {
  for (int round = 0; round < 50; ++round) {
    Crowd crowd;
    for (int skip = 0; skip < round; ++skip) crowd.random(0, 1);
    for (auto& path : crowd.c)
      for (int n = 0; n < 4; ++n)
        for (double& x : path[n]) x = crowd.random(-1, 1);
    const Polynomials paths = crowd.at(0);
    std::vector<Kinks::Step> steps, backwards;
    for (int i = 0; i < Crowd::count; ++i) steps.push_back(paths.step(i, 0.1 + 0.05 * i));
    backwards.assign(steps.rbegin(), steps.rend());
    Kinks one(crowd.system), other(crowd.system);
    one.shorten(steps, Crowd::depth, paths);
    other.shorten(backwards, Crowd::depth, paths);
    for (int i = 0; i < Crowd::count; ++i) {
      EXPECT_EQ(steps[i].h, backwards[Crowd::count - 1 - i].h) << i;
      EXPECT_EQ(one.in_doubt(i), other.in_doubt(i)) << i;
    }
  }
}

TEST(Kinks, AreNotLookedForInABodyThatFliesAlong) {
  // A chain that flies at 100 of its lengths a second and swings by a hundredth of them: in a thousand steps of 10 lengths
  // it is looked at a few times.
  constexpr int count = 50;
  System<double> system = masses(3, count);
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i + 1 < count; ++i) pairs.push_back({i, i + 1});
  system.add<Spring>(pairs, {{1.0, 1.0}});
  Kinks kinks(system);
  std::size_t looks = 0;
  for (int step = 0; step < 1000; ++step) {
    Polynomials paths(3);
    paths.time = 0.1 * step;
    std::vector<Kinks::Step> late;
    for (int i = 0; i < count; ++i) {
      const double phase = paths.time + i;
      paths.c.push_back({{i + 100 * paths.time, 0.01 * std::sin(phase), 0},
                         {100, 0.01 * std::cos(phase), 0},
                         {0, -0.005 * std::sin(phase), 0}});
      if (!paths.take(kinks, i, 0.1)) late.push_back(paths.step(i, 0.1));
    }
    looks += late.size();
    if (!late.empty()) kinks.shorten(late, 1e-9, paths);
  }
  // The transverse speeds of neighbours differ by 0.01: half a length of 1 is used up after 50 s at the earliest.
  EXPECT_GE(looks, static_cast<std::size_t>(count));
  EXPECT_LE(looks, 4u * count);
}

}  // namespace
}  // namespace jetlag::testing::kinks_test
