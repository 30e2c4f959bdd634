// SPDX-License-Identifier: MIT
// A scalar whose operations are recurrences gives the coefficients of jets, order by order.
#include "jetlag/series/online/online.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "jetlag/series/online/vector.hpp"
#include "support/functions_of_two.hpp"

namespace jetlag::testing::online_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int degree = 10;
using J = Jet<double, degree>;

const J x = [] {
  J u;
  for (int k = 0; k <= degree; ++k) u[k] = 0.4375 / (1 + k * k);
  return u;
}();
const J y = [] {
  J u;
  for (int k = 0; k <= degree; ++k) u[k] = 1.5 / (k % 2 == 0 ? 1 + k : -2 - k);
  return u;
}();

/// Coefficients 0 .. degree of f(x, y), and how many histories they take.
template <class F>
std::vector<double> online(const F& f, int& used) {
  std::vector<double> memory(200 * orders_of_histories), coefficients;
  for (int k = 0; k <= degree; ++k) {
    Histories histories{memory.data(), k};
    const Online u = Online::kept(x[k], histories), v = Online::input(&y[0], 1, histories);
    coefficients.push_back(f(u, v).newest().value);
    EXPECT_TRUE(k == 0 || histories.used == used) << "order " << k;
    used = histories.used;
  }
  return coefficients;
}

TEST(Online, IsEveryFunctionOnJets) {
  // Two ways to add the same terms, with reciprocals in one of them: some k + 2 roundings of the largest term in each of the
  // operations of a function, six at most, and what they make of what follows.
  const auto check = [&](const char* name, const auto& f) {
    int used = 0;
    const auto found = online(f, used);
    const J expected = f(x, y);
    double largest = 0;
    for (int k = 0; k <= degree; ++k) {
      largest = std::max(largest, std::abs(expected[k]));
      EXPECT_NEAR(found[k], expected[k], 64 * (k + 2) * eps * largest) << name << ", order " << k;
    }
  };
  std::apply([&](const auto&... named) { (check(named.name, named.f), ...); }, smooth_functions);
}

TEST(Online, OperatorsAreThoseOfJets) {
  int used = 0;
  const auto f = [](const auto& u, const auto& v) {
    auto w = u * v - v / u + (2.0 - u) * 3.0 / (1.5 + v) - 4.0;
    w += u;
    w -= v * v;
    w *= 0.5 / v;
    w /= u - 2.5;
    return -w / 8.0;
  };
  const auto found = online(f, used);
  const J expected = f(x, y);
  for (int k = 0; k <= degree; ++k)
    EXPECT_NEAR(found[k], expected[k], 512 * eps * std::abs(expected[0])) << "order " << k;
}

TEST(Online, ANumberHasNoHistory) {
  int used = 0;
  online([](const Online& u, const Online&) { return u + Online(3.0) * Online(0.5) - sqrt(Online(2.0)); },
         used);
  EXPECT_EQ(used, 1 + 2);  // u, and two sums with a number
  online([](const Online& u, const Online&) { return u * u; }, used);
  EXPECT_EQ(used, 1 + 1);
}

TEST(Online, VectorsDoWhatLawsAskOfThem) {
  using V = Eigen::Matrix<Online, 3, 1>;
  using W = Eigen::Matrix<J, 3, 1>;
  const auto f = [](const auto& a, const auto& b, const auto& s) {
    auto c = a.cross(b);
    c += s * a - b / s;
    c -= b * s;
    c *= s;
    return std::decay_t<decltype(s)>(c.dot(a) + c.squaredNorm() - (-a).norm() + c[2] * c(1));
  };
  int used = 0;
  const auto found = online(
      [&](const Online& u, const Online& v) {
        V a = V::Zero(), b = V::Constant(v);
        for (int c = 0; c < V::size(); ++c) a[c] = u + Online(c);
        return f(a, b, v);
      },
      used);
  W a, b;
  for (int c = 0; c < 3; ++c) a[c] = x + J(c), b[c] = y;
  const J expected = f(a, b, y);
  double largest = 0;
  for (int k = 0; k <= degree; ++k) {
    largest = std::max(largest, std::abs(expected[k]));
    EXPECT_NEAR(found[k], expected[k], 64 * (k + 2) * eps * largest) << "order " << k;
  }
}

}  // namespace
}  // namespace jetlag::testing::online_test
