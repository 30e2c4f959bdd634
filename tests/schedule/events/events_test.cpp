// SPDX-License-Identifier: MIT
// Events: every crossing, in order, to the last bit of time.

#include "jetlag/schedule/events.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/series/calculus/polynomial.hpp"
#include "jetlag/series/elementary.hpp"
#include "schedule/events/events_for_tests.hpp"
#include "support/digits50.hpp"

namespace jetlag::testing::events_test {
namespace {

using ::testing::ElementsAre;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

TEST(Events, OfAnOscillatorAreAtTheZerosOfTheCosine) {
  // Each of n steps rounds x and v by less than eps (trajectory_test.cpp): a phase of at most sqrt(2) n eps; a time is
  // rounded to ulp(t).
  const Problem scene = oscillator();
  const auto hits = hits_of(scene, in_steps(scene, 0.3), {level(0.0)}, 100.0);
  ASSERT_EQ(hits.size(), 32u);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const double truth = (static_cast<double>(k) + 0.5) * pi;
    EXPECT_NEAR(hits[k].time, truth, (std::sqrt(2.0) * (truth / 0.3 + 1) + truth) * eps);
    EXPECT_EQ(hits[k].rising, k % 2 == 1);
    EXPECT_EQ(hits[k].event, 0);
    EXPECT_EQ(hits[k].state.time, hits[k].time);
    EXPECT_NEAR(hits[k].state.position(0, 0), 0.0, 200 * eps);  // ulp(100) times the speed, and rounding
  }
}

TEST(Events, AreWithinOneUlpOfTime) {
  // The polynomial of the step, evaluated in 50 digits, changes sign between the double before the time and the time.
  const Problem scene = spring_cube(1);
  std::vector<EventHit> hits;
  std::vector<Piece> pieces;
  RunOptions options;
  for (int i = 0; i < 8; ++i)
    options.events.push_back(
        {.name = "slow", .g = [i](const auto&, const auto&, const auto& v) { return v(i, 1); }});
  options.hits = &hits;
  options.observer.after_step = [&](const StepView& view) {
    pieces.push_back(view.piece());
    return true;
  };
  State<double> state = scene.start;
  Lockstep schedule(
      std::make_unique<RandomTaylor>(scene.system, geometric(3, 8, 0.5), std::make_unique<FixedStep>(0.1)));
  ASSERT_EQ(schedule.run(state, 10.0, options).outcome, Outcome::success);
  EXPECT_GT(hits.size(), 40u) << "seed 1";
  for (const EventHit& hit : hits) {
    const auto piece = std::ranges::find_if(pieces, [&](const Piece& p) { return hit.time <= p.end; });
    std::vector<Digits50> v;
    for (const auto& coefficient : piece->velocity) v.emplace_back(coefficient(hit.event, 1));
    const auto g = [&](double t) { return evaluate(v, Digits50(t) - Digits50(piece->begin)); };
    const double before = std::nextafter(hit.time, 0.0);
    if (hit.time == piece->end || before <= piece->begin) continue;  // there the states decide
    EXPECT_EQ(g(before) < 0, hit.rising) << hit.time;
    EXPECT_NE(g(hit.time) < 0, hit.rising) << hit.time;
  }
}

TEST(Events, MayCountOneDirectionOnly) {
  const Problem scene = oscillator();
  const auto rising = hits_of(scene, in_steps(scene, 0.3), {level(0.5, Direction::rising)}, 20.0);
  const auto falling = hits_of(scene, in_steps(scene, 0.3), {level(0.5, Direction::falling)}, 20.0);
  ASSERT_EQ(rising.size(), 3u);
  ASSERT_EQ(falling.size(), 4u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(rising[k].time, (2 * k + 2) * pi - pi / 3, 100 * eps * 20);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(falling[k].time, 2 * k * pi + pi / 3, 100 * eps * 20);
}

TEST(Events, OfKeplerAreTheApsides) {
  // x . v = 0 at k pi: rising at the pericentre. The mean anomaly drifts by 3/2 t |dE/E|, E as measured, and each of n
  // steps rounds x and v by a few eps/2 of their size, which is at most 4 eps of time (r/v = 2.6 at the apocentre).
  // g itself, of size 1/2 with slope 1/3 or more, is known to 40 eps.
  const Problem scene = planet(0.5);
  Lockstep schedule(taylor(scene.system, 20, std::make_unique<JorbaZou>()));
  std::vector<EventHit> hits;
  RunOptions options;
  options.hits = &hits;
  options.events = {{.name = "apsis", .g = [](const auto&, const auto& x, const auto& v) {
                       return x(1, 0) * v(1, 0) + x(1, 1) * v(1, 1);
                     }}};
  EnergyMeter energy(scene.system);
  double drift = 0;
  options.observer.after_step = [&](const StepView& view) {
    drift = std::max(drift, std::abs(energy(view.state()).total() + 0.5) / 0.5);
    return true;
  };
  State<double> state = scene.start;
  ASSERT_EQ(schedule.run(state, 40 * pi + 1, options).outcome, Outcome::success);
  EXPECT_LT(drift, 1e-14);
  ASSERT_EQ(hits.size(), 40u);  // the start lies on the event and does not fire
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const double truth = static_cast<double>(k + 1) * pi;
    const double steps = static_cast<double>(schedule.work().steps) * static_cast<double>(k + 1) / 40;
    EXPECT_NEAR(hits[k].time, truth, 1.5 * truth * drift + (4 * steps + 120 + truth) * eps) << k;
    EXPECT_EQ(hits[k].rising, k % 2 == 1) << k;
  }
}

TEST(Events, MakeAPoincareSection) {
  // x = cos t, y = sin(sqrt(2) t): y = 0 upwards at t_k = 2 pi k / sqrt(2), where x = cos t_k.
  System<double> system(1, {1.0, 1.0});
  system.add<Tether>({{0}, {1}}, {{1.0}, {2.0}});
  Problem scene{std::move(system), {0.0, Coordinates<double>(2, 1), Coordinates<double>(2, 1)}};
  scene.start.position << 1.0, 0.0;
  scene.start.velocity << 0.0, std::numbers::sqrt2;
  const auto hits = hits_of(scene, in_steps(scene, 0.25),
                            {{.name = "section",
                              .g = [](const auto&, const auto& x, const auto&) { return x(1, 0); },
                              .direction = Direction::rising}},
                            100.0);
  ASSERT_EQ(hits.size(), 22u);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const double t = static_cast<double>(k + 1) * std::numbers::sqrt2 * pi;
    EXPECT_NEAR(hits[k].time, t, (2 * t / 0.25 + t) * eps);
    EXPECT_NEAR(hits[k].state.position(0, 0), std::cos(t), (4 * t / 0.25 + t) * eps);
  }
}

