#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_order.h"
#include "common/io/event_reader.h"

namespace puck {

/// Another reader's events, put in order. After an error of that reader, the events before it are
/// handed out first.
class OrderedReader final : public EventReader {
 public:
  /// `name`: of the recording, in messages. `notes`: further warnings. Throws EventFileError for an
  /// invalid `reorder_us`.
  OrderedReader(std::unique_ptr<EventReader> events, std::int64_t reorder_us, std::string name,
                std::vector<std::string> notes);

  SensorSize sensor_size() const override { return events_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override;
  bool can_rewind() const override { return events_->can_rewind(); }
  void rewind() override;
  const EventCounters& counters() const override { return counters_; }
  RecordingFacts facts() const override { return events_->facts(); }
  std::optional<double> share_read() const override { return events_->share_read(); }
  std::vector<std::string> warnings() const override;

 private:
  void read_on(std::size_t max_events);

  std::unique_ptr<EventReader> events_;
  std::int64_t reorder_us_;
  std::string name_;
  std::vector<std::string> notes_;
  EventOrder order_;
  EventPacket next_;
  bool is_finished_ = false;
  std::exception_ptr error_;
  EventCounters counters_;
};

}  // namespace puck
