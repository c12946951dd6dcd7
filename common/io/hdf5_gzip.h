#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "common/io/ecf_codec.h"

namespace puck {

/// Unpacks and packs chunks of events as HDF5's own filters do, with libdeflate: twice as fast as
/// the HDF5 library, which uses zlib. One thread at a time.
class Hdf5Gzip {
 public:
  Hdf5Gzip();
  ~Hdf5Gzip();
  Hdf5Gzip(Hdf5Gzip&&) noexcept;
  Hdf5Gzip& operator=(Hdf5Gzip&&) noexcept;

  /// Replaces `events` by the first `count` of the `chunk_events` of a chunk. `is_shuffled`: the
  /// first bytes of all events were stored first, then their second bytes, …. Throws
  /// std::invalid_argument for damaged bytes.
  void unpack(std::span<const std::byte> packed, bool is_shuffled, std::size_t chunk_events,
              std::size_t count, std::vector<EcfEvent>& events);

  /// Replaces `packed` by all events of a chunk, shuffled.
  void pack(std::span<const EcfEvent> events, std::vector<std::byte>& packed);

 private:
  struct Coders;

  std::unique_ptr<Coders> coders_;
  std::vector<std::byte> content_;
};

}  // namespace puck
