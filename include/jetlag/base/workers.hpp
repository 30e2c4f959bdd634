// SPDX-License-Identifier: MIT
#pragma once
// Threads, lent by oneTBB.

#include <cstddef>
#include <functional>
#include <memory>

namespace jetlag {

/// A number of threads that work on the same task. Copies share them.
class Workers {
 public:
  /// threads: at least 1. With one thread nothing is started and tasks run where they are called.
  /// Throws std::invalid_argument.
  explicit Workers(int threads = 1);

  int threads() const { return threads_; }

  /// task(i) for i = 0 .. count - 1, in any order and at the same time, each once. Returns when all are done; rethrows the
  /// first exception of a task.
  template <class Task>
  void each(std::size_t count, const Task& task) const {
    if (threads_ == 1 || count < 2)
      for (std::size_t i = 0; i < count; ++i) task(i);
    else
      run(count, task);
  }

 private:
  void run(std::size_t count, const std::function<void(std::size_t)>& task) const;

  struct Arena;
  int threads_;
  std::shared_ptr<Arena> arena_;
};

}  // namespace jetlag
