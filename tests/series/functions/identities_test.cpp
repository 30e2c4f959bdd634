// SPDX-License-Identifier: MIT
// Identities between functions hold for every coefficient, in every number type.
#include <gtest/gtest.h>

#include "jetlag/series/elementary.hpp"
#include "support/close.hpp"
#include "support/number_types.hpp"
#include "support/random_series.hpp"

namespace jetlag::testing {
namespace {

template <class T>
class Identities : public ::testing::Test {
 protected:
  template <int N, class F>
  void at_random_series(F f) {
    testing::at_random_series<T, N>(f);
  }
};
TYPED_TEST_SUITE(Identities, NumberTypes, NameOfNumberType);

TYPED_TEST(Identities, SquaresOfSinAndCosSumToOne) {
  this->template at_random_series<12>([](const auto& u) {
    using J = std::decay_t<decltype(u)>;
    EXPECT_THAT(square(sin(u)) + square(cos(u)), IsCloseTo(J(1.0)));
  });
  this->template at_random_series<60>([](const auto& u) {
    using J = std::decay_t<decltype(u)>;
    EXPECT_THAT(square(sin(u)) + square(cos(u)), IsCloseTo(J(1.0)));
  });
}

TYPED_TEST(Identities, SinTurnsSumsIntoProducts) {
  this->template at_random_series<12>([](const auto& u) {
    const auto v = 0.5 - u / 4;
    EXPECT_THAT(sin(u + v), IsCloseTo(sin(u) * cos(v) + cos(u) * sin(v)));
    EXPECT_THAT(cos(u + v), IsCloseTo(cos(u) * cos(v) - sin(u) * sin(v)));
  });
}

TYPED_TEST(Identities, ExpTurnsSumsIntoProducts) {
  this->template at_random_series<12>([](const auto& u) {
    const auto v = 0.5 - u / 4;
    EXPECT_THAT(exp(u + v), IsCloseTo(exp(u) * exp(v)));
  });
}

TYPED_TEST(Identities, ExpAndLogAreInverse) {
  this->template at_random_series<12>([](const auto& u) {
    EXPECT_THAT(exp(log(u)), IsCloseTo(u));
    EXPECT_THAT(log(exp(u)), IsCloseTo(u));
  });
}

TYPED_TEST(Identities, LogTurnsProductsIntoSums) {
  this->template at_random_series<12>([](const auto& u) {
    const auto v = 1.5 + u * u;
    EXPECT_THAT(log(u * v), IsCloseTo(log(u) + log(v)));
  });
}

TYPED_TEST(Identities, SqrtSquaredIsItsArgument) {
  this->template at_random_series<12>([](const auto& u) {
    EXPECT_THAT(sqrt(u) * sqrt(u), IsCloseTo(u));
    EXPECT_THAT(sqrt(u), IsCloseTo(pow(u, 0.5)));
  });
}

TYPED_TEST(Identities, StretchInvariantsAreSumsOfStretches) {  // of u, 3/2 and 1/4
  this->template at_random_series<12>([](const auto& u) {
    using J = std::decay_t<decltype(u)>;
    const J squared = u * u;
    const auto [a, b] = stretch_invariants(J(squared + 2.3125), J(2.3125 * squared + 0.140625), J(0.375 * u));
    EXPECT_THAT(a, IsCloseTo(J(u + 1.75)));
    EXPECT_THAT(b, IsCloseTo(J(1.75 * u + 0.375)));
  });
}

TYPED_TEST(Identities, PowersAddTheirExponents) {  // binary fractions: exact in every number type
  this->template at_random_series<12>([](const auto& u) {
    EXPECT_THAT(pow(u, 1.75) * pow(u, -0.5), IsCloseTo(pow(u, 1.25)));
    EXPECT_THAT(pow(u, 2.5) * pow(u, 1.5), IsCloseTo(pow(u, 4)));
    EXPECT_THAT(pow(u, -2), IsCloseTo(square(1.0 / u)));
    EXPECT_THAT(pow(u, 0.75), IsCloseTo(exp(0.75 * log(u))));
  });
}

TYPED_TEST(Identities, QuotientTimesDivisorIsTheDividend) {
  this->template at_random_series<12>([](const auto& u) {
    const auto v = sin(u) + 2.0;
    EXPECT_THAT(u / v * v, IsCloseTo(u));
    EXPECT_THAT(1.0 / v, IsCloseTo(std::decay_t<decltype(u)>(1.0) / v));
  });
}

TYPED_TEST(Identities, SquareIsTheProductWithItself) {
  this->template at_random_series<12>([](const auto& u) { EXPECT_THAT(square(u), IsCloseTo(u * u)); });
}

TYPED_TEST(Identities, ProductsDistribute) {
  this->template at_random_series<12>([](const auto& u) {
    const auto v = cos(u), w = exp(-u);
    EXPECT_THAT(u * (v - w), IsCloseTo(u * v - u * w));
  });
}

}  // namespace
}  // namespace jetlag::testing
