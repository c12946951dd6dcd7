#include "services/camera/stream_source.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include "common/io/event_reader.h"

namespace puck {
namespace {

constexpr std::size_t kBufferBytes = 65536;
constexpr int kWaitMs = 2;

}  // namespace

DescriptorEvents::DescriptorEvents(int descriptor, std::string name,
                                   const EventFileOptions& options)
    : descriptor_(descriptor),
      name_(std::move(name)),
      stream_(name_, options),
      order_(options.reorder_us),
      buffer_(kBufferBytes) {}

DescriptorEvents::Outcome DescriptorEvents::next(EventPacket& packet) {
  if (order_.take(packet, EventSource::kChunkEvents)) return Outcome::kEvents;
  if (used_ == size_ && !stream_.has_backlog() && !is_finished_) {
    const Outcome outcome = read_more();
    if (outcome != Outcome::kEvents) return outcome;
  }
  used_ += stream_.decode(std::span(buffer_).subspan(used_, size_ - used_), decoded_,
                          EventSource::kChunkEvents);
  order_.add(decoded_);
  const bool is_end = is_finished_ && used_ == size_ && !stream_.has_backlog();
  if (is_end) order_.finish();
  if (order_.take(packet, EventSource::kChunkEvents)) return Outcome::kEvents;
  return is_end ? Outcome::kEnd : Outcome::kNothingYet;
}

// Returns kEvents when there are bytes to decode.
DescriptorEvents::Outcome DescriptorEvents::read_more() {
  pollfd waiting{descriptor_, POLLIN, 0};
  const int ready = poll(&waiting, 1, kWaitMs);
  if (ready == 0 || (ready < 0 && errno == EINTR)) return Outcome::kNothingYet;
  const ssize_t count = read(descriptor_, buffer_.data(), buffer_.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return Outcome::kNothingYet;
  if (count < 0) throw EventFileError(name_ + ": cannot be read: " + std::strerror(errno));
  used_ = 0;
  size_ = static_cast<std::size_t>(count);
  if (count == 0) {
    is_finished_ = true;
    stream_.finish();
  }
  return Outcome::kEvents;
}

StdinSource::StdinSource(const EventFileOptions& options)
    : events_(STDIN_FILENO, "stdin", options) {}

EventSource::Outcome StdinSource::next(Chunk& chunk) {
  switch (events_.next(chunk.packet)) {
    case DescriptorEvents::Outcome::kEvents:
      chunk.until = chunk.packet.newest();
      return Outcome::kEvents;
    case DescriptorEvents::Outcome::kNothingYet:
      return Outcome::kNothingYet;
    case DescriptorEvents::Outcome::kEnd:
      break;
  }
  return Outcome::kEnd;
}

std::vector<std::string> StdinSource::warnings() const { return events_.stream().warnings(true); }

}  // namespace puck
