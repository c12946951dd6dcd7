#include "services/camera/tcp_source.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>

#include "common/posix/dead_peer.h"

namespace puck {
namespace {

constexpr std::chrono::seconds kRetryAfter{1};
constexpr std::chrono::milliseconds kIdle{2};

}  // namespace

struct TcpSource::Address {
  sockaddr_storage storage{};
  socklen_t length = 0;
};

TcpSource::TcpSource(const std::string& host, int port, const EventFileOptions& options)
    : name_(host + ":" + std::to_string(port)),
      options_(options),
      waiting_for_("a connection to " + name_) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0) {
    throw std::runtime_error("camera.tcp_host \"" + host +
                             "\" cannot be found: " + gai_strerror(error));
  }
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    Address& address = addresses_.emplace_back();
    std::memcpy(&address.storage, each->ai_addr, each->ai_addrlen);
    address.length = each->ai_addrlen;
  }
  freeaddrinfo(found);
}

TcpSource::~TcpSource() = default;

EventSource::Outcome TcpSource::next(Chunk& chunk) {
  if (!is_connected()) {
    std::this_thread::sleep_for(kIdle);
    return Outcome::kNothingYet;
  }
  try {
    const DescriptorEvents::Outcome outcome = events_->next(chunk.packet);
    check_sensor();
    if (outcome == DescriptorEvents::Outcome::kEnd) {
      disconnect("it closed the connection");
      return Outcome::kNothingYet;
    }
    if (outcome == DescriptorEvents::Outcome::kNothingYet) return Outcome::kNothingYet;
  } catch (const EventFileError& error) {
    disconnect(error.what());
    return Outcome::kNothingYet;
  }
  place(chunk, time_, is_new_clock_);
  return Outcome::kEvents;
}

void TcpSource::connect() {
  next_attempt_ = Clock::now() + kRetryAfter;
  const Address& address = addresses_[next_address_];
  next_address_ = (next_address_ + 1) % addresses_.size();
  socket_ = FileDescriptor(
      socket(address.storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const auto* generic = reinterpret_cast<const sockaddr*>(&address.storage);
  if (!socket_.is_open() ||
      (::connect(socket_.number(), generic, address.length) != 0 && errno != EINPROGRESS)) {
    disconnect(std::strerror(errno));
    return;
  }
  notice_dead_peer(socket_.number());
}

bool TcpSource::is_connected() {
  if (events_) return true;
  if (!socket_.is_open()) {
    if (Clock::now() < next_attempt_) return false;
    connect();
  }
  if (!socket_.is_open()) return false;
  pollfd waiting{socket_.number(), POLLOUT, 0};
  if (poll(&waiting, 1, 0) <= 0) {
    if (Clock::now() >= next_attempt_) disconnect("it does not answer");
    return false;
  }
  int error = 0;
  socklen_t length = sizeof error;
  getsockopt(socket_.number(), SOL_SOCKET, SO_ERROR, &error, &length);
  if (error != 0) {
    disconnect(std::strerror(error));
    return false;
  }
  waiting_for_ = "events from " + name_;
  events_.emplace(socket_.number(), name_, options_);
  time_.begin_new_clock(1);
  is_new_clock_ = true;
  return true;
}

void TcpSource::disconnect(const std::string& reason) {
  if (events_) {
    ++disconnections_;
    dropped_before_ += events_->stream().counters().dropped();
    malformed_before_ += events_->stream().counters().malformed_words;
    events_.reset();
  }
  socket_ = {};
  waiting_for_ = "a connection to " + name_ + ": " + reason;
  next_attempt_ = Clock::now() + kRetryAfter;
}

// Another sensor at the same address would not match the events published before.
void TcpSource::check_sensor() {
  const auto sensor = events_->stream().sensor_size();
  if (!sensor) return;
  if (sensor_ && *sensor_ != *sensor) throw EventFileError("the sensor's size has changed");
  sensor_ = sensor;
}

std::int64_t TcpSource::events_dropped() const {
  return dropped_before_ + (events_ ? events_->stream().counters().dropped() : 0);
}

std::int64_t TcpSource::malformed_words() const {
  return malformed_before_ + (events_ ? events_->stream().counters().malformed_words : 0);
}

}  // namespace puck
