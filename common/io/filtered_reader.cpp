#include "common/io/filtered_reader.h"

#include <utility>

namespace puck {

FilteredReader::FilteredReader(std::unique_ptr<EventReader> events, EventFilterParams params,
                               std::string name)
    : events_(std::move(events)),
      filter_(std::move(params), events_->sensor_size()),
      name_(std::move(name)) {}

bool FilteredReader::read(EventPacket& packet, std::size_t max_events) {
  // An empty packet would signal the end of the file.
  do {
    if (!events_->read(packet, max_events)) return false;
    filter_.apply(packet);
  } while (packet.empty());
  return true;
}

void FilteredReader::rewind() {
  events_->rewind();
  filter_.reset();
}

std::vector<std::string> FilteredReader::warnings() const {
  std::vector<std::string> warnings = events_->warnings();
  for (const auto& [count, reason] : left_out().reasons()) {
    if (count == 0) continue;
    warnings.push_back(name_ + ": " + std::to_string(count) + " events " + reason +
                       " are left out");
  }
  return warnings;
}

}  // namespace puck
