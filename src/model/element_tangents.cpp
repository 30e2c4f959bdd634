// SPDX-License-Identifier: MIT
#include "model/element_tangents.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace jetlag {

ElementTangents::ElementTangents(std::shared_ptr<const Model<double>::Law> law, std::vector<int> chosen)
    : law_(std::move(law)),
      participants_(law_->elements().law.participants),
      dimension_(law_->elements().law.dimension),
      stride_(padded(dimension_)),
      size_(participants_ * dimension_),
      blocks_(ElementBlocks<double>::none_of(law_->forces(), 2)),
      chosen_(std::move(chosen)) {
  own_.assign(law_->count() * participants_, -1);
  int row = 0;
  for (const std::size_t e : chosen_)
    for (int i = 0; i < participants_; ++i) own_[e * participants_ + i] = row++;
  f_.assign(static_cast<std::size_t>(batch()) * participants_ * stride_, 0.0);
  x_.assign(2 * f_.size(), 0.0);
  v_.assign(2 * f_.size(), 0.0);
}

int ElementTangents::batch() const { return std::min(static_cast<int>(chosen_.size()), 256); }

/// Coefficient `order` of the forces. A unit of time of 0: the time stands still along a direction.
void ElementTangents::run(int order, double time) {
  std::ranges::fill(f_, 0.0);
  const std::size_t size = f_.size();
  const MotionRows<double> motion{x_.data() + order * size, v_.data() + order * size, size, time, 0.0};
  blocks_.push_all(order, 1, motion, f_.data());
}

void ElementTangents::take(const State<double>& state, Input::Kind by) {
  k_.resize(chosen_.size() * size_ * size_);
  for (int first = 0; first < static_cast<int>(chosen_.size()); first += batch()) take(state, by, first);
}

void ElementTangents::take(const State<double>& state, Input::Kind by, int first) {
  const auto elements =
      std::span(chosen_).subspan(first).first(std::min<std::size_t>(batch(), chosen_.size() - first));
  const auto row_in_batch = [before = first * participants_](int own) { return own - before; };
  blocks_.take(law_->forces(), own_, elements, kernels<double>(), row_in_batch, row_in_batch);
  double *x = x_.data(), *v = v_.data();
  for (const int e : elements)
    for (const int particle : law_->particles_of(e)) {
      for (int c = 0; c < dimension_; ++c) {
        x[c] = state.position(particle, c);
        v[c] = state.velocity(particle, c);
      }
      x += stride_;
      v += stride_;
    }
  run(0, state.time);
  double* const direction = (by == Input::Kind::position ? x_ : v_).data() + f_.size();
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
