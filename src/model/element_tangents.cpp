// SPDX-License-Identifier: MIT
#include "model/element_tangents.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace jetlag {

ElementTangents::ElementTangents(std::shared_ptr<const Model<double>::Law> law)
    : law_(std::move(law)),
      participants_(law_->elements().law.participants),
      dimension_(law_->elements().law.dimension),
      stride_(padded(dimension_)),
      size_(participants_ * dimension_),
      blocks_(ElementBlocks<double>::none_of(law_->forces(), 2)) {
  own_.resize(law_->count() * participants_);
  std::iota(own_.begin(), own_.end(), 0);
  f_.assign(static_cast<std::size_t>(batch()) * participants_ * stride_, 0.0);
  x_.assign(2 * f_.size(), 0.0);
  v_.assign(2 * f_.size(), 0.0);
}

int ElementTangents::batch() const { return std::min(static_cast<int>(law_->count()), 256); }

/// Coefficient `order` of the forces. A unit of time of 0: the time stands still along a direction.
void ElementTangents::run(int order, double time) {
  std::ranges::fill(f_, 0.0);
  const std::size_t size = f_.size();
  const MotionRows<double> motion{x_.data() + order * size, v_.data() + order * size, size, time, 0.0};
  for (std::size_t chunk = 0; chunk < blocks_.chunks(); ++chunk)
    blocks_.push(chunk, order, 1, motion, f_.data());
}

void ElementTangents::take(const State<double>& state) {
  k_.resize(law_->count() * size_ * size_);
  for (int first = 0; first < static_cast<int>(law_->count()); first += batch()) take(state, first);
}

void ElementTangents::take(const State<double>& state, int first) {
  const auto elements =
      std::span(law_->all()).subspan(first).first(std::min<std::size_t>(batch(), law_->count() - first));
  const int first_row = first * participants_;
  const auto row = [first_row](int own) { return own - first_row; };
  blocks_.take(law_->forces(), own_, elements, kernels<double>(), row, row);
  const int* const particles = law_->elements().particles.data() + first_row;
  for (std::size_t r = 0; r < elements.size() * participants_; ++r)
    for (int c = 0; c < dimension_; ++c) {
      x_[r * stride_ + c] = state.position(particles[r], c);
      v_[r * stride_ + c] = state.velocity(particles[r], c);
    }
  run(0, state.time);
  double* const direction = x_.data() + f_.size();
  const std::size_t of_element = static_cast<std::size_t>(participants_) * stride_;
  for (int column = 0; column < size_; ++column) {
    const int along = column / dimension_ * stride_ + column % dimension_;
    for (std::size_t r = along; r < f_.size(); r += of_element) direction[r] = 1;
    run(1, state.time);
    for (std::size_t r = along; r < f_.size(); r += of_element) direction[r] = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      double* to = k_.data() + ((first + e) * size_ + column) * size_;
      const double* from = f_.data() + e * of_element;
      for (int i = 0; i < participants_; ++i)
        for (int c = 0; c < dimension_; ++c) *to++ = -from[i * stride_ + c];
    }
  }
}

}  // namespace jetlag
