#include "common/io/masked_reader.h"

#include <utility>

namespace puck {

MaskedReader::MaskedReader(std::unique_ptr<EventReader> events, PixelMask mask,
                           std::string_view name)
    : events_(std::move(events)), mask_(std::move(mask)) {
  mask_.check_sensor(events_->sensor_size(), name);
}

bool MaskedReader::read(EventPacket& packet, std::size_t max_events) {
  // An empty packet would signal the end of the file.
  do {
    if (!events_->read(packet, max_events)) return false;
    masked_events_ += mask_.remove_from(packet);
  } while (packet.empty());
  return true;
}

void MaskedReader::rewind() {
  events_->rewind();
  masked_events_ = 0;
}

std::vector<std::string> MaskedReader::warnings() const {
  std::vector<std::string> warnings = events_->warnings();
  if (masked_events_ > 0) {
    warnings.push_back(std::to_string(masked_events_) + " events of " +
                       std::to_string(mask_.pixels().size()) + " masked pixels are left out");
  }
  return warnings;
}

}  // namespace puck
