#include "common/yarp/port_reader.h"

#include <algorithm>

#include "common/yarp/port_query.h"
#include "common/yarp/text_connection.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

// A larger step of the count is a restart of the port's owner, or damage.
constexpr std::uint64_t kMostLostAtOnce = 1'000'000;

}  // namespace

PortReader::PortReader(const PortReaderParams& params)
    : params_(params),
      name_servers_(
          name_server_addresses(params.server_host, params.server_port, params.server_key)),
      pause_(std::chrono::milliseconds(params.retry_ms)) {}

std::optional<PortMessage> PortReader::next(std::chrono::milliseconds wait) {
  const Deadline until = SteadyClock::now() + wait;
  try {
    if (!connection_) {
      if (next_attempt_ > SteadyClock::now()) waiter_.rest_until(std::min(until, next_attempt_));
      if (next_attempt_ > SteadyClock::now()) return std::nullopt;
      connect();
    }
    return receive(until);
  } catch (const YarpError& error) {
    if (!waiter_.is_stopped()) fail(error.what());
  }
  return std::nullopt;
}

void PortReader::interrupt() {
  stop_.request_stop();
  waker_.wake();
}

void PortReader::connect() {
  const PortAddress& name_server = name_servers_[next_server_];
  next_server_ = (next_server_ + 1) % name_servers_.size();
  const PortAddress address = at_port("the name server", [&] {
    TextConnection names(name_server, params_.local_name, waiter_,
                         in_ms(params_.connect_timeout_ms));
    return find_port(names, params_.port, waiter_, in_ms(params_.answer_timeout_ms));
  });
  connection_.emplace(address, params_.local_name, waiter_, in_ms(params_.connect_timeout_ms),
                      params_.most_bytes);
  connection_->turn_round(waiter_, in_ms(params_.answer_timeout_ms));
  newest_count_.reset();
  ++connections_;
  waiting_for_ = "messages from " + params_.port;
}

std::optional<PortMessage> PortReader::receive(Deadline until) {
  auto bytes = connection_->receive_now();
  if (!bytes && waiter_.wait_for(connection_->descriptor(), POLLIN, until)) {
    bytes = connection_->receive_now();
  }
  if (!bytes) return std::nullopt;
  const PortMessage message = parse_port_message(*bytes);
  note_stamp(message);
  ++messages_;
  pause_.restart();
  return message;
}

void PortReader::note_stamp(const PortMessage& message) {
  if (!message.stamp) return;
  const std::int64_t count = message.stamp->count;
  if (newest_count_ && count > *newest_count_) {
    // Unsigned, as a damaged count may be anything.
    const std::uint64_t step =
        static_cast<std::uint64_t>(count) - static_cast<std::uint64_t>(*newest_count_);
    if (step <= kMostLostAtOnce) messages_lost_ += static_cast<std::int64_t>(step) - 1;
  }
  newest_count_ = count;
}

void PortReader::fail(const std::string& reason) {
  connection_.reset();
  ++failures_;
  waiting_for_ = "a connection to " + params_.port + ": " + reason;
  next_attempt_ = SteadyClock::now() + pause_.take();
}

}  // namespace puck
