// SPDX-License-Identifier: MIT
#include "accuracy/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace jetlag::accuracy {

namespace {

/// Uniform in [0, 1), the same on every machine.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 bits_;
};

constexpr std::array kinds{"u_0 + s t", "random, falling", "random", "positive, falling",
                           "even",      "random, growing"};

/// Coefficients 1, 2, ... of an operand: u_k = s times what the kind says.
Computed series(double u_0, double s, std::size_t kind, Draw& draw) {
  Computed u(u_0);
  for (int k = 1; k <= degree; ++k) {
    const double random = 2 * draw() - 1, sign = k % 4 == 0 ? -1 : 1;
    const std::array factors{k == 1 ? 1.0 : 0.0,
                             std::ldexp(random, -k),
                             random,
                             std::ldexp(std::abs(random), -k),
                             k % 2 == 0 ? sign * std::abs(random) : 0.0,
                             std::ldexp(random, k / 2)};
    u[k] = factors[kind] * s;
  }
  return u;
}

/// "u_0 = 0.25, k = 17, random"
std::string place(const Operands& operands, int k, const char* kind) {
  std::string text;
  char number[40];
  for (const Computed& u : operands) {
    std::snprintf(number, sizeof number, "%.6g", u[0]);
    text += (text.empty() ? "" : "; ") + std::string(number);
  }
  return k == 0 ? text : text + ", k = " + std::to_string(k) + ", " + kind;
}

/// |difference| / unit; infinity where the difference is not finite.
double in_units(const Precise& difference, const Precise& unit) {
  if (difference == 0) return 0;
  const double error = static_cast<double>(Precise(difference / unit));
  return std::isnan(error) ? HUGE_VAL : error;
}

void compare(const Function& f, const Operands& operands, const char* kind, Measured& measured) {
  const Computed computed = f.computed(operands);
  const True truth = f.truth(operands);
  const Terms terms = f.terms(operands);
  for (int k = 0; k <= degree; ++k) {
    const Precise size = abs(truth[k]), sum = std::max(size, terms.sum[k]),
                  condition = std::max(size, terms.condition[k]);
    if (!(condition < 0x1p1000)) return;
    if (sum < 0x1p-970 && sum != 0) continue;
    ++measured.coefficients;
    const Precise difference = abs(Precise(computed[k] - truth[k]));
    const double error = in_units(difference, Precise(ldexp(condition, -52)));
    if (k > 0) measured.strict = std::max(measured.strict, in_units(difference, Precise(ldexp(sum, -52))));
    Where& worst = k == 0 ? measured.first : measured.later;
    if (error > worst.error) worst = {error, place(operands, k, kind)};
  }
}

}  // namespace

void for_each_point(const Function& function, int draws,
                    const std::function<void(const Operands&, const char*)>& f) {
  Draw draw(2026);
  std::vector<std::vector<double>> points;  // one u_0 for each operand
  points.emplace_back();
  for (const Domain& domain : function.domains) {  // all combinations of the corners
    std::vector<std::vector<double>> more;
    for (const auto& point : points)
      for (const double corner : domain.corners) {
        more.push_back(point);
        more.back().push_back(corner);
      }
    points = std::move(more);
  }
  for (int i = 0; i < draws; ++i) {
    points.emplace_back();
    for (const Domain& domain : function.domains) points.back().push_back(domain.draw(draw()));
  }
  for (const auto& point : points)
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      Operands operands;
      const double fraction = std::exp2(-3 * draw());
      for (std::size_t a = 0; a < point.size(); ++a)
        operands.push_back(series(point[a], fraction * function.domains[a].scale(point[a]), kind, draw));
      f(operands, kinds[kind]);
    }
}

Measured measure(const Function& function, int draws) {
  Measured measured;
  for_each_point(function, draws, [&](const Operands& operands, const char* kind) {
    compare(function, operands, kind, measured);
  });
  return measured;
}

}  // namespace jetlag::accuracy
