// SPDX-License-Identifier: MIT
#pragma once
// Wavefront: many passes over many chunks, with each chunk led through as many passes as its neighbours allow before
// the next chunk is begun, so that what the passes share stays in the cache.
//
//   pass 0   # # # # # # # # 8 . . .        a chunk may begin pass p when every chunk up to needed(chunk)
//   pass 1   # # # # # 7 . . . . . .        has ended pass p - 1
//   pass 2   # # 6 . . . . . . . . .
//
// The order in which things run depends on nothing but the progress so far; what they compute must not depend on it.

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <vector>

#include "jetlag/base/workers.hpp"

namespace jetlag {

class Wavefront {
 public:
  /// needed: for each chunk the last chunk, itself or a later one, that must have ended a pass before it begins the next.
  explicit Wavefront(std::vector<std::size_t> needed) : needed_(std::move(needed)) {}

  std::size_t chunks() const { return needed_.size(); }

  /// run(chunk, pass): chunks may run at the same time. end(chunk, pass): after the chunks 0 .. chunk have run this pass,
  /// one after another in a pass. Rethrows the first exception.
  template <class Run, class End>
  void operator()(std::size_t passes, const Workers& workers, const Run& run, const End& end) {
    progress_.assign(passes, {});
    for (auto& pass : progress_) pass.has_run.assign(chunks(), false);
    failure_ = nullptr;
    workers.each(workers.threads(), [&](std::size_t) { work(run, end); });
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  struct Progress {
    std::size_t begun = 0, ended = 0;  // chunks, from the first
    bool is_ending = false;            // some worker calls `end`
    std::vector<bool> has_run;
  };

  /// The latest pass of which a chunk can begin; -1 when there is none now.
  int ready() const {
    for (std::size_t p = progress_.size(); p-- > 0;) {
      const std::size_t c = progress_[p].begun;
      if (c < chunks() && (p == 0 || needed_[c] < progress_[p - 1].ended)) return static_cast<int>(p);
    }
    return -1;
  }
  bool all_ended() const { return progress_.empty() || progress_.back().ended == chunks(); }

  template <class Run, class End>
  void work(const Run& run, const End& end) {
    std::unique_lock lock(mutex_);
    while (!all_ended() && !failure_) {
      const int p = ready();
      if (p < 0) {
        changed_.wait(lock);
        continue;
      }
      Progress& pass = progress_[p];
      const std::size_t chunk = pass.begun++;
      try {
        lock.unlock();
        run(chunk, p);
        lock.lock();
        pass.has_run[chunk] = true;
        if (pass.is_ending) continue;
        pass.is_ending = true;
        while (pass.ended < chunks() && pass.has_run[pass.ended]) {
          const std::size_t next = pass.ended;
          lock.unlock();
          end(next, p);
          lock.lock();
          ++pass.ended;
          changed_.notify_all();
        }
        pass.is_ending = false;
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        if (!failure_) failure_ = std::current_exception();
        changed_.notify_all();
      }
    }
    changed_.notify_all();
  }

  std::vector<std::size_t> needed_;
  std::vector<Progress> progress_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr failure_;
};

}  // namespace jetlag
