// SPDX-License-Identifier: MIT
#pragma once
// Loops over numbers side by side, compiled for each instruction set and chosen when the program starts.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define JETLAG_WIDE [[gnu::target_clones("avx512f", "avx2", "default")]]  // the same bits from all of them
#else
#define JETLAG_WIDE
#endif

namespace jetlag {

/// Numbers side by side, whatever the instruction set.
using Eight [[gnu::vector_size(64)]] = double;
using FourNumbers [[gnu::vector_size(32)]] = double;
using TwoNumbers [[gnu::vector_size(16)]] = double;

namespace detail {

template <class Loop, class... A>
auto with_two(A... a) {
  return Loop::template run<TwoNumbers>(a...);
}
#if defined(__x86_64__)
template <class Loop, class... A>
[[gnu::target("avx2")]] auto with_four(A... a) {
  return Loop::template run<FourNumbers>(a...);
}
template <class Loop, class... A>
[[gnu::target("avx512f")]] auto with_eight(A... a) {
  return Loop::template run<Eight>(a...);
}
#endif

}  // namespace detail

/// Loop::run<V>(a...), V the widest register of this machine: TwoNumbers, FourNumbers or Eight. run is always inlined, and takes
/// and returns no vectors. Vectors wider than a register would be kept in memory by g++ 12.
template <class Loop, class... A>
auto with_widest_registers(A... a) {
#if defined(__x86_64__)
  static const auto chosen = __builtin_cpu_supports("avx512f") ? &detail::with_eight<Loop, A...>
                             : __builtin_cpu_supports("avx2")  ? &detail::with_four<Loop, A...>
                                                               : &detail::with_two<Loop, A...>;
  return chosen(a...);
#else
  return detail::with_two<Loop, A...>(a...);
#endif
}

}  // namespace jetlag
