#include "common/io/raw_event_stream.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace puck {
namespace {

constexpr std::size_t kLongestHeader = 65536;

std::string text_of(SensorSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

RawEventStream::RawEventStream(std::string name, EventFileOptions options)
    : name_(std::move(name)), options_(std::move(options)) {}

std::size_t RawEventStream::decode(std::span<const std::byte> bytes, EventPacket& packet,
                                   std::size_t max_events) {
  std::size_t used = 0;
  if (!decoder_) {
    used = std::min(bytes.size(), kLongestHeader - early_.size());
    early_.insert(early_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(used));
    const auto header = parse_raw_header(early_, early_.size() == kLongestHeader);
    if (!header) return used;
    start(*header);
  }
  if (early_used_ < early_.size()) {
    early_used_ += decoder_->decode(std::span(early_).subspan(early_used_), packet, max_events);
    if (early_used_ < early_.size()) return used;
  }
  return used + decoder_->decode(bytes.subspan(used), packet, max_events);
}

void RawEventStream::finish() {
  if (!decoder_) {
    const auto header = parse_raw_header(early_, true);
    start(*header);
  }
  decoder_->finish();
}

bool RawEventStream::has_backlog() const {
  return decoder_ && (early_used_ < early_.size() || decoder_->has_backlog());
}

const EventCounters& RawEventStream::counters() const {
  return decoder_ ? decoder_->counters() : no_counters_;
}

void RawEventStream::start(const RawHeader& header) {
  try {
    const RawEncoding encoding = encoding_of(header);
    sensor_ = sensor_of(header);
    decoder_ = make_event_decoder(encoding, *sensor_);
  } catch (const std::invalid_argument& error) {
    throw EventFileError(name_ + ": " + error.what());
  }
  early_used_ = header.length;
}

RawEncoding RawEventStream::encoding_of(const RawHeader& header) const {
  const std::string encoding = header.encoding();
  if (encoding == "EVT2" || (encoding.empty() && options_.from == "evt2")) {
    return RawEncoding::kEvt2;
  }
  if (encoding == "EVT3" || (encoding.empty() && options_.from == "evt3")) {
    return RawEncoding::kEvt3;
  }
  if (!encoding.empty()) {
    throw std::invalid_argument("events are encoded as " + encoding + "; expected EVT2 or EVT3");
  }
  throw std::invalid_argument(
      header.fields.empty()
          ? "no Prophesee RAW header; expected one (\"% evt 3.0\"), or the format as an option "
            "(evt2 or evt3)"
          : "the header does not say how events are encoded; expected \"% evt 2.0\" or \"% evt "
            "3.0\", or the format as an option (evt2 or evt3)");
}

SensorSize RawEventStream::sensor_of(const RawHeader& header) const {
  const bool is_asked = options_.sensor != SensorSize{};
  if (const auto said = header.sensor()) {
    if (is_asked && options_.sensor != *said) {
      throw std::invalid_argument("the header says that the sensor is " + text_of(*said) +
                                  ", the options that it is " + text_of(options_.sensor));
    }
    return *said;
  }
  if (is_asked) return options_.sensor;
  if (const auto known = header.sensor_of_system()) return *known;
  throw std::invalid_argument(
      "the header does not say how large the sensor is; give width and height (--width and "
      "--height, or the keys width and height)");
}

}  // namespace puck
