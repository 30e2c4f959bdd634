// SPDX-License-Identifier: MIT
// Checked jets say where a function has no Taylor series; everywhere else they are jets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"

namespace jetlag::testing::checked_jet_test {
namespace {

/// The message that f throws as a SingularPoint.
template <class F>
std::string message(F f) {
  try {
    f();
  } catch (const SingularPoint& e) {
    return e.what();
  }
  return "nothing is thrown";
}

/// Static and dynamic jets say the same.
template <class J>
class Checked : public ::testing::Test {
 protected:
  /// x + t to degree 4.
  static J variable(double x) {
    if constexpr (J::degree_at_compile_time == Dynamic)
      return J::variable(x, 4);
    else
      return J::variable(x);
  }
  const J t = variable(0.0);
};
using Jets = ::testing::Types<CheckedJet<double, 4>, CheckedJet<double, Dynamic>>;
struct NameOfJet {
  template <class J>
  static std::string GetName(int) {
    return J::degree_at_compile_time == Dynamic ? "Dynamic" : "Static";
  }
};
TYPED_TEST_SUITE(Checked, Jets, NameOfJet);

TYPED_TEST(Checked, NamesFunctionOrderAndValue) {
  const auto& t = this->t;
  using J = TypeParam;
  EXPECT_EQ(message([&] { log(t); }), "log: coefficient 0 does not exist at u_0 = 0");
  EXPECT_EQ(message([&] { log(t - 0.1); }), "log: coefficient 0 does not exist at u_0 = -0.1");
  EXPECT_EQ(message([&] { sqrt(t); }), "sqrt: coefficient 1 does not exist at u_0 = 0");
  EXPECT_EQ(message([&] { sqrt(t - 2.0); }), "sqrt: coefficient 0 does not exist at u_0 = -2");
  EXPECT_EQ(message([&] { sqrt(-t * t); }), "sqrt: coefficient 1 does not exist at u_0 = 0");
  EXPECT_EQ(message([&] { 1.0 / t; }), "reciprocal: coefficient 0 does not exist at c = 1, u_0 = 0");
  EXPECT_EQ(message([&] { J(1.0) / t; }), "divide: coefficient 0 does not exist at u_0 = 1, v_0 = 0");
  EXPECT_EQ(message([&] { t / (t * t); }), "divide: coefficient 0 does not exist at u_0 = 0, v_0 = 0");
  EXPECT_EQ(message([&] { t / 0.0; }), "divide by constant: coefficient 0 does not exist at u_0 = 0, c = 0");
  EXPECT_EQ(message([&] { (1.0 + t) / J(0.0); }), "divide: coefficient 0 does not exist at u_0 = 1, v_0 = 0");
  EXPECT_EQ(message([&] { pow(t, 1.5); }), "power: coefficient 2 does not exist at c = 1.5, u_0 = 0");
  EXPECT_EQ(message([&] { pow(t - 1.0, 0.5); }), "power: coefficient 0 does not exist at c = 0.5, u_0 = -1");
  EXPECT_EQ(message([&] { pow(t, -2); }), "reciprocal: coefficient 0 does not exist at c = 1, u_0 = 0");
  EXPECT_EQ(message([&] { exp(1000.0 + t); }),
            "exp: coefficient 0 does not exist at u_0 = 1000");  // as a double
}

TYPED_TEST(Checked, IsADomainErrorThatAProgramCanRead) {
  try {
    sqrt(this->t);
    FAIL() << "nothing is thrown";
  } catch (const std::domain_error& e) {
    const auto& point = dynamic_cast<const SingularPoint&>(e);
    EXPECT_STREQ(point.function(), "sqrt");
    EXPECT_EQ(point.order(), 1);
  }
}

TYPED_TEST(Checked, DoesNotThrowWhereTheSeriesExists) {
  const auto& t = this->t;
  using J = TypeParam;
  EXPECT_EQ(known_degree(t / t), 3);  // what is lost is no singular point
  EXPECT_EQ(known_degree(sqrt(t * t + t * t * t)), 3);
  EXPECT_EQ(known_degree(pow(t * t, 1.5)), 4);
  EXPECT_EQ(known_degree(pow(t, 4.5)), 4);  // its coefficient 5 does not exist
  EXPECT_EQ(pow(t, 0), J(1.0));
  EXPECT_EQ(known_degree(exp(sin(t)) / cos(t) + log(1.0 + t) * sqrt(2.0 - t)), 4);
}

TYPED_TEST(Checked, PassesOnWhatIsNotKnown) {
  EXPECT_EQ(known_degree(exp(this->t / this->t)), 3);
  EXPECT_EQ(known_degree(sqrt(this->t / this->t) * 2.0), 3);
  const TypeParam missing(std::numeric_limits<double>::quiet_NaN());  // the caller's own NaN
  EXPECT_EQ(known_degree(log(missing)), -1);
}

TEST(CheckedJet, HasTheBitsOfTheQuietJet) {
  const auto f = [](const auto& x) { return sin(exp(x) / sqrt(x)) - log(x) * pow(x, 2.7); };
  const auto quiet = f(Jet<double, 9>::variable(1.25));
  EXPECT_EQ((Jet<double, 9>(f(CheckedJet<double, 9>::variable(1.25)))), quiet);
}

TEST(CheckedJet, ShowsANumberShortly) {
  using Nested = Jet<Jet<double, 1>, 2, Singularities::checked>;
  EXPECT_EQ(message([] { log(Nested(Jet<double, 1>::variable(-0.3))); }),
            "log: coefficient 0 does not exist at u_0 = -0.3");
  EXPECT_EQ(message([] { log(CheckedJet<float, 2>(-0.3f)); }),
            "log: coefficient 0 does not exist at u_0 = -0.3");
}

}  // namespace
}  // namespace jetlag::testing::checked_jet_test
