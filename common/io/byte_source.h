#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/posix/interruption.h"

namespace puck {

/// The bytes of a file, a pipe or standard input, decompressed where they are gzip or zstd. One
/// thread at a time.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// How messages name it.
  virtual const std::string& name() const = 0;

  /// Fills `bytes` as far as there are bytes and returns their number: fewer than asked for only at
  /// the end. Throws EventFileError when reading fails.
  virtual std::size_t read(std::span<std::byte> bytes) = 0;

  /// Share of the stored bytes that was read, 0 to 1; nothing for a pipe.
  virtual std::optional<double> share_read() const { return std::nullopt; }

  /// Whether `rewind` works: not for pipes.
  virtual bool can_rewind() const = 0;

  /// Starts again from the first byte. Throws EventFileError where it cannot.
  virtual void rewind() = 0;
};

/// Opens a file; "-" is standard input. `interruption`: a wait for the bytes of a pipe then
/// throws EventFileError; must outlive the source. Throws EventFileError.
std::unique_ptr<ByteSource> open_bytes(const std::string& path,
                                       const Interruption* interruption = nullptr);

}  // namespace puck
