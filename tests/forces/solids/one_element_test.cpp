// SPDX-License-Identifier: MIT
// The series of one element of each solid law: against digits that were computed elsewhere, and against the law written by
// the deformation gradient F and the first Piola-Kirchhoff stress P(F), as textbooks have it, in 50 digits.
#include "forces/one_element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "support/close.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing::one_element_test {
namespace {

constexpr Tenths<4> rest{{{0, 0, 0}, {10, 0, 0}, {2, 9, 0}, {3, 2, 8}}},
    place{{{1, 0, 0}, {12, 1, -1}, {1, 8, 2}, {4, 3, 9}}},
    speed{{{1, -2, 3}, {-3, 1, 2}, {2, 2, -1}, {0, -1, -4}}};

/// The series of the last participant of one element: in the plane of the first three rows and two columns.
template <class L, class T>
std::vector<Vector<T, L::dimensions[0]>> series_of(const std::array<T, L::material.size()>& material,
                                                   int degree) {
  return series_of_one<L, T>(Motion<4>{rest, place, speed}, material, degree, L::participants - 1);
}

/// Twenty digits of coefficient k.
template <class L>
void expect_digits(const std::array<double, L::material.size()>& material, int k,
                   const std::vector<const char*>& digits) {
  SCOPED_TRACE(std::string(L::name) + ", order " + std::to_string(k));
  std::array<Digits50, L::material.size()> exact;
  for (std::size_t i = 0; i < exact.size(); ++i) exact[i] = material[i];
  expect_digits_of(series_of<L, Digits50>(exact, k).back(), series_of<L, double>(material, k).back(), k,
                   digits);
}

TEST(OneElement, OfStvkHasTheseDigits) {
  expect_digits<Stvk>(
      {3, 2}, 5, {"-0.00065479048716874721292", "-0.0023165003985366427622", "-0.0047545689196611015554"});
  expect_digits<Stvk>(
      {3, 2}, 20, {"-4.3299838311346555560e-7", "-2.6200822532700151156e-7", "-1.3307301375295164438e-6"});
}
TEST(OneElement, OfNeoHookeanHasTheseDigits) {
  expect_digits<NeoHookean>(
      {3, 2}, 5, {"0.00084576965572333803201", "0.0015510163255332539369", "0.0033700142305508208660"});
  expect_digits<NeoHookean>(
      {3, 2}, 20, {"-1.1895286395679177143e-7", "6.7684595893711615227e-8", "3.3329586659224335352e-7"});
}
TEST(OneElement, OfStableNeoHookeanHasTheseDigits) {  // l = 3, m = 2 of lambda = 7/4, mu = 3/2
  expect_digits<StableNeoHookean>(
      {1.75, 1.5}, 5,
      {"-0.00011552886615094416421", "0.00096510302561290967548", "-0.0018175421019065514481"});
  expect_digits<StableNeoHookean>(
      {1.75, 1.5}, 20,
      {"-4.1634407467603747656e-9", "-6.4896003857153064922e-9", "-2.6395946513073297518e-8"});
}
TEST(OneElement, OfPolynomialNeoHookeanHasTheseDigits) {  // l = 3, m = 2 of lambda = 1, mu = 2
  expect_digits<PolynomialNeoHookean>(
      {1, 2}, 5, {"-0.00018254494866683813443", "0.00076086854718578532236", "-0.0014598525872878086420"});
  expect_digits<PolynomialNeoHookean>(
      {1, 2}, 20, {"-1.0982872968744875430e-9", "-3.0042613138246668406e-9", "-1.0871842973054698759e-9"});
}
TEST(OneElement, OfCorotatedHasTheseDigits) {
  expect_digits<Corotated>(
      {3, 2}, 5, {"-0.00032781237609627208078", "2.2481446566831572312e-5", "-0.0021868981877165981536"});
  expect_digits<Corotated>(
      {3, 2}, 20, {"-9.3840813158338030708e-11", "1.5075235426262705254e-9", "-4.8871804155838743326e-10"});
}
TEST(OneElement, InThePlaneHasTheseDigits) {
  expect_digits<PlaneStvk>({3, 2, 1}, 20, {"3.4111584652443088365e-6", "1.0390449651096461648e-5"});
  expect_digits<PlaneNeoHookean>({3, 2, 1}, 20, {"0.0015339724002914126590", "0.0043870740437043189529"});
}
TEST(OneElement, InPlaneStressHasTheseDigits) {
  const auto [lambda, mu] = plane_stress(Lame<Digits50>{3, 2});
  EXPECT_THAT((series_of<PlaneStvk, Digits50>({lambda, mu, 1}, 20).back()),
              IsCloseTo(std::vector<Digits50>{Digits50("1.4183203304902736622e-6"),
                                              Digits50("5.0914313763486025510e-6")},
                        within(1e-19)));
}

// ---- by the deformation gradient ----------------------------------------------------------------------------

template <class T, int D>
using Matrix = std::array<std::array<T, D>, D>;

template <class T, int D>
T minor_of(const Matrix<T, D>& f, int i, int j) {
  if constexpr (D == 2)
    return T(i == j ? 1.0 : -1.0) * f[1 - i][1 - j];
  else
    return f[(i + 1) % 3][(j + 1) % 3] * f[(i + 2) % 3][(j + 2) % 3] -
           f[(i + 1) % 3][(j + 2) % 3] * f[(i + 2) % 3][(j + 1) % 3];
}

/// V P(F) for each kind of solid; a, b are its constants, F_33 = 1 in the plane.
enum class Kind { stvk, neo_hookean, stable, polynomial, corotated, viscous };

/// The rotation next to F: Newton's iteration R <- (R + R^-T)/2 from R = F, which doubles the digits of coefficient 0 and then
/// the orders: from strains of 0.3 some 7 times for 50 digits and 5 for 20 orders.
template <class T, int D>
Matrix<T, D> rotation_next_to(const Matrix<T, D>& f) {
  Matrix<T, D> rotation = f;
  for (int n = 0; n < 12; ++n) {
    Matrix<T, D> cof;
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) cof[r][c] = minor_of<T, D>(rotation, r, c);
    T det(0.0);
    for (int c = 0; c < D; ++c) det += rotation[0][c] * cof[0][c];
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) rotation[r][c] = T(0.5) * (rotation[r][c] + cof[r][c] / det);
  }
  return rotation;
}

