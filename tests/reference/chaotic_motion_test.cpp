// SPDX-License-Identifier: MIT
// Motions in which disturbances grow: Henon and Heiles, Lorenz, Fermi, Pasta and Ulam with stiff springs.
// Source of all values: Taylor series in 75-digit arithmetic, repeated at a second order.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "jetlag/integrators/first_order_taylor.hpp"
#include "reference/conditioning.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing {
namespace {

// ---- Henon and Heiles -------------------------------------------------------------------------------------

ReferenceProblem henon_heiles(double p1, double p2, double until) {
  return of_problem("henon-heiles", problems::henon_heiles({0, 0}, {p1, p2}), until);
}

TEST(HenonHeiles,
     IsFollowedThroughChaos) {  // H = 0.16; disturbances grow 5e5-fold in 300 steps: 3 sigma are 5e-9
  const ReferenceSolution solution = henon_heiles(0.56, 0.08, 100).solve(20, {});
  ASSERT_EQ(solution.report.outcome, Outcome::success);
  EXPECT_LT(error(solution.end, {-0.1897889011958567181822281L, 0.1082076197948636723753129L,
                                 -0.3589475161340461731389076L, 0.3694284583514619911515036L}),
            1e-9);  // measured: 4e-11 to 3e-10 for degrees 18 to 30 and every instruction set
}

TEST(HenonHeiles, IsFollowedOnATorus) {  // H = 0.125, t = 1000; growth 160 in 2800 steps: sigma is 2e-12
  const ReferenceProblem problem = henon_heiles(0.4, 0.3, 1000);
  const std::vector<long double> known{-0.4694767181237978938466898L, -0.2206016331410644657226765L,
                                       0.2036506995903977106218557L, 0.1718742565636709705797303L};
  const ReferenceSolution solution = problem.solve(20, {});
  ASSERT_EQ(solution.report.outcome, Outcome::success);
  EXPECT_LT(error(solution.end, known), rounding_tolerance(problem, solution));  // measured: 1e-14 to 5e-13

  // As a first-order system, whose state is compensated: measured 2e-14 to 3e-14.
  const auto f = [](const auto&, const auto& u) {
    return std::array{u[2], u[3], -u[0] - 2.0 * (u[0] * u[1]), -u[1] + u[1] * u[1] - u[0] * u[0]};
  };
  EXPECT_LT(error(of_equations("henon-heiles", f, problem.start, 1000).solve(20, {}).end, known), 1e-12);
}

// ---- Lorenz -----------------------------------------------------------------------------------------------

/// The error at `until` from (-10, -1, 40), relative to nothing: the orbit has the size 30.
template <class T>
double lorenz_error(T until, const std::array<T, 3>& known, double max_step) {
  FirstOrderTaylor<T> method(lorenz, 3, {.parameters = {T(10), T(28), T(8) / T(3)}, .max_step = max_step});
  FirstOrderState<T> state{T(0), {T(-10), T(-1), T(40)}};
  EXPECT_EQ(method.run(state, until).outcome, Outcome::success);
  T most(0);
  for (int i = 0; i < 3; ++i) most = std::max(most, std::abs(state.y[i] - known[i]));
  return static_cast<double>(most);
}
constexpr double anything = std::numeric_limits<double>::infinity();

TEST(Lorenz, IsFollowedInDoublesToTwenty) {
  const std::array<double, 3> at_10{4.228562964151610546011453, 0.7458347709009345752019322,
                                    27.28032962198835979290540};
  const std::array<double, 3> at_20{-1.857712426772006862419469, 3.962400633106875805646622,
                                    28.73377401107199056606179};
  // exp(0.906 t) times the rounding of the state, 4e-15, is 3e-11 at 10 and 3e-7 at 20; beta = 8/3 is not a double
  // and adds 9e-8. Measured with the longest steps, degrees 18 to 30: 2e-12 to 2e-11 and 2e-7 to 2.4e-6.
  EXPECT_LT(lorenz_error(10.0, at_10, anything), 1e-10);
  EXPECT_LT(lorenz_error(20.0, at_20, anything), 1e-5);
  // With short steps the rounding of a compensated state is that of small increments: measured 4e-8 to 1.6e-7.
  EXPECT_LT(lorenz_error(20.0, at_20, 0x1p-10), 1e-6);
}

TEST(Lorenz, IsFollowedIn80BitsToThirty) {
  if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "long double is not wider than double";
  // 2^-11 of the errors in doubles, and beta is exact to 80 bits. Measured: 4e-10 at 20.
  EXPECT_LT(lorenz_error<long double>(
                20, {-1.857712426772006862419469L, 3.962400633106875805646622L, 28.73377401107199056606179L},
                anything),
            1e-8);
  EXPECT_LT(lorenz_error<long double>(
                30, {-4.332897236444689562374807L, -6.731947256741379664942477L, 17.61533062095498378672458L},
                anything),
            1e-4);  // exp(9.06) times as much
}

// ---- Fermi, Pasta and Ulam --------------------------------------------------------------------------------

/// Three stiff springs between four soft ones: u = (x_0, x_1, y_0, y_1), three components each, p = (omega^2),
///     H = |y|^2 / 2 + omega^2 |x_1|^2 / 2 + (s_0^4 + s_1^4 + s_2^4 + s_3^4) / 4,
///     s_0 = x_01 - x_11,   s_i = x_0{i+1} - x_1{i+1} - x_0i - x_1i,   s_3 = x_03 + x_13.       Source: [HLW06] I.5.1.
constexpr auto stiff_and_soft = [](const auto&, const auto& u, const auto& p) {
  auto derivative = u;
  const auto cube = [](const auto& s) { return s * s * s; };
  const auto first = cube(u[0] - u[3]), last = cube(u[2] + u[5]);
  const auto left = cube(u[1] - u[4] - u[0] - u[3]), right = cube(u[2] - u[5] - u[1] - u[4]);
  for (int i = 0; i < 6; ++i) derivative[i] = u[6 + i];
  derivative[6] = left - first;
  derivative[7] = right - left;
  derivative[8] = -last - right;
  derivative[9] = first + left - p[0] * u[3];
  derivative[10] = left + right - p[0] * u[4];
  derivative[11] = right - last - p[0] * u[5];
  return derivative;
};

struct StiffEnergies {
  double total, of_stiff_springs;  // H, I
};
StiffEnergies stiff_energies(const std::vector<double>& u) {
  const auto fourth = [](double s) { return s * s * s * s; };
  double kinetic = 0, oscillating = 0;
  for (int i = 6; i < 9; ++i) kinetic += 0.5 * u[i] * u[i];
  for (int i = 9; i < 12; ++i) oscillating += 0.5 * (u[i] * u[i] + 2500 * u[i - 6] * u[i - 6]);
  const double soft = 0.25 * (fourth(u[0] - u[3]) + fourth(u[1] - u[4] - u[0] - u[3]) +
                              fourth(u[2] - u[5] - u[1] - u[4]) + fourth(u[2] + u[5]));
  return {kinetic + oscillating + soft, oscillating};
}

TEST(StiffAndSoftSprings, ExchangeEnergySlowly) {
  struct Case {
    double until, oscillating, tolerance;
    std::vector<long double> known;
  };
  for (const Case& c :
       {Case{1, 1.00586928688292, 1e-12, {}},
        Case{10,
             0.981943982762801,
             1e-12,
             {1.04205763710250895438097L, 0.243635570363191095817151L, -0.106360437964649122662849L,
              -0.0275579312012517383034702L, -0.0005927177946675771468034L, 0.000395054059610075512822745L}},
        Case{100,
             1.0023032086042,
             1e-9,
             {-0.76557251959881037783644L, 0.226673421206303377093455L, -0.250922260980788313230296L}}}) {
    const ReferenceProblem problem = of_equations(
        "stiff and soft", stiff_and_soft, {1, 0, 0, 1.0 / 50, 0, 0, 1, 0, 0, 1, 0, 0}, c.until, {2500.0});
    const ReferenceSolution solution = problem.solve(20, {});
    ASSERT_EQ(solution.report.outcome, Outcome::success);
    const StiffEnergies energies = stiff_energies(solution.end);
    EXPECT_NEAR(energies.total, 2.00120008, 1e-13) << c.until;  // measured: below 2e-14
    // Disturbances grow 5e4-fold to t = 100, in 5800 steps: sigma is 9e-10. Measured: 1.6e-12, and 2e-16 to t = 10.
    EXPECT_NEAR(energies.of_stiff_springs, c.oscillating, c.tolerance) << c.until;
    EXPECT_LT(error(solution.end, c.known), c.tolerance) << c.until;
  }
}

}  // namespace
}  // namespace jetlag::testing
