#pragma once

#include <cstddef>

namespace puck {

/// LCM bounds a queue by its messages, whatever their size; memory is a matter of bytes. How many
/// messages a queue may hold follows from the size of those that come: that of the largest lately,
/// and of the largest possible as long as none has come. One thread.
class QueueBound {
 public:
  /// Room for about `most_bytes`, but for no more than `most_messages`, and for one at least.
  QueueBound(std::size_t most_bytes, int most_messages)
      : most_bytes_(most_bytes), most_messages_(most_messages) {}

  /// A message of so many bytes has come. True when messages() is another one from now on.
  bool add(std::size_t bytes);

  int messages() const { return messages_; }

 private:
  int messages_of(std::size_t bytes) const;

  std::size_t most_bytes_;
  int most_messages_;
  std::size_t largest_ = 0;  // lately
  int messages_ = messages_of(kLargestDatagram);

  static constexpr std::size_t kLargestDatagram = 65'507;
};

}  // namespace puck
