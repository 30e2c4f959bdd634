// SPDX-License-Identifier: MIT
#pragma once
// Workspaces that tasks share.

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace jetlag {

/// Things that tasks borrow and give back; made when there is none to lend, kept for the next.
template <class T>
class Pool {
 public:
  template <class Make>
  std::unique_ptr<T> lend(const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto thing = std::move(idle_.back());
        idle_.pop_back();
        return thing;
      }
    }
    return make();
  }
  void give_back(std::unique_ptr<T> thing) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(thing));
  }
  /// Each that is not lent.
  template <class F>
  void each(const F& f) const {
    for (const auto& thing : idle_) f(*thing);
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace jetlag
