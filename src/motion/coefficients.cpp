// SPDX-License-Identifier: MIT
#include "jetlag/motion/coefficients.hpp"

#include <algorithm>

#include "jetlag/series/calculus/row_sums.hpp"

namespace jetlag {

void CoefficientsView::sum(double s, Coordinates<double>& into) const {
  into.resize(particles_, dimension_);
  if (stride_ == dimension_)
    return detail::sum_rows(data(0), numbers_of_each(), numbers_of_each(), static_cast<int>(count_) - 1, s,
                            into.data());
  for (int i = 0; i < particles_; ++i) sum_of(i, s, into.row(i).data());
}

void CoefficientsView::sum_of(int particle, double s, double* into) const {
  detail::sum_rows(row(0, particle), numbers_of_each(), dimension_, static_cast<int>(count_) - 1, s, into);
}

void CoefficientsView::copy_to(double* numbers) const {
  if (stride_ == dimension_) {
    std::copy_n(numbers_, count_ * numbers_of_each(), numbers);
    return;
  }
  const std::size_t rows = count_ * static_cast<std::size_t>(particles_);
  const auto d = static_cast<std::size_t>(dimension_);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t c = 0; c < d; ++c) numbers[row * d + c] = numbers_[row * stride_ + c];
}

}  // namespace jetlag
