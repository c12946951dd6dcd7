#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/io/event_decoder.h"
#include "common/io/event_reader.h"
#include "common/io/raw_header.h"

namespace puck {

/// A Prophesee RAW byte stream from anywhere, header first: what files, stdin and TCP have in
/// common. It may be fed with pieces of any length. One thread at a time.
///
/// The encoding comes from the header, else from `options.from`; a stream without any header needs
/// the latter. The sensor's size comes from the header, else from `options.sensor`, else from what
/// the camera model in the header is known to have.
class RawEventStream {
 public:
  /// `name` stands for the stream in messages.
  RawEventStream(std::string name, EventFileOptions options);

  /// As EventDecoder::decode. Throws EventFileError once the header turns out to be none, or not to
  /// say enough.
  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet, std::size_t max_events);

  /// As EventDecoder::finish. Throws EventFileError when there was no whole header.
  void finish();

  /// Nothing until the header is complete.
  std::optional<SensorSize> sensor_size() const { return sensor_; }
  bool has_backlog() const;
  const EventCounters& counters() const;

 private:
  void start(const RawHeader& header);
  RawEncoding encoding_of(const RawHeader& header) const;
  SensorSize sensor_of(const RawHeader& header) const;

  std::string name_;
  EventFileOptions options_;
  std::optional<SensorSize> sensor_;
  std::unique_ptr<EventDecoder> decoder_;
  // The header, and then what came in one piece with it, from `early_used_` on.
  std::vector<std::byte> early_;
  std::size_t early_used_ = 0;
  EventCounters no_counters_;
};

}  // namespace puck
