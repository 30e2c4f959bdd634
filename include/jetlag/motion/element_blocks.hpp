// SPDX-License-Identifier: MIT
#pragma once
// The elements of one law, ready to run: blocks of lanes, and the rows of the particles they read and push.

#include <vector>

#include "jetlag/motion/system.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag {

/// The distance between rows of padded coordinates: a power of two, so that rows do not straddle cache lines.
constexpr int padded(int dimension) { return dimension == 3 ? 4 : dimension; }

template <class T>
class ElementBlocks {
 public:
  /// One tape of a law (its force or its energy) over the elements of a system.
  ElementBlocks(const System<T>& system, const Elements<T>& elements, const Tape& tape,
                const KernelTable<T>& table)
      : dimension_(system.dimension()),
        participants_(elements.law.participants),
        blocks_(Program(tape), elements.count(), parameters_with_masses(system, elements), table) {
    const int lanes = blocks_.lanes();
    row_.resize(blocks_.blocks() * participants_ * lanes);
    for (std::size_t b = 0; b < blocks_.blocks(); ++b)
      for (int i = 0; i < participants_; ++i)
        for (int lane = 0; lane < lanes; ++lane)
          rows(b, i)[lane] =
              elements.particles[blocks_.element(b, lane) * participants_ + i] * padded(dimension_);
  }

  void reserve(int capacity) { blocks_.reserve(capacity); }
  std::size_t count() const { return blocks_.count(); }
  std::size_t bytes() const { return blocks_.bytes() + row_.size() * sizeof(int); }

  /// Whether orders above 0 are zero, so that there is nothing to run.
  bool is_static() const { return blocks_.program().is_static; }

  /// Coefficient k of the outputs of every element.
  /// position, velocity: coefficient k of all particles, padded rows; time: coefficient k of the time.
  template <class Use>
  void run(int k, const T* position, const T* velocity, const T& time, Use use) {
    for (std::size_t b = 0; b < blocks_.blocks(); ++b) {
      gather(b, k, position, velocity, time);
      blocks_.run(b, k);
      use(b);
    }
  }

  /// Adds coefficient k of the forces in block b to the participants: + on the first, - on the second.
  void scatter(std::size_t b, int k, T* force) {
    const std::size_t first = b * blocks_.lanes();
    const int active = static_cast<int>(std::min<std::size_t>(blocks_.lanes(), blocks_.count() - first));
    for (int c = 0; c < dimension_; ++c) {
      const T* f = blocks_.at(b, blocks_.program().outputs[c], k);
      const int* own = rows(b, 0);
      if (participants_ == 1) {
        for (int lane = 0; lane < active; ++lane) force[own[lane] + c] += f[lane];
      } else {
        const int* other = rows(b, 1);
        for (int lane = 0; lane < active; ++lane) {
          force[own[lane] + c] += f[lane];
          force[other[lane] + c] -= f[lane];
        }
      }
    }
  }

  /// The sum of output 0 at order 0 over the elements of block b.
  T sum(std::size_t b) {
    const std::size_t first = b * blocks_.lanes();
    const int active = static_cast<int>(std::min<std::size_t>(blocks_.lanes(), blocks_.count() - first));
    const T* e = blocks_.at(b, blocks_.program().outputs[0], 0);
    T total(0);
    for (int lane = 0; lane < active; ++lane) total += e[lane];
    return total;
  }

 private:
  int* rows(std::size_t b, int participant) {
    return &row_[(b * participants_ + participant) * blocks_.lanes()];
  }

  static std::vector<T> parameters_with_masses(const System<T>& system, const Elements<T>& elements) {
    const std::size_t width = elements.law.parameters.size();
    std::vector<T> all;
    for (std::size_t e = 0; e < elements.count(); ++e) {
      for (std::size_t j = 0; j < width; ++j) all.push_back(elements.parameters[e * width + j]);
      for (int i = 0; i < elements.law.participants; ++i)
        all.push_back(system.mass()[elements.particles[e * elements.law.participants + i]]);
    }
    return all;
  }

  void gather(std::size_t b, int k, const T* position, const T* velocity, const T& time) {
    const int lanes = blocks_.lanes();
    for (const auto& [place, input] : blocks_.program().inputs) {
      T* to = blocks_.at(b, place, k);
      if (input.kind == Input::Kind::time) {
        for (int lane = 0; lane < lanes; ++lane) to[lane] = time;
        continue;
      }
      const T* from = (input.kind == Input::Kind::position ? position : velocity) + input.component;
      const int* row = rows(b, input.participant);
      for (int lane = 0; lane < lanes; ++lane) to[lane] = from[row[lane]];
    }
  }

  int dimension_, participants_;
  Blocks<T> blocks_;
  std::vector<int> row_;  // [block][participant][lane]: first index of the participant's padded row
};

}  // namespace jetlag
