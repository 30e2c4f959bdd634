// SPDX-License-Identifier: MIT
#pragma once
// Kernels: every rule of the register, compiled for one number type and one number of lanes.
//
// A kernel computes coefficient k of one operation, or coefficients k and k + 1, for a block of `lanes` elements at
// once. Coefficient j of an operand lies at base + (j & kept) * stride, one number a lane.
//
//                      lane 0  1  2 ... 31
//   base            ->  [ u_0 of 32 elements ]          kept = -1: every order is kept
//   base + stride   ->  [ u_1 of 32 elements ]          kept =  1: the last two are
//   ...                                                 stride = 0: there is no series, only coefficient 0
//
// For double the kernels are compiled inside the library, once for each instruction set and for several widths of a
// block, and chosen at run time. For any other number type they are the same rules on one lane.

#include <algorithm>
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
  int kept;
};

/// Coefficients k .. k + orders - 1 (orders: 1 or 2) of one operation. operands: those of the rule, then the result.
template <class T>
using Kernel = void (*)(int k, int orders, const Operand<T>* operands);

/// to[c][lane] = from[plus[lane] + c], minus from[minus[lane] + c] unless minus is null: rows of coordinates become
/// lanes, c < dimension. Rows of three coordinates are padded to four.
template <class T>
using Gather = void (*)(int dimension, const T* from, const int* plus, const int* minus, T* const* to);

/// into[plus[lane] + c] += f[c][lane] and, unless minus is null, into[minus[lane] + c] -= f[c][lane], lane by lane,
/// for the first `active` lanes. The padding of a row takes part; it stays zero.
template <class T>
using Scatter = void (*)(int dimension, int active, const T* const* f, const int* plus, const int* minus,
                         T* into);

template <class T>
struct KernelTable {
  int lanes;                                // elements in a block
  const char* instruction_set;              // "scalar", "sse2", "avx2", "avx512"
  std::array<Kernel<T>, Rules::size> rule;  // by position in the register
  Gather<T> gather;
  Scatter<T> scatter;
  const KernelTable* narrower;  // the same instruction set with fewer lanes, or null
  bool fuses = false;           // whether products are added in one rounding

  /// Of this table and the narrower ones, the one with the least to compute for so many elements, wasted lanes counted.
  const KernelTable& fitting(std::size_t elements) const {
    const auto cost =
        [&](const KernelTable& table) {  // of the blocks, each with an overhead worth some 20 lanes
          return (elements + table.lanes - 1) / table.lanes * (table.lanes + 20);
        };
    const KernelTable* best = this;
    for (const KernelTable* table = narrower; table; table = table->narrower)
      if (cost(*table) < cost(*best)) best = table;
    return *best;
  }
};

/// One element at a time, for any number type: the oracle of the others.
template <class T>
const KernelTable<T>& scalar_kernels();

template <>
const KernelTable<double>& scalar_kernels<double>();  // compiled once, in the library

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
template <class Lane, class T, Reads reads>
struct LaneSeries {
  const T* base;
  std::ptrdiff_t stride;
  int kept;
  decltype(auto) operator[](int j) const {
    if constexpr (reads == Reads::history)
      return Lane::load(base + j * stride);  // all orders are kept, or there is no series
    else
      return Lane::load(base + (j & kept) * stride);
  }
};

/// One number as a lane.
template <class T>
struct ScalarLane {
  static constexpr int width = 1;
  static const T& load(const T* from) { return *from; }
  static void store(T* to, const T& value) { *to = value; }
};

template <Rule R, class Lane, class T, int lanes>
void run_rule(int k, int orders, const Operand<T>* operands) {
  const Operand<T>& result = operands[arity<R>];
  for (int lane = 0; lane < lanes; lane += Lane::width) {
    const auto with_operands = [&](auto f) {
      return [&]<std::size_t... A>(std::index_sequence<A...>) {
        return f(LaneSeries<Lane, T, R::reads[A]>{operands[A].base + lane, operands[A].stride,
                                                  operands[A].kept}...);
      }(std::make_index_sequence<arity<R> + 1>{});
    };
    const auto store = [&](int n, const auto& value) {
      Lane::store(result.base + (n & result.kept) * result.stride + lane, value);
    };
    if constexpr (requires { R::two_from; } && partial_sums<Lane> == 1) {
      if (orders == 2 && k >= R::two_from) {
        const auto both = with_operands([&](const auto&... u) { return R::two_coefficients(k, u...); });
        store(k, both[0]);
        store(k + 1, both[1]);
        continue;
      }
    }
    for (int n = k; n < k + orders; ++n)
      store(n, with_operands([&](const auto&... u) { return R::coefficient(n, u...); }));
  }
}