template <Kind kind, class T, int D>
Matrix<T, D> piola(const Matrix<T, D>& f, const Matrix<T, D>& rate, const T& a, const T& b) {
  using std::log;
  Matrix<T, D> cof, p;
  T j(0.0), i_1(D == 2 ? 1.0 : 0.0);
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c) {
      cof[r][c] = minor_of<T, D>(f, r, c);
      if (r == 0) j += f[r][c] * cof[r][c];
      i_1 += f[r][c] * f[r][c];
    }
  if constexpr (kind == Kind::stvk || kind == Kind::viscous) {
    Matrix<T, D> e;
    T trace(0.0);
    for (int r = 0; r < D; ++r) {
      for (int c = 0; c < D; ++c) {
        e[r][c] = T(kind == Kind::stvk && r == c ? -1.0 : 0.0);
        for (int k = 0; k < D; ++k)
          e[r][c] +=
              kind == Kind::stvk ? T(f[k][r] * f[k][c]) : T(f[k][r] * rate[k][c] + rate[k][r] * f[k][c]);
        e[r][c] *= T(0.5);
      }
      trace += e[r][r];
    }
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) {
        p[r][c] = a * trace * f[r][c];
        for (int k = 0; k < D; ++k) p[r][c] += T(2.0) * b * f[r][k] * e[k][c];
      }
  } else if constexpr (kind == Kind::corotated) {  // P = 2 mu (F - R) + lambda tr(R^T F - 1) R
    const auto turn = rotation_next_to<T, D>(f);
    T stretch(-double(D));
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) stretch += turn[r][c] * f[r][c];
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) p[r][c] = T(2.0) * b * (f[r][c] - turn[r][c]) + a * stretch * turn[r][c];
  } else {
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) {
        const T& g = f[r][c];
        if constexpr (kind == Kind::neo_hookean)
          p[r][c] = b * (g - cof[r][c] / j) + a * log(j) * cof[r][c] / j;
        else if constexpr (kind == Kind::stable)
          p[r][c] = b * g * i_1 / (i_1 + T(1.0)) + a * (j - T(1.0) - T(3.0) * b / (T(4.0) * a)) * cof[r][c];
        else
          p[r][c] = b * g + a * (j - T(1.0) - b / a) * cof[r][c];
      }
  }
  return p;
}

/// f = -V P B^T: the columns are the forces on participants 1 .. D. B is the inverse of the edges from participant 0 at rest.
template <Kind kind, int D>
struct ByGradient {
  static constexpr const char* name = "by_gradient";
  static constexpr int participants = D + 1;
  static constexpr std::array dimensions{D};
  static constexpr bool external = true;
  static constexpr std::array<const char*, 2> material{"a", "b"};
  static constexpr auto parameters = [] {
    std::array<const char*, D * D + 3> names;
    names.fill("of the element");
    return names;
  }();

