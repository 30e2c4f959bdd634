// SPDX-License-Identifier: MIT
#pragma once
// Ring: pieces of memory of one size that are used again and again, so that they stay in the cache.

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace jetlag {

/// Storage: a vector of numbers. Of the pieces that are free the one that was given back last is taken first. Several threads may
/// take and give back at the same time.
template <class Storage>
class Ring {
 public:
  using T = typename Storage::value_type;

  /// A piece of so many numbers, the same for all pieces; what it holds is left from its last use.
  T* take(std::size_t size) {
    if (T* piece = take_free()) return piece;
    Storage made(size);  // written while others go on
    const std::lock_guard lock(*mutex_);
    free_.reserve(all_.size() + 1);  // so that giving back never throws
    all_.push_back(std::move(made));
    return all_.back().data();
  }
  void give_back(T* piece) {
    const std::lock_guard lock(*mutex_);
    free_.push_back(piece);
  }

  /// Numbers in all pieces.
  std::size_t size() const { return all_.empty() ? 0 : all_.size() * all_.front().size(); }

 private:
  T* take_free() {
    const std::lock_guard lock(*mutex_);
    if (free_.empty()) return nullptr;
    T* piece = free_.back();
    free_.pop_back();
    return piece;
  }

  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
  std::vector<Storage> all_;
  std::vector<T*> free_;
};

}  // namespace jetlag
