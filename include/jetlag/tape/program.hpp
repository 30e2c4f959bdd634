// SPDX-License-Identifier: MIT
#pragma once
// A tape laid out in memory, and the blocks of elements it runs over.
//
//   history    one for each block   series of which a rule reads old coefficients, [slot][order][lane]
//   statics    one for each block   constants, parameters and what follows from them, and the series of which
//                                   only coefficient 0 is read, [slot][lane]
//   scratch    one for all blocks   series of which only the newest coefficient is read, [slot][lane]
//
// A spring keeps 5 histories (its three differences, its length, its force divided by its length).

#include <cassert>
#include <cstddef>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/tape/kernels.hpp"
#include "jetlag/tape/tape.hpp"

namespace jetlag {

/// Where a value of the tape lies.
struct Place {
  enum class Space { history, statics, scratch } space;
  int slot;
};

struct Instruction {
  int rule;
  bool only_at_order_0;
  std::vector<Place> operands;  // those of the rule, then the result
};

/// A tape with a place for every value.
struct Program {
  explicit Program(const Tape& tape);

  struct Loaded {
    Place place;
    Input input;
  };
  struct Fixed {
    Place place;
    int parameter;  // -1: the constant
    double constant;
  };

  std::vector<Fixed> fixed;               // constants and parameters, set once
  std::vector<Instruction> preparation;   // static operations, run once
  std::vector<Loaded> inputs;             // filled by the caller before each order
  std::vector<Instruction> instructions;  // run at each order
  std::vector<Place> outputs;
  int histories = 0, statics = 0, scratches = 0;
  int parameters = 0;
  bool is_static;  // the outputs have no series: orders above 0 are zero
};

/// Storage aligned for every instruction set.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{alignof(T) > 64 ? alignof(T) : 64};
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};
template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// The elements of one law in blocks, and the series of every value of its tape.
template <class T>
class Blocks {
 public:
  /// count: elements. parameters: shape (count, program.parameters), row by row.
  Blocks(Program program, std::size_t count, const std::vector<T>& parameters, const KernelTable<T>& table)
      : program_(std::move(program)), table_(&table), count_(count) {
    if (parameters.size() != count * program_.parameters)
      throw std::invalid_argument("Blocks: as many parameters as the law has are needed for each element");
    statics_.resize(blocks() * program_.statics * lanes());
    scratch_.resize(static_cast<std::size_t>(program_.scratches) * lanes());
    for (std::size_t b = 0; b < blocks(); ++b) {
      for (const auto& fixed : program_.fixed) {
        T* to = at(b, fixed.place, 0);
        for (int lane = 0; lane < lanes(); ++lane)
          to[lane] = fixed.parameter < 0
                         ? T(fixed.constant)
                         : parameters[element(b, lane) * program_.parameters + fixed.parameter];
      }
      for (const Instruction& instruction : program_.preparation) execute(instruction, b, 0);
    }
  }

  const Program& program() const { return program_; }
  int lanes() const { return table_->lanes; }
  std::size_t count() const { return count_; }
  std::size_t blocks() const { return (count_ + lanes() - 1) / lanes(); }

  /// The element in a lane. Lanes beyond the last element repeat it, so that they compute nothing unusual.
  std::size_t element(std::size_t block, int lane) const {
    const std::size_t e = block * lanes() + lane;
    return e < count_ ? e : count_ - 1;
  }

  /// Room for orders 0 .. capacity - 1; what has been computed is kept.
  void reserve(int capacity) {
    if (capacity <= capacity_) return;
    AlignedVector<T> wider(blocks() * program_.histories * capacity * lanes());
    const std::size_t series = blocks() * program_.histories,
                      old = static_cast<std::size_t>(capacity_) * lanes();
    for (std::size_t s = 0; s < series; ++s)
      for (std::size_t i = 0; i < old; ++i) wider[s * capacity * lanes() + i] = history_[s * old + i];
    history_ = std::move(wider);
    capacity_ = capacity;
  }
  int capacity() const { return capacity_; }

  /// Coefficient k of a value of the tape in one block: one number a lane. The caller fills in the inputs.
  T* at(std::size_t block, Place place, int k) {
    const Operand<T> operand = resolve(block, place);
    return operand.base + k * operand.stride;
  }

  /// Coefficient k of every operation, in one block.
  void run(std::size_t block, int k) {
    assert(k < capacity_);
    for (const Instruction& instruction : program_.instructions)
      if (k == 0 || !instruction.only_at_order_0) execute(instruction, block, k);
  }

  std::size_t bytes() const { return sizeof(T) * (history_.size() + statics_.size() + scratch_.size()); }

 private:
  Operand<T> resolve(std::size_t block, Place place) {
    const auto n = static_cast<std::size_t>(lanes());
    switch (place.space) {
      case Place::Space::history:
        return {&history_[(block * program_.histories + place.slot) * capacity_ * n], table_->lanes};
      case Place::Space::statics: return {&statics_[(block * program_.statics + place.slot) * n], 0};
      default: return {&scratch_[place.slot * n], 0};
    }
  }

  void execute(const Instruction& instruction, std::size_t block, int k) {
    std::array<Operand<T>, 8> operands;
    for (std::size_t a = 0; a < instruction.operands.size(); ++a)
      operands[a] = resolve(block, instruction.operands[a]);
    table_->rule[instruction.rule](k, operands.data());
  }

  Program program_;
  const KernelTable<T>* table_;
  std::size_t count_;
  int capacity_ = 0;
  AlignedVector<T> history_, statics_, scratch_;
};

}  // namespace jetlag
