// SPDX-License-Identifier: MIT
#pragma once
// A tape laid out in memory, and the blocks of elements it runs over.
//
//   history    one for each block   series of which a rule reads old coefficients, [slot][order][lane]
//                                   Of large scenes only the chunks under way have some, see Blocks::keep_histories.
//   statics    one for each block   constants, parameters and what follows from them, and the series of which
//                                   only coefficient 0 is read, [slot][lane]
//   scratch    one for each chunk   series of which only the newest coefficient is read, [slot][last two orders][lane]
//              of blocks
//
// A spring keeps 5 histories (its three differences, its length, its force divided by its length).

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "jetlag/tape/kernels.hpp"
#include "jetlag/tape/ring.hpp"
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
  bool coupled;                 // reads the result of the next instruction, which reads this one's
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
  struct Watched {
    Place place;                    // a history
    int at_zero;                    // see Condition
    std::optional<Place> argument;  // of a root: a history
  };
  std::vector<Watched> conditions;
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

namespace detail {
template <Rule... R>
consteval std::size_t most_operands(RuleList<R...>) {
  return std::max({R::reads.size()...});
}
}  // namespace detail

/// The elements of one law in blocks, and the series of every value of its tape.
template <class T>
class Blocks {
 public:
  /// count: elements. parameters: shape (count, program.parameters), row by row.
  Blocks(Program program, std::size_t count, const std::vector<T>& parameters, const KernelTable<T>& table)
      : program_(std::move(program)) {
    set_count(count, table);
    if (parameters.size() != count * program_.parameters)
      throw std::invalid_argument("Blocks: as many parameters as the law has are needed for each element");
    statics_.resize(blocks() * program_.statics * lanes());
    scratch_.resize(chunks() * scratch_of_a_chunk());
    for (std::size_t b = 0; b < blocks(); ++b) {
      for (const auto& fixed : program_.fixed) {
        T* to = at(b, fixed.place, 0);
        for (int lane = 0; lane < lanes(); ++lane)
          to[lane] = fixed.parameter < 0
                         ? T(fixed.constant)
                         : parameters[element(b, lane) * program_.parameters + fixed.parameter];
      }
      for (const Instruction& instruction : program_.preparation) {
        std::array<Operand<T>, most_operands> operands;
        for (std::size_t a = 0; a < instruction.operands.size(); ++a)
          operands[a] = operand(b, instruction.operands[a]);
        table_->rule[instruction.rule](0, 1, operands.data());
      }
    }
    choose_kernels();
  }

  /// Becomes the blocks of some elements of `all`, which has the same program, with their constants and parameters and
  /// room for as many orders as before. What has been computed is lost; storage once made is kept for the next time.
  void take(const Blocks& all, std::span<const int> elements, const KernelTable<T>& table) {
    const bool other_lanes = table_ != &table;
    const std::size_t piece = history_of_a_chunk();
    set_count(elements.size(), table);
    if (other_lanes) choose_kernels();
    const std::size_t n = lanes(), from_lanes = all.lanes(), slots = program_.statics;
    const int shift = std::countr_zero(from_lanes);  // lanes are a power of two
    bool moved = grow(statics_, blocks() * slots * n);
    moved |= grow(scratch_, chunks() * scratch_of_a_chunk());
    moved |= grow(history_, rings_ ? 0 : blocks() * history_of_a_block());
    for (std::size_t b = 0; b < blocks(); ++b)
      for (std::size_t lane = 0; lane < n; ++lane) {
        const std::size_t e = elements[element(b, static_cast<int>(lane))];
        const T* from = all.statics_.data() + (e >> shift) * slots * from_lanes + (e & (from_lanes - 1));
        T* to = statics_.data() + b * slots * n + lane;
        for (std::size_t slot = 0; slot < slots; ++slot) to[slot * n] = from[slot * from_lanes];
      }
    if (rings_ && history_of_a_chunk() != piece) ring_ = {};
    if (rings_ || other_lanes || moved || histories_.size() != chunks() ||
        operands_.size() < blocks() * operands_of_a_block_)
      find_operands();
  }

