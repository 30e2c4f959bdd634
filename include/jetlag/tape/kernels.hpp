// SPDX-License-Identifier: MIT
#pragma once
// Kernels: every rule of the register, compiled for one number type and one number of lanes.
//
// A kernel computes coefficient k of one operation for a block of `lanes` elements at once. Coefficient j of
// an operand lies at base + j * stride, one number a lane; the stride is 0 where only the newest is kept.
//
//                      lane 0  1  2 ... 31
//   base            ->  [ u_0 of 32 elements ]
//   base + stride   ->  [ u_1 of 32 elements ]
//   ...
//
// For double the kernels are compiled inside the library, once for each instruction set, and chosen at run
// time. For any other number type they are the same rules on one lane.

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/series/functions.hpp"

namespace jetlag {

template <class T>
struct Operand {
  T* base;
  std::ptrdiff_t stride;
};

/// Coefficient k of one operation. operands: those of the rule, then the result.
template <class T>
using Kernel = void (*)(int k, const Operand<T>* operands);

template <class T>
struct KernelTable {
  int lanes;                                // elements in a block
  const char* instruction_set;              // "scalar", "sse2", "avx2", "avx512"
  std::array<Kernel<T>, Rules::size> rule;  // by position in the register
};

/// One element at a time, for any number type: the oracle of the others.
template <class T>
const KernelTable<T>& scalar_kernels();

/// The kernels for T: for double the fastest that this machine runs, else the scalar ones.
template <class T>
const KernelTable<T>& kernels() {
  return scalar_kernels<T>();
}

/// The environment variable JETLAG_INSTRUCTION_SET (sse2, avx2, avx512, scalar), read once, takes precedence.
/// Throws std::invalid_argument when it names a set that does not exist or that this machine lacks.
template <>
const KernelTable<double>& kernels<double>();

/// All kernels for double that this machine can run, slowest first.
std::vector<const KernelTable<double>*> available_kernels();

// ---- how a table is made ---------------------------------------------------------------------------------

namespace detail {

/// The series of one operand, as a rule sees it: u[j] is a Lane of the block.
template <class Lane, class T>
struct LaneSeries {
  const T* base;
  std::ptrdiff_t stride;
  decltype(auto) operator[](int j) const { return Lane::load(base + j * stride); }
};

/// One number as a lane.
template <class T>
struct ScalarLane {
  static constexpr int width = 1;
  static const T& load(const T* from) { return *from; }
  static void store(T* to, const T& value) { *to = value; }
};

template <Rule R, class Lane, class T, int lanes>
void run_rule(int k, const Operand<T>* operands) {
  constexpr int result = arity<R>;
  for (int lane = 0; lane < lanes; lane += Lane::width) {
    const auto value = [&]<std::size_t... A>(std::index_sequence<A...>) {
      return R::coefficient(k, LaneSeries<Lane, T>{operands[A].base + lane, operands[A].stride}...);
    }(std::make_index_sequence<result + 1>{});
    Lane::store(operands[result].base + k * operands[result].stride + lane, value);
  }
}

/// The same with every call inlined, which lanes in registers need.
template <Rule R, class Lane, class T, int lanes>
[[gnu::flatten]] void run_rule_inlined(int k, const Operand<T>* operands) {
  run_rule<R, Lane, T, lanes>(k, operands);
}

template <Rule R, class Lane, class T, int lanes>
constexpr Kernel<T> kernel_of() {
  if constexpr (std::is_arithmetic_v<T>)
    return &run_rule_inlined<R, Lane, T, lanes>;
  else
    return &run_rule<R, Lane, T,
                     lanes>;  // the functions of a multiprecision number would take minutes to inline
}

template <class Lane, class T, int lanes, Rule... R>
constexpr KernelTable<T> make_kernels(const char* instruction_set, RuleList<R...>) {
  return {lanes, instruction_set, {kernel_of<R, Lane, T, lanes>()...}};
}

}  // namespace detail

template <class T>
const KernelTable<T>& scalar_kernels() {
  static const auto table = detail::make_kernels<detail::ScalarLane<T>, T, 1>("scalar", Rules{});
  return table;
}

}  // namespace jetlag
