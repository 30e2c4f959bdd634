// SPDX-License-Identifier: MIT
#include "jetlag/base/workers.hpp"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace jetlag {

struct Workers::Arena {
  // More threads than the machine has would gain nothing, and oneTBB would say so on the terminal.
  explicit Arena(int threads) : tbb(std::min(threads, oneapi::tbb::info::default_concurrency())) {}
  oneapi::tbb::task_arena tbb;
};

Workers::Workers(int threads) : threads_(threads) {
  if (threads < 1) throw std::invalid_argument("threads must be at least 1, got " + std::to_string(threads));
  if (threads > 1) arena_ = std::make_shared<Arena>(threads);
}

void Workers::run(std::size_t count, const std::function<void(std::size_t)>& task) const {
  arena_->tbb.execute([&] { oneapi::tbb::parallel_for(std::size_t{0}, count, task); });
}

}  // namespace jetlag