TEST(Events, ResolveTwoCrossingsCloseTogether) {
  // Near its turning point: cos t = 1 - 1e-9 before and after 2 pi, 9e-5 apart.
  const Problem scene = oscillator();
  const double half = 2 * std::asin(std::sqrt(0.5e-9));
  const auto hits = hits_of(scene, in_steps(scene, 0.3), {level(1 - 1e-9)}, 7.0);
  ASSERT_EQ(hits.size(), 3u);
  // x is known to 25 eps at a slope of 4.5e-5.
  EXPECT_NEAR(hits[1].time, 2 * pi - half, 25 * eps / half);
  EXPECT_NEAR(hits[2].time, 2 * pi + half, 25 * eps / half);
  EXPECT_TRUE(hits[1].rising);
  EXPECT_FALSE(hits[2].rising);
}

TEST(Events, AreFoundWhereAStepIsTooLongForThem) {
  // A free particle passes the circle |x| = 1 in one step of 1000 s, in which sqrt(x^2 + y^2) has no series: x = t -
  // 500, y = 1/2, |x| = 1 at 500 -+ sqrt(3)/2. x is exact, y^2 + x^2 = 1 to eps at a slope of sqrt(3).
  Problem scene{System<double>(2, {1.0}), {0.0, Coordinates<double>(1, 2), Coordinates<double>(1, 2)}};
  scene.start.position << -500.0, 0.5;
  scene.start.velocity << 1.0, 0.0;
  const auto hits =
      hits_of(scene, in_steps(scene, 1000.0),
              {{.name = "circle",
                .g = [](const auto&, const auto& x,
                        const auto&) { return sqrt(x(0, 0) * x(0, 0) + x(0, 1) * x(0, 1)) - 1.0; }}},
              1000.0);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].time, 500 - std::sqrt(0.75), 512 * eps);
  EXPECT_NEAR(hits[1].time, 500 + std::sqrt(0.75), 512 * eps);
}

