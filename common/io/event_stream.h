#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/io/event_decoder.h"
#include "common/io/event_reader.h"
#include "common/io/stream_start.h"

namespace puck {

/// A byte stream of events of any format that is a stream, header first, for files, stdin and TCP.
/// Accepts pieces of any length. One thread at a time.
///
/// The content tells the format, else `options.from` does. Another header within the data, as in
/// two files joined, begins a second part; if its times are older, they are shifted to follow the
/// first part's.
///
/// Throws EventFileError, from `decode` or `finish`, for a header that is missing, incomplete or
/// contradicts the first one, and where more than an eighth of the words are of no known type.
/// Events decoded before are in the packet.
class EventStream {
 public:
  /// So much of a live stream is at hand before a guess is made from its content.
  static constexpr std::size_t kLiveSampleBytes = 65536;

  /// `name` stands for the stream in messages.
  EventStream(std::string name, EventFileOptions options,
              std::size_t sample_bytes = kLiveSampleBytes);

  /// As EventDecoder::decode.
  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet, std::size_t max_events);

  /// Ends the stream; `decode` with no bytes then returns the rest, until has_backlog() is false.
  void finish();

  /// `std::nullopt` until the header is complete.
  std::optional<SensorSize> sensor_size() const { return sensor_; }
  bool has_backlog() const;
  const EventCounters& counters() const { return counters_; }
  RecordingFacts facts() const { return {start_.encoding, start_.header}; }
  /// Faults so far, one line each. `is_complete`: the stream has ended.
  std::vector<std::string> warnings(bool is_complete) const;

 private:
  std::size_t decode_on(std::span<const std::byte> bytes, EventPacket& packet,
                        std::size_t max_events);
  std::size_t collect(std::span<const std::byte> bytes);
  bool try_start();
  std::size_t take(std::span<const std::byte> bytes, EventPacket& packet, std::size_t max_events);
  std::size_t take_possible_repeat(std::span<const std::byte> bytes, EventPacket& packet,
                                   std::size_t max_events);
  std::size_t decode_data(std::span<const std::byte> bytes, EventPacket& packet,
                          std::size_t max_events);
  void add_note(std::string note);
  void place(EventPacket& packet);
  bool begin_next_part(EventPacket& packet, std::size_t max_events);
  bool check_words(EventPacket& packet, std::size_t max_events);
  void update_counters();

  std::string name_;
  EventFileOptions options_;
  std::size_t sample_bytes_;
  std::optional<SensorSize> sensor_;
  StreamStart start_;
  std::unique_ptr<EventDecoder> decoder_;
  std::vector<std::string> notes_;
  std::int64_t more_notes_ = 0;  // that are not kept

  // The header, and from `early_used_` on data that came with it.
  std::vector<std::byte> early_;
  std::size_t early_used_ = 0;

  std::int64_t bytes_taken_ = 0;    // In all.
  std::int64_t data_bytes_ = 0;     // Of this part, without its header.
  std::size_t clean_bytes_ = 0;     // So many of the next ones cannot belong to another header.
  std::size_t repeat_matched_ = 0;  // Bytes of the beginning of another header, not decoded yet …
  std::size_t repeat_fed_ = 0;      // … or, as it is none, so many of them decoded.
  bool is_check_due_ = false;
  bool is_part_ended_ = false;
  bool is_ending_ = false;
  bool is_ended_ = false;

  std::int64_t shift_us_ = 0;  // Of this part's times.
  bool is_shift_known_ = true;
  std::optional<Timestamp> newest_;
  EventCounters counters_before_;  // Of earlier parts.
  EventCounters counters_;
};

}  // namespace puck
