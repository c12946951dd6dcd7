#include "services/camera/source_watch.h"

#include <string>
#include <utility>

namespace puck {

void SourceWatch::look(const EventSource& source) {
  look_at_drops(source);
  look_at_messages(source);
  const std::int64_t overflowed = source.events_overflowed();
  overflows_ = std::exchange(overflow_seen_, overflowed) != overflowed;
}

void SourceWatch::look_at_drops(const EventSource& source) {
  const std::int64_t drops = source.events_dropped() + source.malformed_words();
  if (drops == drops_told_) return;
  drops_told_ = drops;
  log_.warn("input", std::to_string(source.events_dropped()) + " events dropped, " +
                         std::to_string(source.malformed_words()) + " malformed words so far");
}

void SourceWatch::look_at_messages(const EventSource& source) {
  const auto port = source.port_counts();
  if (!port || port->lost + port->malformed == messages_told_) return;
  messages_told_ = port->lost + port->malformed;
  log_.warn("port", std::to_string(port->lost) + " messages of " + std::to_string(port->messages) +
                        " were lost, " + std::to_string(port->malformed) + " held no events");
}

}  // namespace puck
