#include "common/recording/recording.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "common/io/byte_source.h"
#include "common/io/output_file.h"
#include "common/io/peeked_bytes.h"
#include "common/io/temporary_path.h"
#include "common/messaging/log_file.h"
#include "common/messaging/log_format.h"
#include "common/recording/event_log_reader.h"
#include "common/recording/event_log_writer.h"
#include "common/recording/log_recording.h"

namespace puck {
namespace {

/// A log that was copied from other bytes. The log's reader opens the file for each reading, so the
/// copy stays.
class CopiedLog final : public EventReader {
 public:
  CopiedLog(ByteSource& bytes, const std::string& prefix) : copy_("puck-log-") {
    OutputFile file(copy_.path());
    std::vector<std::byte> block(std::size_t{1} << 20);
    while (const std::size_t count = bytes.read(block)) {
      file.append({reinterpret_cast<const char*>(block.data()), count});
    }
    file.flush();
    events_ = open_event_log(copy_.path(), prefix, EventLog::Sessions::kJoined);
  }

  SensorSize sensor_size() const override { return events_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override {
    return events_->read(packet, max_events);
  }
  void rewind() override { events_->rewind(); }
  const EventCounters& counters() const override { return events_->counters(); }
  RecordingFacts facts() const override { return events_->facts(); }
  std::int64_t session_number() const override { return events_->session_number(); }
  std::vector<std::string> warnings() const override { return events_->warnings(); }

 private:
  TemporaryPath copy_;
  std::unique_ptr<EventReader> events_;
};

}  // namespace

std::unique_ptr<EventReader> open_recording(const std::filesystem::path& path,
                                            const EventFileOptions& options,
                                            const std::string& prefix) {
  try {
    if (path != "-" && is_lcm_log(path))
      return open_event_log(path, prefix, EventLog::Sessions::kJoined);
    auto bytes = std::make_unique<PeekedBytes>(open_bytes(path.string()), kLogMark.size());
    if (bytes->head() ==
        std::string_view(reinterpret_cast<const char*>(kLogMark.data()), kLogMark.size()))
      return std::make_unique<CopiedLog>(*bytes, prefix);
    return open_event_bytes(std::move(bytes), path, options);
  } catch (const LogFileError& error) {
    throw EventFileError(error.what());
  }
}

std::string_view format_of_recording(const std::filesystem::path& path) {
  return path.extension() == ".lcm" ? kLcmLogFormat : format_of_ending(path);
}

std::unique_ptr<EventWriter> make_recording_writer(const std::filesystem::path& path,
                                                   std::string_view format, SensorSize sensor,
                                                   const std::string& prefix) {
  const std::string_view wanted = format.empty() ? format_of_recording(path) : format;
  if (wanted != kLcmLogFormat) return make_event_writer(path, wanted, sensor);
  try {
    return make_event_log_writer(path, sensor, prefix);
  } catch (const std::invalid_argument& error) {
    throw EventFileError(path.string() + ": " + error.what());
  }
}

}  // namespace puck
