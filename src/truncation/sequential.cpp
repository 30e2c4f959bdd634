// SPDX-License-Identifier: MIT
#include "jetlag/truncation/sequential.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "jetlag/truncation/draws.hpp"

namespace jetlag {

SequentialLaw::SequentialLaw(std::string name, int min_degree, int max_degree, double least, Rule rule)
    : name_(std::move(name)), min_(min_degree), max_(max_degree), least_(least), rule_(std::move(rule)) {
  if (min_ < 0)
    throw std::invalid_argument(name_ + ": min_degree must be at least 0, got " + std::to_string(min_));
  if (max_ < std::max(min_, 1))
    throw std::invalid_argument(name_ + ": max_degree must be at least 1 and min_degree = " +
                                std::to_string(min_) + ", got " + std::to_string(max_));
  if (!(least_ > 0.0 && least_ <= 1.0))
    throw std::invalid_argument(name_ + ": least must be in (0, 1], got " + shown(least_));
}

double SequentialLaw::go_on(int n, std::span<const double> sizes, double weight) const {
  const double p = rule_(n, sizes, weight);
  // Not less than what a uniform number can tell.
  const double floor = std::max(least_, std::min(1.0, least_probability * weight));
  return p > floor ? std::min(p, 1.0) : floor;
}

TruncationLaw SequentialLaw::given(std::span<const double> terms) const {
  if (static_cast<int>(terms.size()) < max_)
    throw std::invalid_argument(name_ + ": " + std::to_string(max_) + " terms are needed");
  std::vector<double> sizes, tail(max_ + 1, 1.0);
  for (int n = 0; n < max_; ++n) sizes.push_back(std::abs(terms[n]));
  for (int n = min_ + 1; n <= max_; ++n)
    tail[n] = tail[n - 1] * go_on(n, std::span(sizes).first(n), 1.0 / tail[n - 1]);
  return {name_, std::move(tail)};
}

TruncationLaw SequentialLaw::lower_bound() const {
  std::vector<double> tail(max_ + 1, 1.0);
  for (int n = min_ + 1; n <= max_; ++n) tail[n] = std::max(tail[n - 1] * least_, least_probability);
  return {name_, std::move(tail)};
}

SequentialLaw sequential(int min_degree, int max_degree, double target, double least) {
  if (min_degree < 1)
    throw std::invalid_argument("sequential: min_degree must be at least 1, got " +
                                std::to_string(min_degree));
  if (!(target > 0.0) || !std::isfinite(target))
    throw std::invalid_argument("sequential: target must be > 0 and finite, got " + shown(target));
  const auto roulette = [target](int n, std::span<const double> sizes, double weight) {
    const auto size = [&](int k) { return k < 0 ? 0.0 : sizes[k]; };
    const double a = std::max(size(n - 1), size(n - 2)), b = std::max(size(n - 3), size(n - 4));
    return weight * (a < b ? a * std::sqrt(a / b) : a) / target;
  };
  return {"sequential", min_degree, max_degree, least, roulette};
}

TruncationLaw known_beforehand(const Truncation& law) {
  const auto* sequential = std::get_if<SequentialLaw>(&law);
  return sequential != nullptr ? sequential->lower_bound() : std::get<TruncationLaw>(law);
}

}  // namespace jetlag
