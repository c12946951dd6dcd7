#include "common/io/raw_file_reader.h"

#include <span>

#include "common/io/reader_warnings.h"

namespace puck {
namespace {

constexpr std::size_t kBlockBytes = 262144;

}  // namespace

RawFileReader::RawFileReader(const std::filesystem::path& path, const EventFileOptions& options)
    : name_(path.string()), options_(options), file_(path, std::ios::binary), block_(kBlockBytes) {
  rewind();
}

bool RawFileReader::read(EventPacket& packet, std::size_t max_events) {
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

void RawFileReader::rewind() {
  file_.clear();
  file_.seekg(0);
  is_at_end_ = false;
  stream_.emplace(name_, options_);
  EventPacket nothing;
  do {
    refill();
    block_used_ += stream_->decode(std::span(block_).first(block_size_), nothing, 0);
  } while (!stream_->sensor_size() && !is_at_end_);
}

std::vector<std::string> RawFileReader::warnings() const {
  return reader_warnings(name_, counters(), is_at_end_ && !stream_->has_backlog());
}

void RawFileReader::refill() {
  file_.read(reinterpret_cast<char*>(block_.data()), static_cast<std::streamsize>(block_.size()));
  if (file_.bad()) throw EventFileError(name_ + ": cannot be read to its end");
  block_used_ = 0;
  block_size_ = static_cast<std::size_t>(file_.gcount());
  if (block_size_ == 0) {
    is_at_end_ = true;
    stream_->finish();
  }
}

}  // namespace puck
