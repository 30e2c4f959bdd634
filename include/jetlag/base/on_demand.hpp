// SPDX-License-Identifier: MIT
#pragma once
// A value that is computed when it is asked for first, by whichever thread asks.

#include <atomic>
#include <mutex>
#include <optional>

namespace jetlag {

template <class V>
class OnDemand {
 public:
  /// make(): the value. Asked for once.
  template <class F>
  const V& operator()(F make) const {
    if (!is_made_.load(std::memory_order_acquire)) {
      const std::lock_guard lock(mutex_);
      if (!value_) value_.emplace(make());
      is_made_.store(true, std::memory_order_release);
    }
    return *value_;
  }

 private:
  mutable std::atomic<bool> is_made_ = false;
  mutable std::mutex mutex_;
  mutable std::optional<V> value_;
};

}  // namespace jetlag
