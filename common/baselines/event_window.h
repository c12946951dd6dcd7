#pragma once

#include <cstddef>
#include <vector>

#include "common/vision/geometry/pixel.h"

namespace puck {

/// A ring buffer with the places of the newest events.
class EventWindow {
 public:
  /// `capacity` must be at least 1.
  explicit EventWindow(int capacity) : places_(static_cast<std::size_t>(capacity)) {}

  int size() const { return size_; }
  int capacity() const { return static_cast<int>(places_.size()); }

  /// Drops the oldest event when there is no room.
  void push(Pixel place) {
    newest_ = newest_ + 1 == capacity() ? 0 : newest_ + 1;
    places_[static_cast<std::size_t>(newest_)] = place;
    if (size_ < capacity()) ++size_;
  }

  /// Drops the oldest events until no more than `count` are left.
  void keep_newest(int count) {
    if (count < size_) size_ = count;
  }

  /// The event that is `age` events older than the newest; `age` is below size().
  Pixel operator[](int age) const {
    const int at = newest_ - age;
    return places_[static_cast<std::size_t>(at < 0 ? at + capacity() : at)];
  }

 private:
  std::vector<Pixel> places_;  // a ring
  int newest_ = 0;
  int size_ = 0;
};

}  // namespace puck
