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

/// A Prophesee RAW byte stream, header first, for files, stdin and TCP. Accepts pieces of any
/// length. One thread at a time.
///
/// The encoding comes from the header, else from `options.from`, which a stream without a header
/// needs. The sensor's size comes from the header, else from `options.sensor`, else from the camera
/// model in the header.
class RawEventStream {
 public:
  /// `name` stands for the stream in messages.
  RawEventStream(std::string name, EventFileOptions options);

  /// As EventDecoder::decode. Throws EventFileError once the header is found to be missing or
  /// incomplete.
  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet, std::size_t max_events);

  /// As EventDecoder::finish. Throws EventFileError when the header was incomplete.
  void finish();

  /// `std::nullopt` until the header is complete.
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
  // The header, and from `early_used_` on the bytes that came with it.
  std::vector<std::byte> early_;
  std::size_t early_used_ = 0;
  EventCounters no_counters_;
};

}  // namespace puck
