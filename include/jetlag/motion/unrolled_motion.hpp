// SPDX-License-Identifier: MIT
#pragma once
// The series of a motion under a single element, whose law is its own kernel (forces/law_kernel.hpp).

#include <cstddef>
#include <vector>

#include "jetlag/model/model.hpp"

namespace jetlag {

/// A number type for which no law is compiled.
template <class T>
class UnrolledMotion {
 public:
  UnrolledMotion() = default;
  UnrolledMotion(const Model<T>&, const KernelTable<T>&) {}
  static constexpr bool exists() { return false; }
  static constexpr int highest_order() { return 0; }
  static constexpr std::size_t bytes() { return 0; }
  void grow(T*, T*, const T*, const T&, const T&, int, int) {}
};

template <>
class UnrolledMotion<double> {
 public:
  /// None.
  UnrolledMotion() = default;

  /// That of a system of a single element, in which all particles take part, of a law that has a kernel; otherwise none. Where
  /// the kernels of the table round products before they are added, none either.
  UnrolledMotion(const Model<double>& model, const KernelTable<double>& table);

  bool exists() const { return kernel_.orders > 0; }
  /// The highest order of the positions that it reaches.
  int highest_order() const { return kernel_.orders + 1; }
  std::size_t bytes() const {
    return sizeof(double) * (parameters_.size() + time_.size() + histories_.size());
  }

  /// From order k+1 of the positions x and k of the velocities v to orders end + 1 and end.
  /// x, v: rows of order 0; push: time_unit / mass of each coordinate.
  void grow(double* x, double* v, const double* push, double time, double time_unit, int k, int end) {
    time_[0] = time;
    time_[1] = time_unit;
    kernel_.grow({x, v, time_.data(), push, time_unit, rows_.data(), parameters_.data(), histories_.data()},
                 k, end);
  }

 private:
  int count_histories(const LawKernel& kernel);

  LawKernel kernel_;
  std::vector<int> rows_;
  std::vector<double> parameters_, time_;
  AlignedVector<double> histories_;
};

}  // namespace jetlag
