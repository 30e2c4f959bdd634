// SPDX-License-Identifier: MIT
// Right sides that make choices: y' = f(t, y) with abs, max, select and roots, against solutions in closed form.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "jetlag/integrators/first_order_taylor.hpp"
#include "support/random.hpp"

namespace jetlag::testing::changing_right_sides_test {
namespace {

const auto one = [](const auto& f) { return std::array{f}; };

struct Ended {
  std::vector<double> y;
  double time;
  Report report;
  Work work;
};

template <class F>
Ended run(const F& f, std::vector<double> y, double from, double until, FirstOrderOptions<> options = {}) {
  FirstOrderTaylor<> method(f, static_cast<int>(y.size()), options);
  FirstOrderState<> state{from, std::move(y)};
  Report report = method.run(state, until, {.max_steps = 100000});
  return {state.y, state.time, std::move(report), method.work()};
}

/// Of sums of a few dozen terms of size 1 to 20.
constexpr double rounding = 1e-13;

template <class F>
void expect_end(const F& f, const std::vector<double>& y, double from, double until, double expected,
                FirstOrderOptions<> options = {}, double tolerance = rounding) {
  const Ended end = run(f, y, from, until, options);
  EXPECT_EQ(end.report.outcome, Outcome::success) << end.report.message;
  EXPECT_NEAR(end.y[0], expected, tolerance * std::max(1.0, std::abs(expected)));
}

// ---- closed forms ------------------------------------------------------------------------------------------

TEST(ChangingRightSide, ASqrtThatReachesZeroStaysThere) {  // y = (1 - t/2)^2 up to 2
  expect_end([](auto&, auto& y) { return one(-sqrt(y[0])); }, {1}, 0, 4, 0);
}

TEST(ChangingRightSide, ARootOfWhatIsCutOffAtZeroIsNoneThere) {  // a weir runs dry, fills, and runs in waves
  expect_end([](auto&, auto& y) { return one(-sqrt(max(y[0], 0.0))); }, {1}, 0, 4, 0);
  expect_end([](auto& t, auto& y) { return one(sqrt(2.0 * max(1.0 - t, 0.0)) + 0.0 * y[0]); }, {0}, 0, 3,
             std::sqrt(2.0) * 2 / 3);
  for (const double a : {0.3, 0.5, 1.5, 2.5}) {
    const auto power = [&](auto& t, auto& y) { return one(pow(max(t - 1.0, 0.0) / 2.0, a) + 0.0 * y[0]); };
    expect_end(power, {0}, 0, 3, 2 / (a + 1));
  }
  for (const double a :
       {1.5, 2.5}) {  // steeper ends, far from t = 0, are steps of less than a place of the time: it is said
    // integral_0^pi sin^a = B((a+1)/2, 1/2), in two of four half waves.
    const auto waves = [&](auto& t, auto& y) { return one(pow(max(sin(t), 0.0), a) + 0.0 * y[0]); };
    expect_end(waves, {0}, 0.5 * M_PI, 4.5 * M_PI, 2 * boost::math::beta(0.5 * (a + 1), 0.5));
  }
}

TEST(ChangingRightSide,
     ThatComesBackToZeroIsNotOverlooked) {  // y = pi/16 in the middle of a half disc, pi/8 at its end
  const auto half_disc = [](auto& t, auto& y) { return one(sqrt(t * (1.0 - t)) + 0.0 * y[0]); };
  expect_end(half_disc, {0}, 0, 0.5, M_PI / 16);
  expect_end(half_disc, {0}, 0, 1, M_PI / 8);
  const Ended end = run(half_disc, {0}, 0, 2);  // nothing is beyond
  EXPECT_EQ(end.report.outcome, Outcome::non_finite) << end.y[0];
  EXPECT_NEAR(end.time, 1, 1e-15) << end.report.message;
}

TEST(ChangingRightSide, APulseIsNotPassedOver) {
  const auto pulse = [](auto& t, auto&) {
    return one(select(t >= 1.0 && t < 2.0, Recorded(1.0), Recorded(0.0)));
  };
  expect_end(pulse, {0}, 0, 17, 1);
  expect_end(pulse, {1}, 17, 0, 0);
  expect_end(pulse, {0}, 0, 17, 1, {.degree = 4, .step = 0.3});
  expect_end(pulse, {0}, 0, 17, 1, {.degree = 8});
}

TEST(ChangingRightSide, HalfWavesAddUp) {
  const auto half_waves = [](auto& t, auto&) { return one(max(sin(t), 0.0)); };
  expect_end(half_waves, {0}, 0, 2 * M_PI, 2);
  expect_end(half_waves, {0}, 0, 20 * M_PI, 20);
  expect_end(half_waves, {20}, 20 * M_PI, 0, 0);
}

TEST(ChangingRightSide, StartsOnAKinkOnTheSideToWhichItGoes) {
  const auto size = [](auto& t, auto&) { return one(abs(t)); };
  expect_end(size, {0}, 0, 1, 0.5);
  expect_end(size, {0}, 0, -1, -0.5);
  expect_end(size, {0}, -1, 1, 1);
  const auto root = [](auto& t, auto&) { return one(sqrt(t * t)); };
  expect_end(root, {0}, 0, 1, 0.5);
  expect_end(root, {0}, -1, 1, 1);
  const auto later = [](auto& t, auto&) { return one(select(t > 1.0, Recorded(1.0), Recorded(0.0))); };
  expect_end(later, {0}, 1, 2, 1);
  const auto higher = [](auto&, auto& y) { return one(select(y[0] > 1.0, Recorded(1.0), Recorded(2.0))); };
  expect_end(higher, {1}, 0, 1, 2);
}

/// Half a circle and a saw, which are zero at both ends. Where a root with an infinite slope ends, the last steps are below the
/// places of the time.
TEST(ChangingRightSide, RisesFromAPointWithoutASeriesThoughItEndsAtRest) {
  const auto circle = [](auto& t, auto&) { return one(sqrt(t * (1.0 - t))); };
  expect_end(circle, {0}, 0, 1, M_PI / 8);
  expect_end(circle, {0}, 0, 0.5, M_PI / 16);
  for (const Ended& saw :
       {run([](auto& t, auto&) { return one(acos(cos(t))); }, {0}, 0, 2 * M_PI),
        run([](auto& t, auto&) { return one(sqrt(1.0 - cos(t) * cos(t))); }, {0}, 0, M_PI)}) {
    EXPECT_EQ(saw.report.outcome, Outcome::step_underflow) << saw.y[0];  // f is all rounding up to 1e-8
    EXPECT_LT(saw.work.steps, 3000u);
  }
}

/// A branch that is not taken, and has no series: it decides nothing.
TEST(ChangingRightSide, ABranchThatIsNotTakenDoesNotHoldItUp) {
  const auto f = [](auto& t, auto&) { return one(select(t < 1.0, Recorded(1.0), sqrt(0.0 * t))); };
  expect_end(f, {-1}, 0, 0.5, -0.5);
  expect_end(f, {-1}, 0.25, 0.5, -0.75);
  expect_end([](auto& t, auto& y) { return one(select(t < 1.0, Recorded(1.0), 1.0 + sqrt(max(y[0], 0.0)))); },
             {-1}, 0, 0.5, -0.5);
}

TEST(ChangingRightSide, NeverStandsStill) {  // a root of zero that decides
  const auto f = [](auto& t, auto&) {
    return one(select(sqrt(0.0 * t) < 0.5, Recorded(1.0), Recorded(2.0)));
  };
  for (const double from : {0.0, 0.25}) {
    const Ended end = run(f, {0}, from, 1);
    EXPECT_TRUE(end.report.outcome == Outcome::step_underflow ||
                (end.report.outcome == Outcome::success && std::abs(end.y[0] - (1 - from)) < rounding))
        << to_string(end.report.outcome) << " " << end.y[0];
  }
}

TEST(ChangingRightSide, ChangesAtEveryDegree) {  // 1/2 + 2, and 2
  for (int degree = 2; degree < 10; ++degree) {
    expect_end([](auto& t, auto&) { return one(abs(t - 1.0)); }, {0}, 0, 3, 2.5, {.degree = degree});
    expect_end([](auto& t, auto&) { return one(select(t >= 1.0, Recorded(1.0), Recorded(0.0))); }, {0}, 0, 3,
               2, {.degree = degree});
  }
}

TEST(ChangingRightSide, DragTurnsRoundWithTheMotion) {  // thrown up: atan on the way up, tanh on the way down
  const double g = 9.8, k = 0.1, v = std::sqrt(g / k);
  const auto drag = [&](auto&, auto& y) {
    const auto speed = sqrt(y[1] * y[1] + y[2] * y[2]);
    return std::array{y[1], -g - k * speed * y[1], -k * speed * y[2]};
  };
  const double up = v / g * std::atan(10 / v), height = v * v / (2 * g) * std::log(1 + 100 / (v * v));
  const auto fallen = [&](double t) { return -v * v / g * std::log(std::cosh(g * t / v)); };
  expect_end(drag, {0, 10, 0}, 0, 2, height + fallen(2 - up));
  expect_end(drag, {0, 0, 0}, 0, 2, fallen(2));  // from rest: |v| has no series there
}

TEST(ChangingRightSide, AnOscillatorOfConstantForceKeepsItsPeriod) {  // x'' = -sign(x): four parabolas
  const auto sign = [](auto&, auto& y) {
    return std::array{y[1], select(y[0] > 0.0, Recorded(-1.0), Recorded(1.0))};
  };
  expect_end(sign, {1, 0}, 0, 40 * std::sqrt(2.0), 1, {}, 1e-11);  // each crossing is late by rounding
}

TEST(ChangingRightSide, MeetsWhatIsNotWrittenAsAChoice) {
  // The cut of atan2: f jumps by 2 pi. The step across it may be wrong by as much as its defect, 2^16 eps |y|.
  const auto angle = [](auto& t, auto&) { return one(atan2(t, Recorded(-1.0))); };
  expect_end(angle, {0}, -1, 1, 0, {}, 10 * 0x1p-36);
}

TEST(ChangingRightSide, IsCheckedAtEveryDegree) {
  const double exact = 6 + 1 - std::cos(10 - 3 * M_PI);
  for (const int degree : {4, 6, 10, 14, 20, 30}) {
    const double left_out = 20 * std::exp(-2.0 * (degree - 1));  // in each of some 20 steps
    expect_end([](auto& t, auto&) { return one(abs(sin(t))); }, {0}, 0, 10, exact, {.degree = degree},
               std::max(left_out, rounding));
  }
}

TEST(ChangingRightSide, AtALateTimeIsCheckedAtATimeThatExists) {  // 50 Hz after an hour
  for (const auto& [omega, from] : {std::pair(100 * M_PI, 3600.0), {100.0, 1e5}, {1000.0, 1e6}}) {
    const auto drive = [omega = omega](auto& t, auto&) { return one(omega * cos(omega * t)); };
    const Ended end = run(drive, {std::sin(omega * from)}, from, from + 1);
    EXPECT_EQ(end.report.outcome, Outcome::success) << end.report.message;
    EXPECT_EQ(end.work.rejected, 0u);
    // The phase at the end of each of some hundred steps is off by omega ulp(t) / 2.
    EXPECT_NEAR(end.y[0], std::sin(omega * (from + 1)), 1000 * omega * from * 0x1p-52);
  }
}

TEST(ChangingRightSide, ChangesFarApartAndCloseTogetherAreSeenOnALongWay) {
  const auto square = [](auto& t, auto&) { return one(select(sin(t) > 0.0, Recorded(1.0), Recorded(-1.0))); };
  expect_end(square, {0.5}, 0.5, 400 * M_PI, 0, {},
             1e-10);  // each of 400 changes late by some ulps of the time
  const auto pulse = [](auto& t, auto&) {
    return one(select(t >= 1e-4 && t < 2e-4, Recorded(1.0), Recorded(0.0)));
  };
  expect_end(pulse, {0}, 0, 1e12, 1e-4);
}

TEST(ChangingRightSide, AConditionIsTrustedAsFarAsItsSeriesReaches) {
  const auto poles = [](auto& t, auto&) {
    return one(select(1.0 / (t - 5.0) > 0.0 && 1.0 / (t - 6.0) < 0.0, Recorded(1.0), Recorded(0.0)));
  };
  const Ended end = run(poles, {0}, 0, 17);
  if (end.report.outcome == Outcome::success) {
    EXPECT_NEAR(end.y[0], 1, 1e-9);
  }
  const auto bump = [](auto& t, auto&) {
    return one(select(1.0 / (1.0 + 25.0 * (t - 5.0) * (t - 5.0)) > 0.5, Recorded(1.0), Recorded(0.0)));
  };
  expect_end(bump, {0}, 0, 17, 0.4, {}, 1e-12);
}

// ---- outcomes ----------------------------------------------------------------------------------------------

TEST(ChangingRightSide, SlidingIsAnOutcome) {
  const auto friction = [](auto&, auto& y) { return one(select(y[0] > 0.0, Recorded(-1.0), Recorded(1.0))); };
  const Ended end = run(friction, {1}, 0, 4);
  EXPECT_EQ(end.report.outcome, Outcome::step_underflow);
  EXPECT_NE(end.report.message.find("slides"), std::string::npos) << end.report.message;
  EXPECT_NEAR(end.time, 1, 1e-6);
  EXPECT_LT(end.work.steps, 300u);
}

TEST(ChangingRightSide, AFailureIsForgottenByTheNextRun) {
  FirstOrderTaylor<> method(
      [](auto&, auto& y) { return one(select(y[0] > 0.0, Recorded(-1.0), Recorded(1.0))); }, 1);
  FirstOrderState<> state{0, {1}};
  EXPECT_EQ(method.run(state, 4).outcome, Outcome::step_underflow);
  state = {0, {1}};
  EXPECT_EQ(method.run(state, 0.5).outcome, Outcome::success);
}

TEST(ChangingRightSide, ASmoothOneIsNotRejected) {
  const auto lorenz = [](auto&, auto& y) {
    return std::array{10.0 * (y[1] - y[0]), y[0] * (28.0 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3 * y[2]};
  };
  const Ended end = run(lorenz, {-10, -1, 40}, 0, 20);
  EXPECT_EQ(end.report.outcome, Outcome::success);
  EXPECT_EQ(end.work.rejected, 0u);
}

// ---- 1000 right sides at random ----------------------------------------------------------------------------

struct Term {
  enum Kind { size, positive_part, choice } kind;
  double t, y, constant;  // the margin: t, y, 1 times these
  double weight, other;
};
using Terms = std::vector<Term>;

auto right_side(const Terms& terms) {
  return [&terms](const auto& t, const auto& y) {
    Recorded sum = 0.0;
    for (const Term& term : terms) {
      const Recorded margin = term.t * t + term.y * y[0] + term.constant;
      switch (term.kind) {
        case Term::size: sum += term.weight * abs(margin); break;
        case Term::positive_part: sum += term.weight * max(margin, 0.0); break;
        case Term::choice: sum += select(margin > 0.0, Recorded(term.weight), Recorded(term.other));
      }
    }
    return std::array{sum + 0.0 * t};
  };
}

/// The solution while no margin changes its sign:  y' = p + q s + r y,  s = t - t_0,
///     y = y_0 + (p + r y_0) s phi_1(r s) + q s^2 phi_2(r s),   phi_1(z) = (e^z - 1) / z, phi_2(z) = (phi_1(z) - 1) / z.
/// y'' does not change its sign, so that a margin has one extremum at most.
using Real = long double;
struct Linear {
  Real y0, p = 0, q = 0, r = 0;

  static Real phi(int n, Real z) {  // sum_k z^k / (k + n)!
    Real term = n == 1 ? 1 : 0.5L, sum = term;
    for (int k = 1; k < 200; ++k) sum += term *= z / (k + n);
    return sum;
  }
  Real y(Real s) const { return y0 + (p + r * y0) * s * phi(1, r * s) + q * s * s * phi(2, r * s); }
  Real slope(Real s) const { return p + q * s + r * y(s); }
};

struct Margin {
  Real value, t, y;  // at s = 0 without y; slopes
  Real at(const Linear& linear, Real s) const { return value + t * s + y * linear.y(s); }
  Real slope(const Linear& linear, Real s) const { return t + y * linear.slope(s); }
};

template <class F>
Real bisect(const F& negative_before, Real a, Real b) {
  for (int i = 0; i < 100; ++i) {
    const Real middle = (a + b) / 2;
    (negative_before(middle) ? a : b) = middle;
  }
  return b;
}

/// When a margin leaves the side on which it is, within `most`.
std::optional<Real> leaves(const Margin& margin, const Linear& linear, int side, Real most) {
  std::vector<Real> ends{0, most};
  const Real first = margin.slope(linear, 0), last = margin.slope(linear, most);
  if (first * last < 0)
    ends.insert(ends.begin() + 1,
                bisect([&](Real s) { return margin.slope(linear, s) * first > 0; }, 0, most));
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (side * margin.at(linear, ends[i]) < 0)
      return bisect([&](Real s) { return side * margin.at(linear, s) > 0; }, ends[i - 1], ends[i]);
  return std::nullopt;
}

/// y at the end, told the switching times; nothing where the solution slides.
std::optional<Real> solution(const Terms& terms, Real y, Real until, Real& largest) {
  std::vector<int> side;
  for (const Term& term : terms) side.push_back(term.y * y + term.constant > 0 ? 1 : -1);
  Real time = 0;
  largest = 1;
  for (int changes = 0; changes < 1000; ++changes) {
    Linear linear{y};
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const Term& term = terms[i];
      const Real w = term.kind == Term::size            ? side[i] * term.weight
                     : term.kind == Term::positive_part ? (side[i] > 0 ? term.weight : 0)
                                                        : 0;
      linear.p += w * (term.t * time + term.constant);
      linear.q += w * term.t;
      linear.r += w * term.y;
      if (term.kind == Term::choice) linear.p += side[i] > 0 ? term.weight : term.other;
    }
    Real h = until - time;
    int changed = -1;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const Margin margin{terms[i].t * time + terms[i].constant, terms[i].t, terms[i].y};
      if (const auto s = leaves(margin, linear, side[i], h)) {
        h = *s;
        changed = static_cast<int>(i);
      }
    }
    y = linear.y(h);
    time += h;
    largest = std::max(largest, std::abs(y));
    if (changed < 0) return y;
    if (h < 1e-9L) return std::nullopt;
    side[changed] = -side[changed];
  }
  return std::nullopt;
}

TEST(ChangingRightSide, ThousandAtRandomAreRightOrSayNo) {
  Uniform draw(3);
  int right = 0;
  for (int i = 0; i < 1000; ++i) {
    Terms terms(3);
    for (Term& term : terms)
      term = {static_cast<Term::Kind>(static_cast<int>(draw(0, 3))),
              draw(-1, 1),
              draw(-1, 1),
              draw(-1, 1),
              draw(-1, 1),
              draw(-1, 1)};
    const double y = draw(-1, 1), until = 3;
    Real largest = 0;
    const auto expected = solution(terms, y, until, largest);
    const Ended end = run(right_side(terms), {y}, 0, until);
    if (end.report.outcome != Outcome::success) continue;
    ASSERT_TRUE(expected.has_value()) << "right side " << i << " slides";
    EXPECT_NEAR(end.y[0], static_cast<double>(*expected), 1e-10 * static_cast<double>(largest)) << i;
    ++right;
  }
  EXPECT_GE(right, 900);  // that slide are few
}

}  // namespace
}  // namespace jetlag::testing::changing_right_sides_test
