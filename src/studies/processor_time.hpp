// SPDX-License-Identifier: MIT
#pragma once
// The time that this thread has spent on a processor.

#include <time.h>

namespace jetlag {

/// [s]
inline double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace jetlag
