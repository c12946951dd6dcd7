#include "services/logger/logger_service.h"

#include <thread>

#include <spdlog/fmt/fmt.h>

#include "common/messaging/message_check.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHandle{20};
// At a low rate messages gather for this time, so that the logger does not wake for every message
// and delay the tracker on a busy machine. With a longer time a burst could fill the socket; at a
// higher rate there is no wait.
constexpr milliseconds kGatherMessages{1};
constexpr std::size_t kLittleBytes = 16'384;
constexpr milliseconds kLastDrain{50};
// STATUS reports a loss for this time.
constexpr std::chrono::seconds kTellOfLoss{5};
// Written data must be on the disk within this time.
constexpr std::chrono::seconds kLongestLag{1};

}  // namespace

LoggerService::LoggerService(const LoggerParams& params, ServiceContext& context)
    : context_(context),
      events_channel_(channel_name(Channel::kEvents, context.bus.prefix())),
      files_(params, context.bus.prefix(), sync_),
      not_queued_(context.bus.prefix()),
      thread_(static_cast<std::size_t>(params.queue_bytes),
              [this](std::span<std::uint8_t> records) { return files_.write(records); }) {
  context_.bus.subscribe_all([this](std::string_view channel, std::span<const std::uint8_t> bytes,
                                    const Receipt& receipt) { receive(channel, bytes, receipt); });
}

void LoggerService::run(std::stop_token stop) {
  context_.status.set_state(ServiceState::kRunning);
  while (!stop.stop_requested()) {
    taken_bytes_ = 0;
    context_.bus.handle(kHandle);
    if (taken_bytes_ < kLittleBytes) std::this_thread::sleep_for(kGatherMessages);
    tell_of_progress();
    poll_status(context_, *this);
  }
  // Received messages still belong in the log.
  const auto end = Clock::now() + kLastDrain;
  while (context_.bus.handle(milliseconds(0)) > 0 && Clock::now() < end) continue;
  thread_.finish();
  tell_of_progress();
  const LogProgress progress = files_.progress();
  context_.log.info(fmt::format("{} messages, {} bytes in {} files, the last {}", progress.messages,
                                progress.bytes, progress.files, progress.path));
}

void LoggerService::report(StatusReport& report) const {
  const LogProgress progress = files_.progress();
  const auto lag = std::chrono::duration_cast<std::chrono::microseconds>(sync_.lag());
  report.counters = {
      {"messages_written", progress.messages},
      {"bytes_written", progress.bytes},
      {"packets_received", events_.counters().received},
      {"packets_lost", events_.counters().lost},
      {"packets_late", events_.counters().late + events_.counters().duplicates},
      {"packets_rejected", packets_rejected_},
      {"events_lost", events_.counters().items_lost},
      {"files", progress.files},
      {"files_removed", progress.files_removed},
      {"queue_bytes", static_cast<std::int64_t>(thread_.queue().bytes())},
      {"queue_most_bytes", static_cast<std::int64_t>(thread_.queue().most_bytes())},
      {"not_on_disk_us", lag.count()},
  };
  ChannelTally not_written = files_.not_written();
  not_written.add(not_queued_);
  not_written.report("messages_not_written", report);
}

void LoggerService::receive(std::string_view channel, std::span<const std::uint8_t> bytes,
                            const Receipt& receipt) {
  taken_bytes_ += bytes.size();
  if (channel == events_channel_) account_for_events(bytes);
  if (thread_.push(channel, receipt.utime, bytes)) return;
  not_queued_.add(channel);
  queue_was_full_until_ = Clock::now() + kTellOfLoss;
}

void LoggerService::account_for_events(std::span<const std::uint8_t> bytes) {
  if (const auto rejection = check_message(Channel::kEvents, bytes)) {
    ++packets_rejected_;
    context_.limited_log.warn(events_channel_,
                              "malformed message, written unchanged: " + *rejection);
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

/// Present problem of the log.
std::optional<std::string> LoggerService::find_trouble() const {
  const LogProgress progress = files_.progress();
  if (progress.problem) return "cannot write: " + *progress.problem;
  if (Clock::now() < queue_was_full_until_) {
    return "the disk is too slow: the queue (logger.queue_bytes) was full, and messages were "
           "dropped";
  }
  if (const std::string problem = sync_.problem(); !problem.empty()) return problem;
  if (sync_.lag() > kLongestLag) {
    return "the disk is slow: data written 1 s ago is not synced yet";
  }
  if (!progress.quota_problem.empty()) {
    return "logger.quota_bytes is exceeded: " + progress.quota_problem;
  }
  return std::nullopt;
}

void LoggerService::tell_of_progress() {
  const std::string path = files_.progress().path;
  if (path != told_path_) {
    context_.log.info("writing " + path);
    told_path_ = path;
  }
  auto trouble = find_trouble();
  if (trouble == trouble_) return;
  trouble_ = std::move(trouble);
  if (trouble_) {
    context_.log.error(*trouble_);
    context_.status.set_state(ServiceState::kDegraded, *trouble_);
  } else {
    context_.log.info("writing again");
    context_.status.set_state(ServiceState::kRunning);
  }
}

}  // namespace puck
