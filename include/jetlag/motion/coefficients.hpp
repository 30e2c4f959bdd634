// SPDX-License-Identifier: MIT
#pragma once
// The coefficients of a polynomial motion, in one block of memory or where somebody else has them.

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/model/system.hpp"
#include "jetlag/motion/coefficient_view.hpp"

namespace jetlag {

class CoefficientsView;

/// Goes through all coefficients; what it points to are views.
template <class All>
class CoefficientIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = typename All::ConstView;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = value_type;
  CoefficientIterator(const All* all, std::size_t k) : all_(all), k_(k) {}
  value_type operator*() const { return (*all_)[k_]; }
  CoefficientIterator& operator++() {
    ++k_;
    return *this;
  }
  friend bool operator==(const CoefficientIterator& a, const CoefficientIterator& b) { return a.k_ == b.k_; }

 private:
  const All* all_;
  std::size_t k_;
};

/// Coefficients 0 .. size() - 1 of some coordinates of all particles, each of shape (particles, dimension), one after another.
/// What is read and written are views: Eigen's maps. One that is kept ends with the next push_back, which may still read it.
class Coefficients {
 public:
  using View = Eigen::Map<Coordinates<double>>;
  using ConstView = Eigen::Map<const Coordinates<double>>;

  Coefficients() = default;
  /// Zeros.
  Coefficients(std::size_t count, int particles, int dimension)
      : particles_(particles), dimension_(dimension), count_(count), numbers_(count * numbers_of_each()) {}

  /// A copy.
  explicit Coefficients(const CoefficientsView& all);

  /// All of one shape.
  Coefficients(std::initializer_list<Coordinates<double>> all) {
    for (const auto& coefficient : all) push_back(coefficient);
  }

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  int particles() const { return particles_; }
  int dimension() const { return dimension_; }

  View operator[](std::size_t k) { return {data(k), particles_, dimension_}; }
  ConstView operator[](std::size_t k) const { return {data(k), particles_, dimension_}; }
  ConstView front() const { return (*this)[0]; }
  ConstView back() const { return (*this)[count_ - 1]; }

  double* data(std::size_t k) { return numbers_.data() + k * numbers_of_each(); }
  const double* data(std::size_t k) const { return numbers_.data() + k * numbers_of_each(); }

  /// One more; the first one decides the shape. Throws std::invalid_argument for another shape.
  template <class X>
  void push_back(const Eigen::DenseBase<X>& coefficient) {
    const auto rows = static_cast<int>(coefficient.rows()), columns = static_cast<int>(coefficient.cols());
    if (empty()) {
      particles_ = rows;
      dimension_ = columns;
    } else if (rows != particles_ || columns != dimension_) {
      throw std::invalid_argument("Coefficients: one of shape (" + std::to_string(rows) + ", " +
                                  std::to_string(columns) + ") among others of (" +
                                  std::to_string(particles_) + ", " + std::to_string(dimension_) + ")");
    }
    // What is put there may be a view of what is here: it stays until it has been read.
    std::vector<double> before;
    const std::size_t size = (count_ + 1) * numbers_of_each();
    if (size > numbers_.capacity()) {
      before.reserve(2 * size);
      before.assign(numbers_.begin(), numbers_.end());
      before.swap(numbers_);
    }
    numbers_.resize(size);
    (*this)[count_++] = coefficient.derived();
  }

  using Iterator = CoefficientIterator<Coefficients>;
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, count_}; }

  /// Memory held, in bytes.
  std::size_t bytes() const { return numbers_.capacity() * sizeof(double); }

 private:
  std::size_t numbers_of_each() const {
    return static_cast<std::size_t>(particles_) * static_cast<std::size_t>(dimension_);
  }

  int particles_ = 0, dimension_ = 0;
  std::size_t count_ = 0;
  std::vector<double> numbers_;  // [k][particle][component]
};

/// The same where they stand: [k][particle][component], rows `stride` >= dimension apart. It ends with what it views.
class CoefficientsView {
 public:
  using ConstView = CoefficientView<double>;

  CoefficientsView() = default;
  CoefficientsView(const double* numbers, std::size_t count, int particles, int dimension, int stride)
      : numbers_(numbers), count_(count), particles_(particles), dimension_(dimension), stride_(stride) {}
  CoefficientsView(const Coefficients& all)  // implicit: as a span of a vector
      : CoefficientsView(all.data(0), all.size(), all.particles(), all.dimension(), all.dimension()) {}

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  int particles() const { return particles_; }
  int dimension() const { return dimension_; }

  ConstView operator[](std::size_t k) const {
    return {data(k), particles_, dimension_, Eigen::OuterStride<>(stride_)};
  }
  ConstView front() const { return (*this)[0]; }
  ConstView back() const { return (*this)[count_ - 1]; }
  double operator()(std::size_t k, int particle, int component) const { return row(k, particle)[component]; }

  const double* data(std::size_t k) const { return numbers_ + k * numbers_of_each(); }
  const double* row(std::size_t k, int particle) const {
    return data(k) + static_cast<std::ptrdiff_t>(particle) * stride_;
  }

  /// From a coefficient to the next.
  std::size_t numbers_of_each() const {
    return static_cast<std::size_t>(particles_) * static_cast<std::size_t>(stride_);
  }

  /// The sum sum_k c_k s^k, by Horner's rule. into: shape (particles, dimension), or of a particle (dimension).
  void sum(double s, Coordinates<double>& into) const;
  void sum_of(int particle, double s, double* into) const;

  /// How many they are without gaps: size() * particles() * dimension(); and all of them, [k][particle][component].
  std::size_t numbers() const { return count_ * static_cast<std::size_t>(particles_) * dimension_; }
  void copy_to(double* numbers) const;

  using Iterator = CoefficientIterator<CoefficientsView>;
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, count_}; }

 private:
  const double* numbers_ = nullptr;
  std::size_t count_ = 0;
  int particles_ = 0, dimension_ = 0, stride_ = 0;
};

inline Coefficients::Coefficients(const CoefficientsView& all)
    : Coefficients(all.size(), all.particles(), all.dimension()) {
  all.copy_to(numbers_.data());
}

}  // namespace jetlag
