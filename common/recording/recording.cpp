#include "common/recording/recording.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "common/io/byte_source.h"
#include "common/io/output_file.h"
#include "common/io/peeked_bytes.h"
#include "common/io/unnamed_file.h"
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
  CopiedLog(ByteSource& bytes, const std::string& prefix)
      : copy_("puck-log-"), path_(copy_.path().string()), name_(bytes.name()) {
    OutputFile file(path_);
    std::vector<std::byte> block(std::size_t{1} << 20);
    while (const std::size_t count = bytes.read(block)) {
      file.append({reinterpret_cast<const char*>(block.data()), count});
    }
    file.flush();
    try {
      events_ = open_event_log(path_, prefix, EventLog::Sessions::kJoined);
    } catch (const LogFileError& error) {
      throw EventFileError(with_own_name(error.what()));
    }
  }

  SensorSize sensor_size() const override { return events_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override {
    return events_->read(packet, max_events);
  }
  bool can_rewind() const override { return true; }
  void rewind() override { events_->rewind(); }
  const EventCounters& counters() const override { return events_->counters(); }
  RecordingFacts facts() const override { return events_->facts(); }
  std::vector<std::string> warnings() const override {
    std::vector<std::string> lines = events_->warnings();
    for (std::string& line : lines) line = with_own_name(std::move(line));
    return lines;
  }
  std::int64_t session_number() const override { return events_->session_number(); }

 private:
  // A message names the copy at its beginning.
  std::string with_own_name(std::string message) const {
    return message.starts_with(path_) ? name_ + message.substr(path_.size()) : message;
  }

  UnnamedFile copy_;
  std::string path_;
  std::string name_;
  std::unique_ptr<EventReader> events_;
};

}  // namespace

std::unique_ptr<EventReader> open_recording(const std::filesystem::path& path,
                                            const EventFileOptions& options,
                                            const std::string& prefix) {
  try {
    if (path != "-" && is_lcm_log(path))
      return open_event_log(path, prefix, EventLog::Sessions::kJoined);
    auto bytes = std::make_unique<PeekedBytes>(open_bytes(path.string(), options.interruption),
                                               kLogMark.size());
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

std::vector<std::string> written_format_names() {
  std::vector<std::string> names;
  for (const WrittenFormat& format : kWrittenFormats) names.emplace_back(format.name);
  names.emplace_back(kLcmLogFormat);
  return names;
}

std::string_view usual_ending_of(std::string_view format) {
  for (const WrittenFormat& each : kWrittenFormats) {
    if (each.name == format) return each.usual_ending;
  }
  return ".lcm";
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
