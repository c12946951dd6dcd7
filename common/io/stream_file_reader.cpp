#include "common/io/stream_file_reader.h"

#include <span>
#include <utility>

namespace puck {
namespace {

constexpr std::size_t kBlockBytes = 65536;
// Enough for some 300,000 lines of text, from which the unit of the times may have to be guessed.
constexpr std::size_t kFileSampleBytes = std::size_t{8} << 20;

}  // namespace

StreamFileReader::StreamFileReader(std::unique_ptr<ByteSource> bytes,
                                   const EventFileOptions& options)
    : bytes_(std::move(bytes)), options_(options), block_(kBlockBytes) {
  start();
}

bool StreamFileReader::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  while (packet.events.size() < max_events) {
    block_used_ += stream_->decode(
        std::span(block_).subspan(block_used_, block_size_ - block_used_), packet, max_events);
    if (stream_->has_backlog() && !packet.empty()) break;
    if (block_used_ < block_size_ || stream_->has_backlog()) continue;
    if (is_at_end_) break;
    refill();
  }
  return !packet.empty();
}

void StreamFileReader::rewind() {
  bytes_->rewind();
  start();
}

void StreamFileReader::start() {
  is_at_end_ = false;
  stream_.emplace(bytes_->name(), options_, kFileSampleBytes);
  EventPacket nothing;
  do {
    refill();
    block_used_ += stream_->decode(std::span(block_).first(block_size_), nothing, 0);
  } while (!stream_->sensor_size() && !is_at_end_);
}

std::vector<std::string> StreamFileReader::warnings() const {
  return stream_->warnings(is_at_end_ && !stream_->has_backlog());
}

void StreamFileReader::refill() {
  block_used_ = 0;
  block_size_ = bytes_->read(block_);
  if (block_size_ == 0) {
    is_at_end_ = true;
    stream_->finish();
  }
}

}  // namespace puck
