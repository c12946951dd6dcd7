#include "common/io/gzip_bytes.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include <zlib.h>

#include "common/io/compressed_bytes.h"

namespace puck {
namespace {

constexpr int kGzipOnly = 16 + MAX_WBITS;

class GzipBytes final : public CompressedBytes {
 public:
  explicit GzipBytes(std::unique_ptr<ByteSource> packed) : CompressedBytes(std::move(packed)) {
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw std::bad_alloc();
  }
  ~GzipBytes() override { inflateEnd(&stream_); }
  GzipBytes(const GzipBytes&) = delete;
  GzipBytes& operator=(const GzipBytes&) = delete;

 private:
  Step unpack(std::span<const std::byte> packed, std::span<std::byte> room) override {
    constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
    if (is_between_parts_) {
      // Archives on tape are padded with zeros.
      const auto part = std::find_if(packed.begin(), packed.end(),
                                     [](std::byte byte) { return byte != std::byte{0}; });
      const auto zeros = static_cast<std::size_t>(part - packed.begin());
      if (zeros > 0 || packed.empty()) return {.taken = zeros, .is_between_parts = true};
    }
    stream_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
    stream_.next_out = reinterpret_cast<Bytef*>(room.data());
    stream_.avail_out = static_cast<uInt>(std::min(room.size(), kMost));
    const uInt most = stream_.avail_out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    Step step{.taken = packed.size() - stream_.avail_in, .given = most - stream_.avail_out};
    if (result == Z_STREAM_END) {
      inflateReset(&stream_);
      step.is_between_parts = true;
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      step.fault = "are no valid gzip data";
      if (stream_.msg != nullptr) step.fault += std::string(" (") + stream_.msg + ")";
    }
    is_between_parts_ = step.is_between_parts;
    return step;
  }

  void restart() override {
    inflateReset(&stream_);
    is_between_parts_ = false;
  }

  z_stream stream_{};
  bool is_between_parts_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> open_gzip_bytes(std::unique_ptr<ByteSource> packed) {
  return std::make_unique<GzipBytes>(std::move(packed));
}

}  // namespace puck