  template <class T>
  static std::array<T, D * D + 3> at_rest(const std::array<Vector<T, D>, D + 1>& x, const T& a, const T& b) {
    Matrix<T, D> edges;
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) edges[r][c] = x[c + 1][r] - x[0][r];
    T det(0);
    for (int c = 0; c < D; ++c) det += edges[0][c] * minor_of<T, D>(edges, 0, c);
    std::array<T, D * D + 3> all;
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) all[r * D + c] = minor_of<T, D>(edges, c, r) / det;
    all[D * D] = det / T(D == 3 ? 6 : 2);
    all[D * D + 1] = a;
    all[D * D + 2] = b;
    return all;
  }

  template <class T, class... C>
  static std::array<Vector<T, D>, D + 1> forces(const Participants<T, D, D + 1>& p, const C&... c) {
    const std::array<T, D * D + 3> all{c...};
    const auto gradient = [&](const std::array<Vector<T, D>, D + 1>& x) {
      Matrix<T, D> f;
      for (int r = 0; r < D; ++r)
        for (int s = 0; s < D; ++s) {
          f[r][s] = T(0.0);
          for (int k = 0; k < D; ++k) f[r][s] += T(x[k + 1][r] - x[0][r]) * all[k * D + s];
        }
      return f;
    };
    const auto stress =
        piola<kind, T, D>(gradient(p.position), gradient(p.velocity), all[D * D + 1], all[D * D + 2]);
    std::array<Vector<T, D>, D + 1> f;
    for (auto& x : f) x.setZero();
    for (int i = 1; i <= D; ++i)
      for (int r = 0; r < D; ++r) {
        for (int k = 0; k < D; ++k) f[i][r] -= all[D * D] * stress[r][k] * all[(i - 1) * D + k];
        f[0][r] -= f[i][r];
      }
    return f;
  }
};

/// Both in 50 digits: rounding 1e-50 times some 1e3 terms, grown by cancellation to less than 1e-45.
template <class L, Kind kind>
void expect_by_gradient(std::array<Digits50, L::material.size()> material, const Digits50& a,
                        const Digits50& b) {
  SCOPED_TRACE(L::name);
  constexpr int d = L::dimensions[0], degree = 20;
  if constexpr (d == 2) material[2] = 1;
  const auto actual = series_of<L, Digits50>(material, degree);
  const auto expected = series_of<ByGradient<kind, d>, Digits50>({a, b}, degree);
  for (int k = 2; k <= degree; ++k)
    EXPECT_THAT(actual[k], IsCloseTo(expected[k], within(1e-45))) << "order " << k;
}

TEST(OneElement, IsThatOfTheDeformationGradient) {
  const Digits50 lambda = Digits50(7) / 5, mu = Digits50(11) / 10, l = lambda + 5 * mu / 6, m = 4 * mu / 3;
  expect_by_gradient<Stvk, Kind::stvk>({lambda, mu}, lambda, mu);
  expect_by_gradient<NeoHookean, Kind::neo_hookean>({lambda, mu}, lambda, mu);
  expect_by_gradient<StableNeoHookean, Kind::stable>({lambda, mu}, l, m);
  expect_by_gradient<PolynomialNeoHookean, Kind::polynomial>({lambda, mu}, lambda + mu, mu);
  expect_by_gradient<Corotated, Kind::corotated>({lambda, mu}, lambda, mu);
  expect_by_gradient<KelvinVoigt, Kind::viscous>({lambda, mu}, lambda, mu);
}
TEST(OneElement, InThePlaneIsThatOfTheDeformationGradient) {
  const Digits50 lambda = Digits50(7) / 5, mu = Digits50(11) / 10, l = lambda + 5 * mu / 6, m = 4 * mu / 3;
  expect_by_gradient<PlaneStvk, Kind::stvk>({lambda, mu}, lambda, mu);
  expect_by_gradient<PlaneNeoHookean, Kind::neo_hookean>({lambda, mu}, lambda, mu);
  expect_by_gradient<PlaneStableNeoHookean, Kind::stable>({lambda, mu}, l, m);
  expect_by_gradient<PlanePolynomialNeoHookean, Kind::polynomial>({lambda, mu}, lambda + mu, mu);
  expect_by_gradient<PlaneCorotated, Kind::corotated>({lambda, mu}, lambda, mu);
  expect_by_gradient<PlaneKelvinVoigt, Kind::viscous>({lambda, mu}, lambda, mu);
}

}  // namespace
}  // namespace jetlag::testing::one_element_test
