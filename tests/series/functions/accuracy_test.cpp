// SPDX-License-Identifier: MIT
// Every function keeps its limit of accuracy, and every rule of the register is in the table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "accuracy/functions.hpp"
#include "accuracy/measure.hpp"
#include "accuracy/terms.hpp"
#include "jetlag/series/functions.hpp"

namespace jetlag::accuracy {
namespace {

// ---- the functions -------------------------------------------------------------------------------------------

class Accuracy : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Function& f = functions()[GetParam()];
};

std::string as_test_name(const std::string& name) {
  std::string letters;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      letters += c;
    else if (const auto at = std::string("+-/<").find(c); at != std::string::npos)
      letters += std::vector<std::string>{"plus", "minus", "over", "below"}[at];
  return letters;
}
INSTANTIATE_TEST_SUITE_P(Functions, Accuracy, ::testing::Range<std::size_t>(0, functions().size()),
                         [](const auto& info) { return as_test_name(functions()[info.param].name); });

TEST_P(Accuracy, IsWithinTheLimit) {  // at the corners and a few draws; the table has 500
  const Measured m = measure(f, 10);
  EXPECT_LE(m.first.error, f.limit()) << m.first.point;
  EXPECT_LE(m.later.error, f.limit()) << m.later.point;
  EXPECT_GE(m.coefficients, 500);
}

TEST_P(Accuracy, IsMeasuredAgainstTheTruth) {
  // Forward differences of the function of numbers: D^k f(u(t)) / (k! d^k) = v_k + sum_{i>k} c_i v_i d^{i-k} with
  // c_i <= (20 i)^{i-k} < 1e3^{i-k}, d = 1e-24; the rounding of 750 digits is multiplied by 2^20 / d^k < 1e490. What is
  // below 1e-250 counts as 0 (also the v_i with i > 25).
  using Number = Wide::value_type;
  const Number d = pow(Number(10), -24);
  for_each_point(f, 1, [&](const Operands& u, const char* kind) {
    if (kind != std::string("random")) return;  // one of the six kinds: the same recurrences
    std::vector<Number> differences;
    for (int i = 0; i <= degree; ++i) {
      std::vector<Wide> at;
      for (const Computed& series : u) {
        std::vector<Number> wide(series.coefficients().begin(), series.coefficients().end());
        at.emplace_back(evaluate(wide, Number(i * d)));
      }
      differences.push_back(f.value(at)[0]);
    }
    const True truth = f.truth(u), terms = f.terms(u).sum;
    const auto size = [&](int k) { return std::max(Precise(abs(truth[k])), terms[k]); };
    Precise largest = size(0);  // |f(u(t))| at t <= 20 d
    for (int i = 1; i <= True::degree; ++i) largest += pow(Precise(10), -22 * i) * size(i);
    Number power = 1;  // k! d^k
    for (int k = 0; k <= degree; ++k, power *= k * d) {
      Precise allowed = pow(Precise(10), -250) + Precise(1e-70) * size(k) +
                        Precise(Number(largest * pow(Number(10), -740) / power));
      for (int i = k + 1; i <= True::degree; ++i) allowed += pow(Precise(10), 21 * (k - i)) * size(i);
      if (!(allowed < 0x1p1000)) break;
      const Precise error(abs(Number(differences[0] / power - Number(truth[k]))));
      EXPECT_LE(error, allowed) << "at " << u[0][0] << ", k = " << k << ", " << kind;
      for (std::size_t i = 0; i + 1 < differences.size(); ++i)
        differences[i] = differences[i + 1] - differences[i];
      differences.pop_back();
    }
  });
}

// ---- the table -----------------------------------------------------------------------------------------------

template <class... R>
std::set<std::string> names_of(RuleList<R...>) {
  return {R::name...};
}

TEST(AccuracyTable, CoversEveryRule) {
  std::set<std::string> measured;
  for (const Function& f : functions()) measured.insert(f.rules.begin(), f.rules.end());
  EXPECT_EQ(measured, names_of(Rules{}));
}

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> text;
  std::istringstream in(row);
  for (std::string cell; std::getline(in, cell, '|');) text.push_back(cell);
  return text;
}

TEST(AccuracyTable, HasARowForEveryFunctionWithinItsLimit) {
  std::ifstream file(JETLAG_SOURCE_DIR "/bench/accuracy/table.md");
  std::vector<std::string> named, expected;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| `")) continue;
    const auto row = cells(line);  // "", name, domain, rule, 0, 1 ... 20, limit, worst at, strict
    ASSERT_EQ(row.size(), 9U) << line;
    named.push_back(row[1].substr(2, row[1].size() - 4));
    EXPECT_LE(std::stod(row[4]), std::stod(row[6])) << line;
    EXPECT_LE(std::stod(row[5]), std::stod(row[6])) << line;
  }
  for (const Function& f : functions()) expected.push_back(f.name);
  EXPECT_EQ(named, expected) << "run `./run accuracy`";
}

// ---- the measure itself --------------------------------------------------------------------------------------

const Function& named(const std::string& name) {
  return *std::ranges::find(functions(), name, &Function::name);
}

TEST(AccuracyMeasure,
     SeesAnErrorInOneCoefficient) {  // v_7 a unit of 2^-48 too large: 16 units, if C_7 = |v_7|
  Function f = named("square(u)");
  f.domains[0].corners = {1.0};
  f.computed = [](const Operands& u) {
    Computed v = square(u[0]);
    v[7] *= 1 + 0x1p-48;
    return v;
  };
  const Measured m = measure(f, 0);
  EXPECT_NEAR(m.strict, 16.0, 2.0);
  EXPECT_THAT(m.later.point, ::testing::HasSubstr("k = 7"));
  EXPECT_EQ(m.first.error, 0.0);
}

TEST(AccuracyMeasure, TakesWhatIsNotANumberForTheWorst) {
  Function f = named("exp(u)");
  f.computed = [](const Operands&) { return Computed(std::nan("")); };
  EXPECT_EQ(measure(f, 0).first.error, HUGE_VAL);
}

TEST(AccuracyMeasure, CountsTermsByTheirFactors) {
  // exp(u), u = 1 - t + t^2/4:  |u| - 1 = t + t^2/4, so that S = e exp(t + t^2/4) and C = e (t + 2 t^2/4) exp(...)
  Computed u = Computed::from({1.0, -1.0, 0.25});
  const Terms terms = terms_of_function([](const auto& x) { return exp(x); }, u);
  const Precise e = exp(Precise(1));
  EXPECT_LT(abs(Precise(terms.sum[2] - e * 3 / 4)), 1e-70);        // t^2/2 + t^2/4
  EXPECT_LT(abs(Precise(terms.condition[2] - e * 5 / 4)), 1e-70);  // 2 t^2/2 + t^2/4
  EXPECT_EQ(terms.condition[0], 0);
}

}  // namespace
}  // namespace jetlag::accuracy
