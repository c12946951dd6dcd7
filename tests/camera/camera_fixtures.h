#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "common/events/event_packet.h"
#include "common/io/event_writer.h"

namespace puck {

/// A folder that is removed with the test.
class CameraFolder {
 public:
  CameraFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "puck_camera_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~CameraFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  CameraFolder(const CameraFolder&) = delete;
  CameraFolder& operator=(const CameraFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// An event with its full time.
struct SeenEvent {
  std::int64_t t_us = 0;
  int x = 0;
  int y = 0;
  int polarity = 0;

  friend bool operator==(const SeenEvent&, const SeenEvent&) = default;
};

inline void append_seen(const EventPacket& packet, std::vector<SeenEvent>& events) {
  for (const Event& event : packet.events) {
    events.push_back({packet.time_of(event).us, event.x, event.y, event.polarity});
  }
}

/// `count` events from `start_us` on, one every `gap_us`.
inline std::vector<SeenEvent> even_events(int count, std::int64_t start_us, std::int64_t gap_us) {
  std::vector<SeenEvent> events;
  for (int i = 0; i < count; ++i) events.push_back({start_us + i * gap_us, i % 64, i % 48, i % 2});
  return events;
}

inline void write_recording(const std::filesystem::path& path,
                            const std::vector<SeenEvent>& events) {
  const auto writer = make_event_writer(path, "evt3", {64, 48});
  EventPacket packet;
  packet.start = {events.front().t_us};
  for (const SeenEvent& seen : events) {
    Event event;
    event.x = static_cast<std::uint16_t>(seen.x);
    event.y = static_cast<std::uint16_t>(seen.y) & 0x7fff;
    event.polarity = seen.polarity ? 1 : 0;
    event.offset_us = static_cast<std::uint32_t>(seen.t_us - packet.start.us);
    packet.events.push_back(event);
  }
  writer->write(packet);
  writer->close();
}

}  // namespace puck