  // Operands point into the storage: it may be moved, not copied.
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;
  Blocks(Blocks&&) = default;
  Blocks& operator=(Blocks&&) = default;

  const Program& program() const { return program_; }
  const KernelTable<T>& table() const { return *table_; }
  int lanes() const { return table_->lanes; }
  std::size_t count() const { return count_; }
  std::size_t blocks() const { return blocks_; }

  /// Blocks run in chunks; different chunks may run at the same time.
  static constexpr std::size_t blocks_of_a_chunk = 16;
  std::size_t chunks() const { return (blocks() + blocks_of_a_chunk - 1) / blocks_of_a_chunk; }

  /// The element in a lane. Lanes beyond the last element repeat it, so that they compute nothing unusual.
  std::size_t element(std::size_t block, int lane) const {
    const std::size_t e = block * lanes() + lane;
    return e < count_ ? e : count_ - 1;
  }
  /// Number of lanes of a block that hold elements of their own.
  int active(std::size_t block) const {
    return static_cast<int>(std::min<std::size_t>(lanes(), count_ - block * lanes()));
  }

  /// Room for orders 0 .. capacity - 1; what has been computed is kept.
  void reserve(int capacity) {
    if (capacity <= capacity_) return;
    const std::size_t series = blocks() * program_.histories,
                      old = static_cast<std::size_t>(capacity_) * lanes(),
                      size = static_cast<std::size_t>(capacity) * lanes();
    AlignedVector<T> wider(rings_ ? 0 : series * size);
    if (!rings_)
      for (std::size_t s = 0; s < series; ++s)
        std::copy_n(history_.begin() + s * old, old, wider.begin() + s * size);
    history_ = std::move(wider);
    capacity_ = capacity;
    ring_ = {};
    find_operands();
  }
  int capacity() const { return capacity_; }

  /// Whether histories are kept beyond `end_chunk`. Where they are not a chunk has some from its `begin_chunk` on, and they need no
  /// more memory than the chunks that are under way at the same time. A change loses what has been computed.
  void keep_histories(bool keep) {
    if (rings_ != keep) return;
    history_ = AlignedVector<T>(keep ? blocks() * history_of_a_block() : 0);
    rings_ = !keep;
    ring_ = {};
    find_operands();
  }
  bool keeps_histories() const { return !rings_; }
  std::size_t history_bytes_of_a_chunk() const { return history_of_a_chunk() * sizeof(T); }
  void begin_chunk(std::size_t chunk) {
    if (!rings_) return;
    if (!histories_[chunk]) histories_[chunk] = ring_.take(history_of_a_chunk());  // some after a failure
    find_operands_of(chunk);
  }
  void end_chunk(std::size_t chunk) {
    if (rings_) ring_.give_back(std::exchange(histories_[chunk], nullptr));
  }

  /// Coefficient k of a value of the tape in one block: one number a lane. The caller fills in the inputs. Of a value
  /// without a history only the last two orders are kept.
  T* at(std::size_t block, Place place, int k) {
    const Operand<T> o = operand(block, place);
    return o.base + (k & o.kept) * o.stride;
  }

