#include "common/recording/event_log_writer.h"

#include <optional>
#include <vector>

#include "common/io/event_checks.h"
#include "common/io/event_reader.h"
#include "common/io/output_file.h"
#include "common/io/unnamed_file.h"
#include "common/messaging/channels.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/session_id.h"

namespace puck {
namespace {

class LogOfEvents final : public EventWriter {
 public:
  LogOfEvents(const std::filesystem::path& path, SensorSize sensor, const std::string& prefix)
      : sensor_(checked_sensor(sensor)),
        channel_(channel_name(Channel::kEvents, prefix)),
        packer_({sensor, EventPackerParams::kMaxBytes}) {
    if (path == "-") copied_.emplace("puck-log-");
    call([&] { log_.emplace(copied_ ? copied_->path() : path, true); });
  }

  ~LogOfEvents() override {
    try {
      close();
    } catch (const std::exception&) {
      // A caller that needs the error calls close() first.
    }
  }

  void write(const EventPacket& events) override {
    for (const Event& event : events.events) {
      const Timestamp time = events.time_of(event);
      check_event(event, time, sensor_, newest_);
      newest_ = time;
    }
    packer_.pack(events.start, events.events, [&](event_packet_t& packet) {
      packet.utime = packet.first_event_us;
      packet.session = session_;
      packet.seq = seq_++;
      packet.recorded = true;
      encode(packet, bytes_);
      call([&] { log_->write(channel_, packet.utime, bytes_); });
    });
  }

  void close() override {
    if (!log_) return;
    call([&] { log_->flush(); });
    log_.reset();
    if (copied_) copy_to_stdout(copied_->path());
  }

 private:
  // With the error of an event file.
  template <typename Action>
  static void call(Action action) {
    try {
      action();
    } catch (const LogFileError& error) {
      throw EventFileError(error.what());
    }
  }

  SensorSize sensor_;
  std::string channel_;
  EventPacker packer_;
  std::optional<UnnamedFile> copied_;
  std::optional<LogWriter> log_;
  std::int64_t session_ = random_session();
  std::int64_t seq_ = 0;
  Timestamp newest_{0};
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<EventWriter> make_event_log_writer(const std::filesystem::path& path,
                                                   SensorSize sensor, const std::string& prefix) {
  return std::make_unique<LogOfEvents>(path, sensor, prefix);
}

}  // namespace puck
