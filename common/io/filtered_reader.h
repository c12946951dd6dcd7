#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_filter.h"
#include "common/io/event_reader.h"

namespace puck {

/// Another reader's events through a filter.
class FilteredReader final : public EventReader {
 public:
  /// `name`: of the recording, in warnings. Throws std::invalid_argument when the filter does not
  /// fit the reader's sensor.
  FilteredReader(std::unique_ptr<EventReader> events, EventFilterParams params, std::string name);

  SensorSize sensor_size() const override { return filter_.sensor(); }
  bool read(EventPacket& packet, std::size_t max_events) override;
  bool can_rewind() const override { return events_->can_rewind(); }
  void rewind() override;
  /// Of the other reader: what is left out counts as read.
  const EventCounters& counters() const override { return events_->counters(); }
  RecordingFacts facts() const override { return events_->facts(); }
  std::optional<double> share_read() const override { return events_->share_read(); }
  std::vector<std::string> warnings() const override;

  const FilteredEvents& left_out() const { return filter_.left_out(); }

 private:
  std::unique_ptr<EventReader> events_;
  EventFilter filter_;
  std::string name_;
};

}  // namespace puck
