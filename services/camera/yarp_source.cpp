#include "services/camera/yarp_source.h"

#include "common/io/sensor_choice.h"
#include "common/messages/host_time.h"

namespace puck {
namespace {

constexpr std::chrono::milliseconds kMessageWait{2};
// A camera that sends less often than the sample needs is decoded after this time.
constexpr std::chrono::seconds kLongestSample{1};

}  // namespace

YarpSource::YarpSource(const PortReaderParams& params, const EventFileOptions& options)
    : port_(params),
      options_(options),
      name_(params.port),
      sensor_(choose_sensor(name_, std::nullopt, std::nullopt, options)) {}

EventSource::Outcome YarpSource::next(Chunk& chunk) {
  if (take_events(chunk)) return Outcome::kEvents;
  if (is_stream_finished_) close_stream();
  if (const auto message = port_.next(kMessageWait)) take_message(*message);
  if (stream_ && stream_->is_undecided() && Clock::now() - first_message_ > kLongestSample) {
    stream_->decide();
  }
  if (stream_ && !port_.is_connected()) {
    stream_->finish();
    is_stream_finished_ = true;
  }
  return take_events(chunk) ? Outcome::kEvents : Outcome::kNothingYet;
}

void YarpSource::take_message(const PortMessage& message) {
  if (!stream_) {
    stream_.emplace(name_, options_);
    time_.begin_new_clock(1);
    is_new_clock_ = true;
    first_message_ = Clock::now();
  }
  stream_->add(message.content,
               message.stamp ? message.stamp->time_s : static_cast<double>(host_utime()) * 1e-6);
}

void YarpSource::close_stream() {
  dropped_before_ += stream_->dropped();
  malformed_before_ += stream_->counters().malformed_words;
  malformed_messages_before_ += stream_->malformed_messages();
  stream_.reset();
  is_stream_finished_ = false;
}

bool YarpSource::take_events(Chunk& chunk) {
  if (!stream_ || !stream_->take(chunk.packet, kChunkEvents)) return false;
  place(chunk, time_, is_new_clock_);
  return true;
}

std::int64_t YarpSource::events_dropped() const {
  return dropped_before_ + (stream_ ? stream_->dropped() : 0);
}

std::int64_t YarpSource::malformed_words() const {
  return malformed_before_ + (stream_ ? stream_->counters().malformed_words : 0);
}

std::optional<EventSource::PortCounts> YarpSource::port_counts() const {
  return PortCounts{port_.connections(), port_.failures(), port_.messages(), port_.messages_lost(),
                    malformed_messages_before_ + (stream_ ? stream_->malformed_messages() : 0)};
}

}  // namespace puck
