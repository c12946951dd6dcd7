#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/byte_source.h"

namespace puck {

/// Another source whose first bytes can be looked at before they are read, even of a pipe.
class PeekedBytes final : public ByteSource {
 public:
  /// Reads up to `length` bytes ahead. Throws EventFileError.
  PeekedBytes(std::unique_ptr<ByteSource> bytes, std::size_t length);

  /// The first bytes: fewer than asked for only where the source ends.
  std::string_view head() const {
    return {reinterpret_cast<const char*>(head_.data()), head_.size()};
  }

  const std::string& name() const override { return bytes_->name(); }
  std::size_t read(std::span<std::byte> bytes) override;
  std::optional<double> share_read() const override { return bytes_->share_read(); }
  bool can_rewind() const override { return bytes_->can_rewind(); }
  void rewind() override;

 private:
  std::unique_ptr<ByteSource> bytes_;
  std::vector<std::byte> head_;
  std::size_t head_used_ = 0;
};

}  // namespace puck
