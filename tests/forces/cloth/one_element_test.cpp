// SPDX-License-Identifier: MIT
// The series of one triangle and of one fold: against digits that were computed elsewhere, and in 50 digits against the
// deformation gradient and the energies.
#include "forces/one_element.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "problems/from_energy.hpp"

namespace jetlag::testing::one_fold_test {
namespace {

constexpr Motion<4> flight{.rest = {{{0, 0, 0}, {10, 0, 0}, {2, 9, 0}, {3, -8, 0}}},
                           .place = {{{1, 0, 0}, {12, 1, -1}, {1, 8, 2}, {4, -7, 3}}},
                           .speed = {{{1, -2, 3}, {-3, 1, 2}, {2, 2, -1}, {0, -1, -4}}}};

/// Participant 2 of three or four.
template <class L>
void expect_digits(const std::array<double, L::material.size()>& material, int k,
                   const std::vector<const char*>& digits) {
  SCOPED_TRACE("order " + std::to_string(k));
  std::array<Digits50, L::material.size()> exact;
  for (std::size_t i = 0; i < exact.size(); ++i) exact[i] = material[i];
  expect_digits_of(series_of_one<L, Digits50>(flight, exact, k, 2).back(),
                   series_of_one<L, double>(flight, material, k, 2).back(), k, digits);
}

/// k = 3/2 N m, theta_0 = 1/4.
template <class L, class T>
auto series_of_hinge(int degree) {
  return series_of_system<L, T>(flight, degree, 2, [](System<T>& system, const auto& all) {
    system.template add<L>({all}, {{T(3) / T(2), T(1) / T(4)}});
  });
}
void expect_digits_of_hinge(int k, const std::vector<const char*>& digits) {
  SCOPED_TRACE("order " + std::to_string(k));
  expect_digits_of(series_of_hinge<Hinge, Digits50>(k).back(), series_of_hinge<Hinge, double>(k).back(), k,
                   digits);
}

TEST(OneMembrane, HasTheseDigits) {
  expect_digits<Membrane>(
      {3, 2, 1}, 5, {"0.0053656854883561427362", "-0.014306328866021707263", "0.0034698540364133876190"});
  expect_digits<Membrane>(
      {3, 2, 1}, 20, {"4.8405710217940677601e-6", "5.2651931234127907690e-6", "-6.3008531474752733472e-7"});
}
TEST(OneBending, HasTheseDigits) {
  expect_digits<Bending>({1.5}, 5,
                         {"0.0088490243024406567275", "0.015349233512258176175", "-0.049543611372306639826"});
  expect_digits<Bending>(
      {1.5}, 20, {"-4.0421964190162338635e-12", "-6.5710582181052077584e-13", "9.4185167792841311203e-12"});
}
TEST(OneHinge, HasTheseDigits) {
  expect_digits_of_hinge(5, {"0.071640176362315860135", "0.16747767717672153868", "0.053095763911091632401"});
  expect_digits_of_hinge(20,
                         {"-0.93867099554815701595", "-0.90162901340423440446", "-36.191106583238515783"});
}

/// Stvk and KelvinVoigt by F = dx/dX, 3 x 2 with X in the plane of the rest shape, P = t (lambda tr(e) F + 2 mu F e) with the
/// strain or its rate e = (F^T F - 1)/2, and forces -A P B^T; external, participant 0 the origin.
template <bool viscous>
struct ByGradient {
  static constexpr const char* name = "by_gradient";
  static constexpr int participants = 3;
  static constexpr std::array dimensions{3};
  static constexpr bool external = true;
  static constexpr std::array<const char*, 2> material{"lambda", "mu"};
  static constexpr std::array<const char*, 7> parameters{"b_00", "b_01",   "b_10", "b_11",
                                                         "area", "lambda", "mu"};

  /// The rest shape lies in the plane z = 0.
  template <class T>
  static std::array<T, 7> at_rest(const std::array<Vector<T, 3>, 3>& x, const T& lambda, const T& mu) {
    const Vector<T, 3> a = x[1] - x[0], b = x[2] - x[0];
    const T twice = a[0] * b[1] - a[1] * b[0];
    return {b[1] / twice, -b[0] / twice, -a[1] / twice, a[0] / twice, twice / T(2), lambda, mu};
  }

  template <class T>
  static std::array<Vector<T, 3>, 3> forces(const Participants<T, 3, 3>& p, const T& b_00, const T& b_01,
                                            const T& b_10, const T& b_11, const T& area, const T& lambda,
                                            const T& mu) {
    const std::array<std::array<T, 2>, 2> b{{{b_00, b_01}, {b_10, b_11}}};
    const auto gradient = [&](const std::array<Vector<T, 3>, 3>& x) {
      std::array<Vector<T, 3>, 2> f;
      for (int c = 0; c < 2; ++c) f[c] = b[0][c] * (x[1] - x[0]) + b[1][c] * (x[2] - x[0]);
      return f;
    };
    const auto f = gradient(p.position), rate = gradient(p.velocity);
    std::array<std::array<T, 2>, 2> e;
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c)
        e[r][c] = T(0.5) * (viscous ? T(T(f[r].dot(rate[c])) + T(rate[r].dot(f[c])))
                                    : T(T(f[r].dot(f[c])) - T(r == c ? 1.0 : 0.0)));
    const T trace = e[0][0] + e[1][1];
    std::array<Vector<T, 3>, 2> stress;
    for (int c = 0; c < 2; ++c)
      stress[c] = T(lambda * trace) * f[c] + T(T(2.0) * mu) * (e[0][c] * f[0] + e[1][c] * f[1]);
    std::array<Vector<T, 3>, 3> force;
    for (int i = 0; i < 2; ++i) force[i + 1] = T(-area) * (b[i][0] * stress[0] + b[i][1] * stress[1]);
    force[0] = -(force[1] + force[2]);
    return force;
  }
};

/// Both in 50 digits: rounding 1e-50 times some 1e3 terms, grown by cancellation to less than 1e-45.
template <class A, class B>
void expect_same(const A& actual, const B& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t k = 2; k < actual.size(); ++k)
    EXPECT_THAT(actual[k], IsCloseTo(expected[k], within(1e-45))) << "order " << k;
}
constexpr int degree = 20;

TEST(OneMembrane, IsThatOfTheDeformationGradient) {
  const Digits50 lambda = Digits50(7) / 5, mu = Digits50(11) / 10, thickness = Digits50(1) / 4;
  expect_same(series_of_one<Membrane, Digits50>(flight, {lambda, mu, thickness}, degree, 2),
              series_of_one<ByGradient<false>, Digits50>(flight, {lambda / 4, mu / 4}, degree, 2));
  expect_same(series_of_one<MembraneKelvinVoigt, Digits50>(flight, {lambda, mu, thickness}, degree, 2),
              series_of_one<ByGradient<true>, Digits50>(flight, {lambda / 4, mu / 4}, degree, 2));
}
TEST(OneBending, IsThatOfItsEnergy) {
  expect_same(series_of_one<Bending, Digits50>(flight, {Digits50(3) / 2}, degree, 2),
              series_of_one<problems::FromEnergy<Bending>, Digits50>(flight, {Digits50(3) / 2}, degree, 2));
}
TEST(OneHinge, IsThatOfItsEnergy) {
  expect_same(series_of_hinge<Hinge, Digits50>(degree),
              series_of_hinge<problems::FromEnergy<Hinge>, Digits50>(degree));
}

}  // namespace
}  // namespace jetlag::testing::one_fold_test
