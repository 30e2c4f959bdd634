// SPDX-License-Identifier: MIT
#include "jetlag/truncation/truncation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"

namespace jetlag {

TruncationLaw::TruncationLaw(std::string name, std::vector<double> tail, Weighting weighting)
    : name_(std::move(name)), tail_(std::move(tail)), weighting_(weighting), min_(0) {
  const auto refuse = [&](const char* relation, int n, const char* why) {
    throw std::invalid_argument(name_ + ": P(K " + relation + " " + std::to_string(n) + ") " + why);
  };
  if (tail_.size() < 2) throw std::invalid_argument(name_ + ": the largest degree must be at least 1");
  if (tail_[0] != 1.0) refuse(">=", 0, "must be 1");
  for (std::size_t n = 1; n < tail_.size(); ++n) {
    if (!(tail_[n] <= tail_[n - 1]))
      refuse(">=", static_cast<int>(n), "must not be larger than the one before");
    if (!(tail_[n] > 0.0) || !std::isfinite(1.0 / tail_[n]))
      refuse(">=", static_cast<int>(n),
             "is so small that the weight 1/P overflows; take a smaller degree or probability");
    if (tail_[n] == 1.0) min_ = static_cast<int>(n);
  }
  if (weighting_ == Weighting::single_term)
    for (int n = min_ + 1; n <= max_degree(); ++n)
      if (!std::isfinite(1.0 / exactly(n)))
        refuse("=", n, "must be > 0, with a finite inverse: every single term must be drawn sometimes");
}

double TruncationLaw::weight(int n, int degree) const {
  if (weighting_ == Weighting::coupled_sum) return weight(n);
  if (n <= min_) return 1.0;
  return n == degree ? 1.0 / exactly(n) : 0.0;
}

double TruncationLaw::mean() const {
  double sum = 0;
  for (std::size_t n = tail_.size(); n-- > 1;) sum += tail_[n];
  return sum;
}

double TruncationLaw::largest_ratio() const {
  double least = 1;
  for (int n = min_ + 1; n <= max_degree(); ++n) least = std::min(least, tail_[n] / tail_[n - 1]);
  return std::sqrt(least);
}

int TruncationLaw::draw(double u) const {
  int k = min_;
  while (k < max_degree() && u <= tail_[k + 1]) ++k;
  return k;
}

TruncationLaw fixed_degree(int degree) {
  if (degree < 1)
    throw std::invalid_argument("fixed: degree must be at least 1, got " + std::to_string(degree));
  return {"fixed", std::vector<double>(degree + 1, 1.0)};
}

TruncationLaw geometric(int min_degree, int max_degree, double p) {
  if (min_degree < 1)
    throw std::invalid_argument("geometric: min_degree must be at least 1, got " +
                                std::to_string(min_degree));
  if (max_degree < min_degree)
    throw std::invalid_argument("geometric: max_degree must be at least min_degree = " +
                                std::to_string(min_degree) + ", got " + std::to_string(max_degree));
  if (!(p >= 0.0 && p <= 1.0))
    throw std::invalid_argument("geometric: probability must be in [0, 1), got " + shown(p));
  if (p == 1.0 && min_degree != max_degree)
    throw std::invalid_argument(
        "geometric: probability 1 would never draw the terms above min_degree; take max_degree = min_degree "
        "or a "
        "probability below 1");
  std::vector<double> tail(max_degree + 1, 1.0);
  for (int n = min_degree + 1; n <= max_degree; ++n) tail[n] = tail[n - 1] * (1.0 - p);
  return {"geometric", std::move(tail)};
}

double expected_cost(const TruncationLaw& law, std::span<const double> increments) {
  if (static_cast<int>(increments.size()) <= law.max_degree())
    throw std::invalid_argument("expected_cost: " + std::to_string(law.max_degree() + 1) +
                                " increments are needed");
  double sum = 0;
  for (int n = law.max_degree(); n >= 1; --n) sum += increments[n] * law.at_least(n);
  return sum;
}

std::vector<double> linear_cost(int degree) {
  std::vector<double> increments(degree + 1, 1.0);
  increments[0] = 0.0;
  return increments;
}

std::vector<double> quadratic_cost(int degree) {
  std::vector<double> increments(degree + 1);
  for (int n = 0; n <= degree; ++n) increments[n] = n;
  return increments;
}

double covariance(const TruncationLaw& law, std::span<const double> g, std::span<const double> f) {
  const std::size_t terms = static_cast<std::size_t>(law.max_degree()) + 1;
  if (g.size() < terms || f.size() < terms)
    throw std::invalid_argument("covariance: " + std::to_string(terms) + " terms of each series are needed");
  struct Pair {
    double g = 0, f = 0;
    Pair& operator+=(const Pair& other) {
      g += other.g;
      f += other.f;
      return *this;
    }
  };
  return random_part(
      law, Pair{}, [&](int n) { return Pair{g[n], f[n]}; }, [](const Pair& x) { return x.g * x.f; });
}

double variance(const TruncationLaw& law, std::span<const double> terms) {
  return covariance(law, terms, terms);
}

}  // namespace jetlag
