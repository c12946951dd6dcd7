#include "common/recording/event_log_reader.h"

namespace puck {
namespace {

// An EventReader throws EventFileError only.
template <typename Action>
auto as_file_error(Action action) {
  try {
    return action();
  } catch (const LogFileError& error) {
    throw EventFileError(error.what());
  }
}

class EventLogReader final : public EventReader {
 public:
  EventLogReader(const std::filesystem::path& path, const std::string& prefix,
                 EventLog::Sessions sessions)
      : log_(path, prefix, sessions) {}

  SensorSize sensor_size() const override { return log_.sensor_size(); }

  bool read(EventPacket& packet, std::size_t max_events) override {
    const bool has_events = as_file_error([&] { return log_.read(packet, max_events); });
    const EventLogCounters& counters = log_.counters();
    counters_.events = counters.events;
    counters_.missing = counters.events_missing + counters.events_dropped;
    counters_.malformed_words = counters.packets_malformed;
    return has_events;
  }

  bool can_rewind() const override { return true; }
  void rewind() override {
    as_file_error([&] { log_.rewind(); });
    counters_ = {};
  }

  const EventCounters& counters() const override { return counters_; }
  RecordingFacts facts() const override {
    return {"LCM log", {{"session", std::to_string(log_.session())}}};
  }
  std::int64_t session_number() const override { return log_.session_number(); }
  std::vector<std::string> warnings() const override { return log_.problems(); }

 private:
  EventLog log_;
  EventCounters counters_;
};

}  // namespace

std::unique_ptr<EventReader> open_event_log(const std::filesystem::path& path,
                                            const std::string& prefix,
                                            EventLog::Sessions sessions) {
  return std::make_unique<EventLogReader>(path, prefix, sessions);
}

}  // namespace puck
