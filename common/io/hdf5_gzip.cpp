#include "common/io/hdf5_gzip.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>

#include <libdeflate.h>

namespace puck {
namespace {

constexpr int kFastLevel = 1;
// From here to the time nothing is stored, and memory may hold anything.
constexpr std::size_t kUnusedBytes = offsetof(EcfEvent, polarity) + sizeof(EcfEvent::polarity);

// The number whose bytes stand `stride` apart.
template <typename Number>
Number gathered(const std::byte* bytes, std::size_t stride) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    number |= std::to_integer<std::uint64_t>(bytes[i * stride]) << (8 * i);
  }
  return static_cast<Number>(number);
}

}  // namespace

struct Hdf5Gzip::Coders {
  Coders() {
    if (unpacker == nullptr || packer == nullptr) throw std::bad_alloc();
  }
  ~Coders() {
    libdeflate_free_decompressor(unpacker);
    libdeflate_free_compressor(packer);
  }
  Coders(const Coders&) = delete;
  Coders& operator=(const Coders&) = delete;

  libdeflate_decompressor* unpacker = libdeflate_alloc_decompressor();
  libdeflate_compressor* packer = libdeflate_alloc_compressor(kFastLevel);
};

Hdf5Gzip::Hdf5Gzip() : coders_(std::make_unique<Coders>()) {}
Hdf5Gzip::~Hdf5Gzip() = default;
Hdf5Gzip::Hdf5Gzip(Hdf5Gzip&&) noexcept = default;
Hdf5Gzip& Hdf5Gzip::operator=(Hdf5Gzip&&) noexcept = default;

void Hdf5Gzip::unpack(std::span<const std::byte> packed, bool is_shuffled, std::size_t chunk_events,
                      std::size_t count, std::vector<EcfEvent>& events) {
  content_.resize(chunk_events * sizeof(EcfEvent));
  if (libdeflate_zlib_decompress(coders_->unpacker, packed.data(), packed.size(), content_.data(),
                                 content_.size(), nullptr) != LIBDEFLATE_SUCCESS) {
    throw std::invalid_argument("damaged gzip, or not of " + std::to_string(content_.size()) +
                                " bytes");
  }
  events.resize(count);
  const std::size_t stride = is_shuffled ? chunk_events : 1;
  const std::size_t step = is_shuffled ? 1 : sizeof(EcfEvent);
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte* const event = content_.data() + i * step;
    events[i] = {gathered<std::uint16_t>(event + offsetof(EcfEvent, x) * stride, stride),
                 gathered<std::uint16_t>(event + offsetof(EcfEvent, y) * stride, stride),
                 gathered<std::int16_t>(event + offsetof(EcfEvent, polarity) * stride, stride),
                 gathered<std::int64_t>(event + offsetof(EcfEvent, t_us) * stride, stride)};
  }
}

void Hdf5Gzip::pack(std::span<const EcfEvent> events, std::vector<std::byte>& packed) {
  content_.resize(events.size_bytes());
  const auto bytes = std::as_bytes(events);
  for (std::size_t byte = 0; byte < sizeof(EcfEvent); ++byte) {
    std::byte* const plane = content_.data() + byte * events.size();
    if (byte >= kUnusedBytes && byte < offsetof(EcfEvent, t_us)) {
      std::fill_n(plane, events.size(), std::byte{0});
      continue;
    }
    for (std::size_t i = 0; i < events.size(); ++i) plane[i] = bytes[i * sizeof(EcfEvent) + byte];
  }
  packed.resize(libdeflate_zlib_compress_bound(coders_->packer, content_.size()));
  const std::size_t size = libdeflate_zlib_compress(coders_->packer, content_.data(),
                                                    content_.size(), packed.data(), packed.size());
  packed.resize(size);
}

}  // namespace puck
