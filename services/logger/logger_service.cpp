#include "services/logger/logger_service.h"

#include <array>
#include <ctime>
#include <limits>
#include <stdexcept>

#include "common/messaging/message_check.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kHandle{20};
constexpr milliseconds kLastDrain{50};
constexpr std::chrono::seconds kFlush{1};

std::string expand(const std::string& pattern) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 4096> path{};
  const std::size_t length = std::strftime(path.data(), path.size(), pattern.c_str(), &local);
  if (length == 0) throw std::invalid_argument("logger.path must be 1 to 4095 bytes long");
  return {path.data(), length};
}

}  // namespace

LoggerParams LoggerService::read_params(Config& config) {
  LoggerParams params;
  config.read("logger.path", params.path);
  config.read("logger.overwrite", params.overwrite);
  config.read("logger.max_bytes", params.max_bytes, 0, std::numeric_limits<std::int64_t>::max());
  return params;
}

LoggerService::LoggerService(const LoggerParams& params, ServiceContext& context)
    : context_(context),
      path_(expand(params.path)),
      max_bytes_(params.max_bytes),
      events_channel_(channel_name(Channel::kEvents, context.bus.prefix())),
      writer_(path_, params.overwrite) {
  context_.bus.subscribe_all([this](const std::string& channel, std::span<const std::uint8_t> bytes,
                                    const Receipt& receipt) { receive(channel, bytes, receipt); });
}

void LoggerService::run(std::stop_token stop) {
  context_.log.info("writing {}", path_);
  context_.status.set_state(ServiceState::kRunning);
  while (!stop.stop_requested()) {
    context_.bus.handle(kHandle);
    flush_when_due();
    poll_status(context_, *this);
  }
  // What has been received already belongs in the log.
  const auto end = Clock::now() + kLastDrain;
  while (context_.bus.handle(milliseconds(0)) > 0 && Clock::now() < end) continue;
  writer_.flush();
  context_.log.info("{} messages, {} bytes in {}", writer_.messages(), writer_.bytes(), path_);
}

void LoggerService::report(StatusReport& report) const {
  report.counters = {
      {"messages_written", writer_.messages()},
      {"bytes_written", writer_.bytes()},
      {"messages_not_written", not_written_},
      {"packets_received", events_.counters().received},
      {"packets_lost", events_.counters().lost},
      {"packets_late", events_.counters().late + events_.counters().duplicates},
      {"packets_rejected", packets_rejected_},
      {"events_lost", events_.counters().items_lost},
  };
}

void LoggerService::receive(const std::string& channel, std::span<const std::uint8_t> bytes,
                            const Receipt& receipt) {
  if (channel == events_channel_) account_for_events(bytes);
  if (writing_ && max_bytes_ > 0 &&
      writer_.bytes() + LogWriter::record_bytes(channel, bytes.size()) > max_bytes_) {
    stop_writing("logger.max_bytes = " + std::to_string(max_bytes_) + " is reached");
  }
  if (writing_) {
    write(channel, bytes, receipt);
  } else {
    ++not_written_;
  }
}

void LoggerService::write(const std::string& channel, std::span<const std::uint8_t> bytes,
                          const Receipt& receipt) {
  try {
    writer_.write(channel, receipt.utime, bytes);
  } catch (const LogFileError& error) {
    ++not_written_;
    stop_writing(error.what());
  }
}

void LoggerService::account_for_events(std::span<const std::uint8_t> bytes) {
  if (const auto rejection = check_message(Channel::kEvents, bytes)) {
    ++packets_rejected_;
    context_.limited_log.warn(events_channel_, "malformed, logged all the same: " + *rejection);
    return;
  }
  const MessageHeader header = read_header(bytes);
  const EventNumbering numbering = read_event_numbering(bytes);
  const std::int64_t lost_before = events_.counters().lost;
  events_.add(header.session, header.seq, numbering.events_before, numbering.events);
  if (events_.counters().lost > lost_before) {
    context_.limited_log.warn(events_channel_,
                              std::to_string(events_.counters().lost) + " packets lost so far");
  }
}

void LoggerService::flush_when_due() {
  const auto now = Clock::now();
  if (!writing_ || now < flush_due_) return;
  flush_due_ = now + kFlush;
  try {
    writer_.flush();
  } catch (const LogFileError& error) {
    stop_writing(error.what());
  }
}

void LoggerService::stop_writing(const std::string& why) {
  writing_ = false;
  context_.log.error("nothing more is written: {}", why);
  context_.status.set_state(ServiceState::kDegraded, "nothing more is written: " + why);
}

}  // namespace puck