TEST(Events, ComeInOrderOfTimeThenOfNumber) {
  const Problem scene = free_particle(0.0, 1.0);
  const auto at = [](double x) { return level(x); };
  const auto hits = hits_of(scene, in_steps(scene, 4.0), {at(2.0), at(1.0), at(0.5), at(1.0), at(3.0)}, 3.5);
  std::vector<int> order;
  for (const EventHit& hit : hits) order.push_back(hit.event);
  EXPECT_THAT(order, ElementsAre(2, 1, 3, 0, 4));
}

TEST(Events, KeepTheClock) {
  // At 1e9 a double has steps of 1.2e-7. Here every step is cut at an event, which must not shift the clock: the motion
  // ends after exactly 10, but for 700 roundings and the method.
  Problem scene = oscillator();
  scene.start.time = 1e9;
  std::vector<EventHit> hits;
  RunOptions options;
  options.hits = &hits;
  options.events = {{.name = "cut",
                     .g = [](const auto& t, const auto&, const auto&) { return sin(100.0 * (t - 1e9)); },
                     .change = [](State<double>&) {}}};
  State<double> state = scene.start;
  ASSERT_EQ(in_steps(scene, 0.03, 12).run(state, 1e9 + 10, options).outcome, Outcome::success);
  ASSERT_EQ(hits.size(), 318u);
  for (std::size_t k = 0; k < hits.size(); ++k)  // the clock may be off by half of its grain, and rounds up
    EXPECT_NEAR(hits[k].time - 1e9, static_cast<double>(k + 1) * pi / 100, 1.5 * 0x1p-23);
  EXPECT_NEAR(state.position(0, 0), std::cos(10.0), 700 * 2 * eps);
}

TEST(Events, CallWhoAsked) {
  const Problem scene = free_particle(0.0, 1.0);
  std::vector<double> times;
  Event event = level(0.75);
  event.callback = [&](const EventHit& hit) {
    EXPECT_EQ(hit.state.position(0, 0), 0.75);
    EXPECT_TRUE(hit.rising);
    times.push_back(hit.time);
  };
  RunOptions options;
  options.events = {event};
  options.observer.after_step = [&](const StepView& view) {
    EXPECT_EQ(times.size(), view.end() >= 0.75 ? 1u : 0u);  // events come first
    return true;
  };
  State<double> state = scene.start;
  EXPECT_EQ(in_steps(scene, 0.5).run(state, 2.0, options).outcome, Outcome::success);
  EXPECT_THAT(times, ElementsAre(0.75));
}

TEST(Events, WorkOnPiecesOfLowOrder) {
  // Leapfrog of step h: the phase is off by h^2/24 of t. Its pieces join to rounding, so each zero is found once.
  const Problem scene = oscillator();
  const auto hits =
      hits_of(scene, Lockstep(std::make_unique<Leapfrog>(scene.system, 0.01)), {level(0.0)}, 50.0);
  ASSERT_EQ(hits.size(), 16u);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const double truth = (static_cast<double>(k) + 0.5) * pi;
    EXPECT_NEAR(hits[k].time, truth, 1.1 * truth * 1e-4 / 24 + 1e-4);
  }
}

}  // namespace
}  // namespace jetlag::testing::events_test