/// The same with every call inlined, which lanes in registers need.
template <Rule R, class Lane, class T, int lanes>
[[gnu::flatten]] void run_rule_inlined(int k, int orders, const Operand<T>* operands) {
  run_rule<R, Lane, T, lanes>(k, orders, operands);
}

template <Rule R, class Lane, class T, int lanes>
constexpr Kernel<T> kernel_of() {
  if constexpr (std::is_arithmetic_v<T>)
    return &run_rule_inlined<R, Lane, T, lanes>;
  else  // the functions of a multiprecision number would take minutes to inline
    return &run_rule<R, Lane, T, lanes>;
}

template <class Lane, class T, int lanes, int D>
void gather_rows(const T* from, const int* plus, const int* minus, T* const* to) {
  for (int lane = 0; lane < lanes; ++lane)
    for (int c = 0; c < D; ++c)
      to[c][lane] = minus ? T(from[plus[lane] + c] - from[minus[lane] + c]) : from[plus[lane] + c];
}

template <class Lane, class T, int D>
void scatter_rows(int active, const T* const* f, const int* plus, const int* minus, T* into) {
  for (int lane = 0; lane < active; ++lane) {
    for (int c = 0; c < D; ++c) into[plus[lane] + c] += f[c][lane];
    if (minus)
      for (int c = 0; c < D; ++c) into[minus[lane] + c] -= f[c][lane];
  }
}

/// Lane may bring ways of its own: to gather rows of one and two coordinates, and through rows of three, padded to four.
template <class Lane, class T, int lanes>
void gather(int dimension, const T* from, const int* plus, const int* minus, T* const* to) {
  if constexpr (requires { Lane::template gather_short_rows<1>(lanes, from, plus, minus, to); }) {
    if (dimension == 1) return Lane::template gather_short_rows<1>(lanes, from, plus, minus, to);
    if (dimension == 2) return Lane::template gather_short_rows<2>(lanes, from, plus, minus, to);
  }
  if (dimension == 1) return gather_rows<Lane, T, lanes, 1>(from, plus, minus, to);
  if (dimension == 2) return gather_rows<Lane, T, lanes, 2>(from, plus, minus, to);
  if constexpr (requires { Lane::gather_rows_of_three(lanes, from, plus, minus, to); })
    Lane::gather_rows_of_three(lanes, from, plus, minus, to);
  else
    gather_rows<Lane, T, lanes, 3>(from, plus, minus, to);
}
template <class Lane, class T>
void scatter(int dimension, int active, const T* const* f, const int* plus, const int* minus, T* into) {
  if (dimension == 1) return scatter_rows<Lane, T, 1>(active, f, plus, minus, into);
  if (dimension == 2) return scatter_rows<Lane, T, 2>(active, f, plus, minus, into);
  if constexpr (requires { Lane::scatter_rows_of_three(active, f, plus, minus, into); })
    Lane::scatter_rows_of_three(active, f, plus, minus, into);
  else
    scatter_rows<Lane, T, 3>(active, f, plus, minus, into);
}

template <class Lane, class T, int lanes, Rule... R>
constexpr KernelTable<T> make_kernels(const char* instruction_set, RuleList<R...>,
                                      const KernelTable<T>* narrower = nullptr) {
  constexpr bool fuses = [] {
    if constexpr (requires { Lane::fuses; })
      return Lane::fuses;
    else
      return false;
  }();
  return {lanes,
          instruction_set,
          {kernel_of<R, Lane, T, lanes>()...},
          &gather<Lane, T, lanes>,
          &scatter<Lane, T>,
          narrower,
          fuses};
}

}  // namespace detail

template <class T>
const KernelTable<T>& scalar_kernels() {
  static const auto table = detail::make_kernels<detail::ScalarLane<T>, T, 1>("scalar", Rules{});
  return table;
}

}  // namespace jetlag
