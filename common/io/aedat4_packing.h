#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace puck {

/// How the packets of an AEDAT4 file are compressed, as its header numbers it.
enum class Aedat4Packing : std::int32_t { kNone, kLz4, kLz4High, kZstd, kZstdHigh };

/// Unpacks one packet after the other. One thread at a time.
class Aedat4Unpacker {
 public:
  /// Largest packet, unpacked.
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20;

  explicit Aedat4Unpacker(Aedat4Packing packing);
  ~Aedat4Unpacker();
  Aedat4Unpacker(Aedat4Unpacker&&) noexcept;
  Aedat4Unpacker& operator=(Aedat4Unpacker&&) noexcept;

  /// The packet's content, valid until the next call or as long as `packed`. Throws
  /// std::invalid_argument for damaged bytes or more than kMostBytes.
  std::span<const std::byte> unpack(std::span<const std::byte> packed);

 private:
  struct Contexts;

  std::optional<std::size_t> try_to_unpack(std::span<const std::byte> packed);
  std::size_t step(std::span<const std::byte>& packed, std::span<std::byte> room);

  Aedat4Packing packing_;
  std::unique_ptr<Contexts> contexts_;
  std::vector<std::byte> content_;
};

/// `content` as one LZ4 frame, appended to `packed`.
void pack_lz4(std::span<const std::byte> content, std::vector<std::byte>& packed);

}  // namespace puck
