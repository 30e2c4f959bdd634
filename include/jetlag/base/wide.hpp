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

/// Eight numbers side by side, whatever the instruction set.
using Eight [[gnu::vector_size(64)]] = double;

}  // namespace jetlag
