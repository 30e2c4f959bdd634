// SPDX-License-Identifier: MIT
// Events whose g has kinks, jumps, poles and branch points: every zero once, and nothing else.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "schedule/events/events_for_tests.hpp"
#include "support/random.hpp"

namespace jetlag::testing::event_singularities_test {
namespace {

using ::testing::ElementsAre;
constexpr double pi = std::numbers::pi;

/// A dozen roundings of numbers up to 20, over slopes of at least 1/50.
constexpr double rounding = 1e-12;

struct Zero {
  double time;
  bool rising;
};

void expect_zeros(const std::vector<EventHit>& hits, const std::vector<Zero>& zeros, const std::string& of) {
  ASSERT_EQ(hits.size(), zeros.size()) << of;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    EXPECT_NEAR(hits[i].time, zeros[i].time, rounding) << of;
    EXPECT_EQ(hits[i].rising, zeros[i].rising) << of;
  }
}

/// g(t, x) of a particle that moves as x = t - 1, in steps that end at no zero.
template <class G>
std::vector<EventHit> hits_until(double until, const G& g, double step = 0.71) {
  return hits_of(
      free_particle(-1, 1), in_steps(free_particle(-1, 1), step),
      {{.name = "g", .g = [&](const auto& t, const auto& x, const auto&) { return g(t, x(0, 0)); }}}, until);
}

TEST(SingularEvents, TwoParticlesThatPassEachOtherCloselyAreNearTwice) {
  for (const double y : {0.0, 1e-12, 1e-9, 3e-8, 1e-6, 1e-3, 0.1}) {
    const auto near = [y](const auto&, const auto& x) { return sqrt(4.0 * x * x + y * y) - 0.5; };
    const double half = 0.5 * std::sqrt(0.25 - y * y);  // 2 |x| at the distance
    for (const double step : {0.71, 3.0})
      expect_zeros(hits_until(3, near, step), {{1 - half, false}, {1 + half, true}},
                   "y = " + std::to_string(y));
  }
}

TEST(SingularEvents, OfTwoParticlesAreThoseOfTheirDistance) {
  // (2 t - 2)^2 + y^2 = 1/4 twice; from y = 1e-9 on g is analytic all along. Steps of a control: one of 3 s.
  const auto near = [](const auto&, const auto& x, const auto&) {
    const auto dx = x(1, 0) - x(0, 0), dy = x(1, 1) - x(0, 1);
    return sqrt(dx * dx + dy * dy) - 0.5;
  };
  for (const double y : {0.0, 1e-9, 3e-8}) {
    Problem scene{System<double>(2, {1.0, 1.0}), {0.0, Coordinates<double>(2, 2), Coordinates<double>(2, 2)}};
    scene.start.position << -1, 0, 1, y;
    scene.start.velocity << 1, 0, -1, 0;
    const double half = 0.5 * std::sqrt(0.25 - y * y);
    const std::vector<Zero> zeros{{1 - half, false}, {1 + half, true}};
    const Event event{.name = "near", .g = near};
    expect_zeros(hits_of(scene, Lockstep(taylor(scene.system, 20, std::make_unique<JorbaZou>())), {event}, 3),
                 zeros, "y = " + std::to_string(y));
    for (const double step : {0.71, 0.75, 3.0})
      expect_zeros(hits_of(scene, in_steps(scene, step), {event}, 3), zeros, "y = " + std::to_string(y));
  }
}

TEST(SingularEvents, KinksLoseNoZero) {
  for (const double step : {0.3, 0.71, 5.0}) {
    expect_zeros(hits_until(
                     5, [](const auto&, const auto& x) { return abs(x) - 0.5; }, step),
                 {{0.5, false}, {1.5, true}}, "abs");
    expect_zeros(hits_until(
                     5, [](const auto&, const auto& x) { return abs(x) - 1e-8; }, step),
                 {{1 - 1e-8, false}, {1 + 1e-8, true}}, "abs, close");
    expect_zeros(hits_until(
                     10, [](const auto& t, const auto&) { return max(sin(t), 0.0) - 0.5; }, step),
                 {{pi / 6, true}, {5 * pi / 6, false}, {13 * pi / 6, true}, {17 * pi / 6, false}}, "max");
  }
}

TEST(SingularEvents, ATouchAtAKinkIsNoZero) {
  for (const double step : {0.37, 0.71, 5.0}) {
    const auto touches = [&](const auto& g) { expect_zeros(hits_until(3, g, step), {}, "touch"); };
    touches([](const auto&, const auto& x) { return abs(x); });
    touches([](const auto&, const auto& x) { return -abs(x); });
    touches([](const auto& t, const auto&) { return -abs(t - 0.3); });
    touches([](const auto& t, const auto&) { return sqrt((t - 0.3) * (t - 0.3)); });
    touches([](const auto& t, const auto&) { return min(0.3 - t, t - 0.3); });
    touches([](const auto& t, const auto&) { return select(t < 0.3, t - 0.3, 0.3 * (0.3 - t)); });
    expect_zeros(hits_until(
                     3, [](const auto&, const auto& x) { return select(x < 0.0, x, 2.0 * x); }, step),
                 {{1, true}}, "a kink at zero");
    expect_zeros(hits_until(
                     3, [](const auto&, const auto& x) { return x + 0.5 * abs(x); }, step),
                 {{1, true}}, "a kink at zero");
  }
}

TEST(SingularEvents, ANarrowBumpIsSeenFromAfar) {
  const double half = std::sqrt(std::log(2.0) / 100);
  for (const double step : {0.3, 4.5})
    expect_zeros(
        hits_until(
            9, [](const auto& t, const auto&) { return exp(-100.0 * (t - 5.0) * (t - 5.0)) - 0.5; }, step),
        {{5 - half, true}, {5 + half, false}}, "bump");
}

TEST(SingularEvents, PolesAndJumpsThroughZeroAreNoZeros) {
  for (const double step : {0.3, 0.71, 10.0}) {
    expect_zeros(hits_until(
                     10, [](const auto& t, const auto&) { return tan(t); }, step),
                 {{pi, true}, {2 * pi, true}, {3 * pi, true}}, "tan");
    expect_zeros(hits_until(
                     3, [](const auto&, const auto& x) { return 1.0 / x - 1.0; }, step),
                 {{2, false}}, "reciprocal");
    expect_zeros(hits_until(
                     3, [](const auto&, const auto& x) { return atan2(-x, Recorded(-1.0)); }, step),
                 {}, "the cut of atan2");
    expect_zeros(hits_until(
                     3, [](const auto&, const auto& x) { return select(x < 0.0, x - 1.0, x + 1.0); }, step),
                 {}, "select");
  }
}

TEST(SingularEvents, OfTimeAloneAreFoundWhileNothingMoves) {  // one step as long as the run
  const Problem rest = free_particle(0, 0);
  const Event tangent{.name = "tan", .g = [](const auto& t, const auto&, const auto&) { return tan(t); }};
  expect_zeros(hits_of(rest, Lockstep(taylor(rest.system, 20, std::make_unique<JorbaZou>())), {tangent}, 10),
               {{pi, true}, {2 * pi, true}, {3 * pi, true}}, "tan");
}

TEST(SingularEvents, ABranchPointAtZeroIsAZero) {
  for (const double step : {0.3, 0.71, 10.0})
    expect_zeros(
        hits_until(3, [](const auto&, const auto& x) { return cbrt(x); }, step), {{1, true}}, "cbrt");
}

TEST(SingularEvents, WhereGEndsIsAnError) {
  RunOptions options;
  options.events = {{.name = "root",
                     .g = [](const auto&, const auto& x, const auto&) { return sqrt(0.0 - x(0, 0)) - 0.5; }}};
  State<double> state = free_particle(-1, 1).start;
  const Report report = in_steps(free_particle(-1, 1), 0.71).run(state, 3, options);
  EXPECT_EQ(report.outcome, Outcome::non_finite);
  EXPECT_NE(report.message.find("(root): g has no series at t = "), std::string::npos) << report.message;
  EXPECT_LT(state.time, 1);
}

// ---- 1000 functions at random ------------------------------------------------------------------------------

struct Factor {
  enum Kind { distance, fraction, root, half_wave, two_lines, angle, near, lesser, kinds } kind;
  double a, b;
};

Recorded value(const Factor& f, const Recorded& t) {
  const Recorded s = t - f.a;
  switch (f.kind) {
    case Factor::distance: return abs(s) - f.b;
    case Factor::fraction: return s / (t - (f.a + f.b));
    case Factor::root: return cbrt(s);
    case Factor::half_wave: return max(sin(s), 0.0) - 0.5;
    case Factor::two_lines: return select(s < 0.0, t - (f.a - f.b), t - (f.a + 2 * f.b));
    case Factor::angle: return atan2(s, Recorded(-1.0));
    case Factor::near: return sqrt(s * s + 1e-18) - f.b;
    default: return min(s, f.a + f.b - t);
  }
}

/// Where the sign of the factor changes, and whether g goes through zero there.
void add_changes(const Factor& f, std::vector<std::pair<double, bool>>& changes) {
  const auto zero = [&](double t) { changes.emplace_back(t, true); };
  const auto jump = [&](double t) { changes.emplace_back(t, false); };
  switch (f.kind) {
    case Factor::distance: return zero(f.a - f.b), zero(f.a + f.b);
    case Factor::fraction: return zero(f.a), jump(f.a + f.b);
    case Factor::root: return zero(f.a);
    case Factor::half_wave:
      for (int n = -3; n < 4; ++n) zero(f.a + pi / 6 + 2 * pi * n), zero(f.a + 5 * pi / 6 + 2 * pi * n);
      return;
    case Factor::two_lines: return zero(f.a - f.b), jump(f.a), zero(f.a + 2 * f.b);
    case Factor::angle: return jump(f.a);
    case Factor::near: return zero(f.a - f.b), zero(f.a + f.b);
    default: return zero(f.a), zero(f.a + f.b);
  }
}

/// Products of two factors, with numbers and steps that are drawn. `factor()` draws one, with a in (0, 10).
template <class DrawFactor, class DrawStep>
void expect_each_zero_once(const DrawFactor& factor, const DrawStep& step) {
  const double until = 10.03;
  int right = 0, refused = 0;
  for (int i = 0; right < 1000; ++i) {
    ASSERT_LT(i, 2000);
    std::vector<Factor> factors(2);
    std::vector<std::pair<double, bool>> changes;
    for (Factor& f : factors) {
      f = factor();
      add_changes(f, changes);
    }
    std::ranges::sort(changes);
    bool close =
        false;  // beside another one g is flat, and rounding moves its zero farther; the run begins and ends at none
    for (const auto& [time, is_zero] : changes)
      close |= std::abs(time) < 1e-3 || std::abs(time - until) < 1e-3;
    for (std::size_t k = 1; k < changes.size(); ++k) close |= changes[k].first - changes[k - 1].first < 0.05;
    if (close) continue;
    const auto g = [&](const auto& t, const auto&) { return value(factors[0], t) * value(factors[1], t); };

    // The sign after all changes, at a time later than all of them, taken back change by change.
    std::vector<Zero> zeros;
    Recorded last = value(factors[0], Recorded(until)) * value(factors[1], Recorded(until));
    bool positive = last.value() > 0;
    for (auto change = changes.rbegin(); change != changes.rend(); ++change) {
      if (change->first >= until) continue;
      if (change->first <= 0) break;
      if (change->second) zeros.insert(zeros.begin(), {change->first, positive});
      positive = !positive;
    }
    SCOPED_TRACE("function " + std::to_string(i) + " of kinds " + std::to_string(factors[0].kind) + ", " +
                 std::to_string(factors[1].kind));
    std::vector<EventHit> hits;
    RunOptions options;
    options.events = {{.name = "g", .g = [&](const auto& t, const auto& x, const auto&) { return g(t, x); }}};
    options.hits = &hits;
    State<double> state = free_particle(-1, 1).start;
    const Report report = in_steps(free_particle(-1, 1), step()).run(state, until, options);
    if (report.outcome != Outcome::success) {
      EXPECT_FALSE(report.message.empty());
      ++refused;
      continue;
    }
    expect_zeros(hits, zeros, "");
    if (::testing::Test::HasFailure()) return;
    ++right;
  }
  EXPECT_LE(refused, 20);  // a run may say that it cannot follow g, not more often than in two of a hundred
}

TEST(SingularEvents, ThousandAtRandomHaveEachZeroOnce) {
  Uniform draw(8);
  expect_each_zero_once(
      [&] {
        return Factor{static_cast<Factor::Kind>(static_cast<int>(draw(0, Factor::kinds))), draw(0, 10),
                      draw(0.1, 2)};
      },
      [&] { return draw(0.2, 12); });
}

TEST(SingularEvents, ThousandAtTheEndsOfStepsHaveEachZeroOnce) {
  // As above with numbers that are multiples of 1/8, at which steps end: without rounding, or in tenths beside them.
  Uniform draw(9);
  const auto eighths = [&](double low, double high) { return std::round(8 * draw(low, high)) / 8; };
  const std::vector<double> steps = {0.05, 0.1, 0.125, 0.2, 0.25, 0.5, 1, 2, 5};
  expect_each_zero_once(
      [&] {
        return Factor{static_cast<Factor::Kind>(static_cast<int>(draw(0, Factor::kinds))), eighths(0, 10),
                      eighths(0.1, 2)};
      },
      [&] { return steps[static_cast<std::size_t>(draw(0, 9))]; });
}

}  // namespace
}  // namespace jetlag::testing::event_singularities_test
