#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_order.h"
#include "common/io/event_stream.h"
#include "services/camera/event_source.h"

namespace puck {

/// A stream of events from a file descriptor, for stdin and TCP.
class DescriptorEvents {
 public:
  enum class Outcome { kEvents, kNothingYet, kEnd };

  /// The descriptor stays the caller's. `name` stands for it in messages.
  DescriptorEvents(int descriptor, std::string name, const EventFileOptions& options);

  /// Waits a few ms for bytes. Throws EventFileError if they are no stream of events or reading
  /// fails.
  Outcome next(EventPacket& packet);

  const EventStream& stream() const { return stream_; }
  const std::string& name() const { return name_; }
  std::int64_t dropped() const { return stream_.counters().dropped() + order_.dropped(); }

 private:
  Outcome read_more();

  int descriptor_;
  std::string name_;
  EventStream stream_;
  EventOrder order_;
  EventPacket decoded_;
  std::vector<std::byte> buffer_;
  std::size_t used_ = 0;
  std::size_t size_ = 0;
  bool is_finished_ = false;
};

/// Standard input.
class StdinSource final : public EventSource {
 public:
  explicit StdinSource(const EventFileOptions& options);

  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return events_.stream().sensor_size(); }
  std::string waiting_for() const override { return "events on stdin"; }
  std::int64_t events_dropped() const override { return events_.dropped(); }
  std::int64_t malformed_words() const override {
    return events_.stream().counters().malformed_words;
  }
  std::vector<std::string> warnings() const override;

 private:
  DescriptorEvents events_;
};

}  // namespace puck
