#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/io/byte_source.h"

namespace puck {

/// What the decompressing sources share. After damaged data the bytes before it are still returned;
/// the next call throws.
class CompressedBytes : public ByteSource {
 public:
  const std::string& name() const override { return packed_->name(); }
  std::size_t read(std::span<std::byte> bytes) override;
  std::optional<double> share_read() const override { return packed_->share_read(); }
  bool can_rewind() const override { return packed_->can_rewind(); }
  void rewind() override;

 protected:
  explicit CompressedBytes(std::unique_ptr<ByteSource> packed);

  /// Progress of one step.
  struct Step {
    std::size_t taken = 0;          ///< Of the packed bytes.
    std::size_t given = 0;          ///< Of the room.
    bool is_between_parts = false;  ///< The packed data may end here.
    std::string fault;              ///< Not empty: the packed data are damaged.
  };

  /// Unpacks what it can.
  virtual Step unpack(std::span<const std::byte> packed, std::span<std::byte> room) = 0;
  /// Starts again with nothing unpacked.
  virtual void restart() = 0;

 private:
  std::unique_ptr<ByteSource> packed_;
  std::vector<std::byte> block_;
  std::size_t block_used_ = 0;
  std::size_t block_size_ = 0;
  std::int64_t bytes_before_ = 0;  // Packed bytes before the block.
  bool is_between_parts_ = true;
  std::string fault_;
};

}  // namespace puck
