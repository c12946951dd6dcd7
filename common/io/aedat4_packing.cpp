#include "common/io/aedat4_packing.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>

#include <lz4frame.h>
#include <zstd.h>

namespace puck {
namespace {

constexpr std::size_t kFirstRoom = 65536;

}  // namespace

struct Aedat4Unpacker::Contexts {
  Contexts() {
    if (zstd == nullptr || LZ4F_isError(LZ4F_createDecompressionContext(&lz4, LZ4F_VERSION))) {
      throw std::bad_alloc();
    }
  }
  ~Contexts() {
    LZ4F_freeDecompressionContext(lz4);
    ZSTD_freeDCtx(zstd);
  }
  Contexts(const Contexts&) = delete;
  Contexts& operator=(const Contexts&) = delete;

  LZ4F_dctx* lz4 = nullptr;
  ZSTD_DCtx* zstd = ZSTD_createDCtx();
  bool is_done = false;  // The frame is complete.
};

Aedat4Unpacker::Aedat4Unpacker(Aedat4Packing packing)
    : packing_(packing), contexts_(std::make_unique<Contexts>()) {}
Aedat4Unpacker::~Aedat4Unpacker() = default;
Aedat4Unpacker::Aedat4Unpacker(Aedat4Unpacker&&) noexcept = default;
Aedat4Unpacker& Aedat4Unpacker::operator=(Aedat4Unpacker&&) noexcept = default;

std::span<const std::byte> Aedat4Unpacker::unpack(std::span<const std::byte> packed) {
  if (packing_ == Aedat4Packing::kNone) return packed;
  while (true) {
    if (const auto used = try_to_unpack(packed)) return std::span(content_).first(*used);
    if (content_.size() == kMostBytes) {
      throw std::invalid_argument("more than " + std::to_string(kMostBytes >> 20) +
                                  " MiB when unpacked");
    }
    content_.resize(std::min(kMostBytes, std::max(kFirstRoom, 4 * content_.size())));
  }
}

// From the beginning each time, because the unpackers look back at what they have written.
std::optional<std::size_t> Aedat4Unpacker::try_to_unpack(std::span<const std::byte> packed) {
  LZ4F_resetDecompressionContext(contexts_->lz4);
  ZSTD_DCtx_reset(contexts_->zstd, ZSTD_reset_session_only);
  contexts_->is_done = false;
  std::size_t used = 0;
  while (!contexts_->is_done) {
    if (used == content_.size()) return std::nullopt;
    const std::size_t before = packed.size();
    const std::size_t given = step(packed, std::span(content_).subspan(used));
    if (given == 0 && packed.size() == before && !contexts_->is_done) {
      throw std::invalid_argument("compressed data that end early");
    }
    used += given;
  }
  return used;
}

std::size_t Aedat4Unpacker::step(std::span<const std::byte>& packed, std::span<std::byte> room) {
  if (packing_ == Aedat4Packing::kLz4 || packing_ == Aedat4Packing::kLz4High) {
    std::size_t taken = packed.size();
    std::size_t given = room.size();
    LZ4F_decompressOptions_t options{};
    options.stableDst = 1;  // What was written stays where it is: no copy of it is kept.
    const std::size_t more =
        LZ4F_decompress(contexts_->lz4, room.data(), &given, packed.data(), &taken, &options);
    if (LZ4F_isError(more)) {
      throw std::invalid_argument(std::string("damaged LZ4: ") + LZ4F_getErrorName(more));
    }
    contexts_->is_done = more == 0;
    packed = packed.subspan(taken);
    return given;
  }
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  ZSTD_outBuffer out{room.data(), room.size(), 0};
  const std::size_t more = ZSTD_decompressStream(contexts_->zstd, &out, &in);
  if (ZSTD_isError(more)) {
    throw std::invalid_argument(std::string("damaged zstd: ") + ZSTD_getErrorName(more));
  }
  contexts_->is_done = more == 0;
  packed = packed.subspan(in.pos);
  return out.pos;
}

void pack_lz4(std::span<const std::byte> content, std::vector<std::byte>& packed) {
  const std::size_t before = packed.size();
  packed.resize(before + LZ4F_compressFrameBound(content.size(), nullptr));
  const std::size_t bytes = LZ4F_compressFrame(packed.data() + before, packed.size() - before,
                                               content.data(), content.size(), nullptr);
  if (LZ4F_isError(bytes)) throw std::bad_alloc();
  packed.resize(before + bytes);
}

}  // namespace puck