  /// Coefficients k .. k + orders - 1 (orders: 1 or 2) of every operation, in one block.
  void run(std::size_t block, int k, int orders = 1) {
    assert(k + orders <= capacity_);
    const Operand<T>* operands = operands_.data() + block * operands_of_a_block_;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const Step& step = steps_[i];
      const int wanted = !step.only_at_order_0 ? orders : k == 0 ? 1 : 0;
      if (step.coupled) {
        const Step& other = steps_[++i];
        for (int n = k; n < k + wanted; ++n) {
          step.kernel(n, 1, operands);
          other.kernel(n, 1, operands + step.operands);
        }
        operands += step.operands + other.operands;
      } else {
        if (wanted > 0) step.kernel(k, wanted, operands);
        operands += step.operands;
      }
    }
  }

  std::size_t bytes() const {
    return sizeof(T) * (history_.size() + ring_.size() + statics_.size() + scratch_.size()) +
           sizeof(Operand<T>) * operands_.size();
  }

 private:
  static constexpr std::size_t most_operands = detail::most_operands(Rules{});  // the result among them

  void set_count(std::size_t count, const KernelTable<T>& table) {
    table_ = &table;
    count_ = count;
    blocks_ = (count + table.lanes - 1) / table.lanes;
  }

  void choose_kernels() {
    steps_.clear();
    operands_of_a_block_ = 0;
    for (const Instruction& instruction : program_.instructions) {
      steps_.push_back({table_->rule[instruction.rule], static_cast<int>(instruction.operands.size()),
                        instruction.only_at_order_0, instruction.coupled});
      operands_of_a_block_ += instruction.operands.size();
    }
  }

  void find_operands() {
    operands_.resize(blocks() * operands_of_a_block_);
    histories_.assign(chunks(), nullptr);
    if (rings_) return;
    for (std::size_t chunk = 0; chunk < chunks(); ++chunk) {
      histories_[chunk] = history_.data() + chunk * blocks_of_a_chunk * history_of_a_block();
      find_operands_of(chunk);
    }
  }
  void find_operands_of(std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * blocks_of_a_chunk, blocks());
    for (std::size_t b = chunk * blocks_of_a_chunk; b < end; ++b) {
      Operand<T>* to = operands_.data() + b * operands_of_a_block_;
      for (const Instruction& instruction : program_.instructions)
        for (Place place : instruction.operands) *to++ = operand(b, place);
    }
  }

  /// At least so long; whether it has moved.
  static bool grow(AlignedVector<T>& storage, std::size_t size) {
    const T* before = storage.data();
    if (storage.size() < size) storage.resize(size);
    return storage.data() != before;
  }

  std::size_t history_of_a_block() const {
    return static_cast<std::size_t>(program_.histories) * capacity_ * lanes();
  }
  std::size_t history_of_a_chunk() const {
    return std::min(blocks_of_a_chunk, blocks()) * history_of_a_block();
  }
  std::size_t scratch_of_a_chunk() const {
    return 2 * static_cast<std::size_t>(program_.scratches) * lanes();
  }

  Operand<T> operand(std::size_t block, Place place) {
    const std::size_t n = lanes();
    switch (place.space) {
      case Place::Space::history:
        return {histories_[block / blocks_of_a_chunk] + block % blocks_of_a_chunk * history_of_a_block() +
                    place.slot * capacity_ * n,
                table_->lanes, -1};
      case Place::Space::statics:
        return {statics_.data() + (block * program_.statics + place.slot) * n, 0, 0};
      default:
        return {scratch_.data() + block / blocks_of_a_chunk * scratch_of_a_chunk() + 2 * place.slot * n,
                table_->lanes, 1};
    }
  }

  /// An instruction as it is run.
  struct Step {
    Kernel<T> kernel;
    int operands;
    bool only_at_order_0, coupled;
  };

  Program program_;
  const KernelTable<T>* table_ = nullptr;
  std::size_t count_ = 0, blocks_ = 0;
  int capacity_ = 0;
  std::vector<Step> steps_;
  std::vector<Operand<T>> operands_;  // [block][step][operand], for the present capacity
  std::size_t operands_of_a_block_ = 0;
  AlignedVector<T> history_, statics_, scratch_;
  bool rings_ = false;
  Ring<AlignedVector<T>> ring_;  // of the histories of chunks under way, where histories are not kept
  std::vector<T*> histories_;    // of each chunk; null where it has none at present
};

}  // namespace jetlag
