// SPDX-License-Identifier: MIT
#include "jetlag/truncation/truncation.hpp"

#include <cmath>
#include <stdexcept>

namespace jetlag {

TruncationLaw::TruncationLaw(std::string name, std::vector<double> tail)
    : name_(std::move(name)), tail_(std::move(tail)), min_(0) {
  const auto refuse = [&](int n, const char* why) {
    throw std::invalid_argument(name_ + ": P(K >= " + std::to_string(n) + ") " + why);
  };
  if (tail_.size() < 2) throw std::invalid_argument(name_ + ": the largest degree must be at least 1");
  if (tail_[0] != 1.0) refuse(0, "must be 1");
  for (std::size_t n = 1; n < tail_.size(); ++n) {
    if (!(tail_[n] <= tail_[n - 1])) refuse(static_cast<int>(n), "must not be larger than the one before");
    if (!(tail_[n] > 0.0) || !std::isfinite(1.0 / tail_[n]))
      refuse(static_cast<int>(n),
             "is so small that the weight 1/P overflows; take a smaller degree or probability");
    if (tail_[n] == 1.0) min_ = static_cast<int>(n);
  }
}

double TruncationLaw::mean() const {
  double sum = 0;
  for (std::size_t n = tail_.size(); n-- > 1;) sum += tail_[n];
  return sum;
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
    throw std::invalid_argument("geometric: probability must be in [0, 1), got " + std::to_string(p));
  if (p == 1.0 && min_degree != max_degree)
    throw std::invalid_argument(
        "geometric: probability 1 would never draw the terms above min_degree; take max_degree = min_degree "
        "or a "
        "probability below 1");
  std::vector<double> tail(max_degree + 1, 1.0);
  for (int n = min_degree + 1; n <= max_degree; ++n) tail[n] = tail[n - 1] * (1.0 - p);
  return {"geometric", std::move(tail)};
}

double covariance(const TruncationLaw& law, std::span<const double> g, std::span<const double> f) {
  const std::size_t terms = static_cast<std::size_t>(law.max_degree()) + 1;
  if (g.size() < terms || f.size() < terms)
    throw std::invalid_argument("covariance: " + std::to_string(terms) + " terms of each series are needed");
  double tail_g = 0, tail_f = 0, sum = 0;
  for (int n = law.max_degree(); n > law.min_degree(); --n) {
    tail_g += g[n];
    tail_f += f[n];
    sum += (law.weight(n) - law.weight(n - 1)) * tail_g * tail_f;
  }
  return sum;
}

double variance(const TruncationLaw& law, std::span<const double> terms) {
  return covariance(law, terms, terms);
}

}  // namespace jetlag
