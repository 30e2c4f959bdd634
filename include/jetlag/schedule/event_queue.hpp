// SPDX-License-Identifier: MIT
#pragma once
// A queue of who is due when: one entry for each of N clocks, ties by number, nothing allocated once it is made.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace jetlag {

/// A heap of four children a node, with the place of every clock at hand. Changing a time costs O(log N).
class EventQueue {
 public:
  using Time = std::int64_t;
  static constexpr Time never = std::numeric_limits<Time>::max();

  /// Clocks 0 .. clocks - 1, none of them due ever.
  explicit EventQueue(int clocks = 0) : heap_(clocks), place_(clocks) {
    for (int i = 0; i < clocks; ++i) {
      heap_[i] = {never, i};
      place_[i] = i;
    }
  }

  std::size_t size() const { return heap_.size(); }
  bool empty() const { return heap_.empty() || heap_.front().time == never; }

  /// The earliest time, `never` where nobody is due, and of those due then the clock of the least number.
  Time time() const { return heap_.empty() ? never : heap_.front().time; }
  int clock() const { return heap_.front().clock; }
  Time time_of(int clock) const { return heap_[place_[clock]].time; }

  void set(int clock, Time time) {
    const Entry entry{time, clock};
    const std::size_t at = place_[clock];
    if (at > 0 && entry < heap_[(at - 1) / children])
      rise(at, entry);
    else
      sink(at, entry);
  }

 private:
  static constexpr std::size_t children = 4;
  struct Entry {
    Time time;
    int clock;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.time < b.time || (a.time == b.time && a.clock < b.clock);
    }
  };

  void put(std::size_t at, const Entry& entry) {
    heap_[at] = entry;
    place_[entry.clock] = static_cast<int>(at);
  }

  void rise(std::size_t at, const Entry& entry) {
    while (at > 0) {
      const std::size_t parent = (at - 1) / children;
      if (!(entry < heap_[parent])) break;
      put(at, heap_[parent]);
      at = parent;
    }
    put(at, entry);
  }

  void sink(std::size_t at, const Entry& entry) {
    for (;;) {
      const std::size_t first = children * at + 1, end = std::min(first + children, heap_.size());
      if (first >= end) break;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < end; ++child)
        if (heap_[child] < heap_[least]) least = child;
      if (!(heap_[least] < entry)) break;
      put(at, heap_[least]);
      at = least;
    }
    put(at, entry);
  }

  std::vector<Entry> heap_;
  std::vector<int> place_;
};

}  // namespace jetlag
