#include "common/io/zstd_bytes.h"

#include <new>
#include <utility>

#include <zstd.h>

#include "common/io/compressed_bytes.h"

namespace puck {
namespace {

struct FreeZstd {
  void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
};

class ZstdBytes final : public CompressedBytes {
 public:
  explicit ZstdBytes(std::unique_ptr<ByteSource> packed)
      : CompressedBytes(std::move(packed)), stream_(ZSTD_createDStream()) {
    if (!stream_) throw std::bad_alloc();
  }

 private:
  Step unpack(std::span<const std::byte> packed, std::span<std::byte> room) override {
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    ZSTD_outBuffer out{room.data(), room.size(), 0};
    const std::size_t result = ZSTD_decompressStream(stream_.get(), &out, &in);
    Step step{.taken = in.pos, .given = out.pos, .is_between_parts = result == 0};
    if (ZSTD_isError(result) != 0) {
      step.fault = std::string("are no valid zstd data (") + ZSTD_getErrorName(result) + ")";
    }
    return step;
  }

  void restart() override { ZSTD_DCtx_reset(stream_.get(), ZSTD_reset_session_only); }

  std::unique_ptr<ZSTD_DStream, FreeZstd> stream_;
};

}  // namespace

std::unique_ptr<ByteSource> open_zstd_bytes(std::unique_ptr<ByteSource> packed) {
  return std::make_unique<ZstdBytes>(std::move(packed));
}

}  // namespace puck
