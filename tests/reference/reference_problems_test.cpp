// SPDX-License-Identifier: MIT
// Every initial value problem of the reference file, to the digits that its conditioning leaves.
#include "studies/reference/reference_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "reference/conditioning.hpp"
#include "support/digits50.hpp"
#include "support/engine_of_numbers.hpp"

namespace jetlag::testing {
namespace {

class Reference : public ::testing::TestWithParam<std::string> {};

/// Measured (AVX-512), error / tolerance, and what enlarges it:
///   arenstorf A, B                  3e-11, 4e-11 / 2e-8    two passages of the moon, growth 2e6
///   kepler e = .1 .. .9             2e-14 .. 8e-14 / 5e-14 .. 4e-12   the phase, growth 10 .. 340
///   lotka-volterra, van der Pol     2e-15, 2e-16 / 9e-14, 5e-14       a limit cycle: growth 11, 5
///   euler rigid                     5e-16, 2e-15 / 2e-13              growth 27, 29
///   henon-heiles t = 10, 100        1e-16, 4e-15 / 7e-15, 2e-13       growth 2, 14
///   pleiades                        6e-12 / 2e-10          close encounters, growth 1e4
///   figure-eight                    3e-15 / 2e-13          growth 31
///   pythagorean                     8e-11 / 3e-9           close encounters, growth 2e5
///   lorenz                          7e-15 / 3e-13          growth 40
///   double pendulum                 2e-14 / 3e-12          growth 290
///   FPUT                            3e-16 / 6e-15          growth 2
///   outer solar system              2e-13 / 1e-12          Jupiter's phase, growth 170
TEST_P(Reference, ProblemHasItsEndValues) {
  const auto all = reference_problems();
  const auto problem = std::ranges::find(all, GetParam(), &ReferenceProblem::name);
  ASSERT_NE(problem, all.end()) << GetParam() << " has values and no problem";
  const ReferenceSolution solution = problem->solve(20, {});
  ASSERT_EQ(solution.report.outcome, Outcome::success) << solution.report.message;
  const auto& values = reference_values().at(GetParam());
  ASSERT_EQ(solution.end.size(), values.size());
  std::vector<long double> known;
  for (const std::string& value : values) known.push_back(std::stold(value));
  const double tolerance = rounding_tolerance(*problem, solution);
  EXPECT_LT(tolerance, 1e-7);  // it proves something
  EXPECT_LT(error(solution.end, known), tolerance);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, values] : reference_values()) all.push_back(name);
  return all;
}
std::string as_test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace_if(name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(OfTheFile, Reference, ::testing::ValuesIn(names()), as_test_name);

TEST(ReferenceValues, AreThoseOfTheFile) {
  const std::filesystem::path path =
      std::filesystem::path(JETLAG_SHARED_DIR) / "reference/initial_value_problems.json";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  const auto json = nlohmann::json::parse(std::ifstream(path));
  std::map<std::string, std::vector<std::string>> file;
  for (const auto& [name, one] : json.at("cases").items())
    file[name] = one.at("values").get<std::vector<std::string>>();
  EXPECT_EQ(reference_values(), file);
}

TEST(ReferenceValues, AreReachedToTheirLastDigitInFiftyDigits) {
  // The values have 22 or 23 digits, at least 20 behind the point for the largest, 25.
  const auto& values = reference_values().at("lorenz63 (10,28,8/3) u0=(0,1,1.05) t=5");
  FirstOrderTaylor<Digits50> method(lorenz, 3, {.parameters = {10, 28, Digits50(8) / 3}});
  FirstOrderState<Digits50> state{0, {0, 1, Digits50("1.05")}};
  ASSERT_EQ(method.run(state, 5).outcome, Outcome::success);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(static_cast<double>(abs(Digits50(state.y[i] - Digits50(values[i])))), 1e-20) << i;
}

}  // namespace
}  // namespace jetlag::testing
