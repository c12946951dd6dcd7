#include "common/io/yarp_stream.h"

#include <limits>
#include <utility>

#include "common/io/sensor_choice.h"
#include "common/io/yarp_bottle.h"

namespace puck {
namespace {

// So many records decide the form, too, as they wait in memory.
constexpr std::size_t kMostWaitingWords = std::size_t{1} << 20;
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

}  // namespace

YarpStream::YarpStream(const std::string& name, const EventFileOptions& options)
    : options_(options),
      sensor_(choose_sensor(name, std::nullopt, std::nullopt, options)),
      sample_(sensor_),
      order_(options.reorder_us) {}

void YarpStream::add(std::span<const std::uint8_t> message, double sent_s) {
  if (!parse_yarp_bottle(message, packet_) || !(sent_s >= 0) || sent_s > kLatestYarpTime_s) {
    ++malformed_messages_;
    return;
  }
  packet_.host_time_s = sent_s;
  if (decoder_) {
    decode(packet_);
    return;
  }
  sample_.add(packet_);
  waiting_words_ += packet_.words.size();
  waiting_.push_back(std::move(packet_));
  if (sample_.packets() >= kSampleMessages || waiting_words_ > kMostWaitingWords) decide();
}

void YarpStream::decide() {
  if (decoder_) return;
  decoder_.emplace(sensor_, sample_.form(options_.yarp_eye), options_.reorder_us);
  for (const YarpPacket& packet : std::exchange(waiting_, {})) decode(packet);
}

void YarpStream::finish() {
  decide();
  decoder_->begin(decoded_, kAll);
  decoder_->finish();
  hand_on();
  order_.finish();
}

void YarpStream::decode(const YarpPacket& packet) {
  decoder_->begin(decoded_, kAll);
  decoder_->take(packet);
  hand_on();
}

void YarpStream::hand_on() {
  order_.add(decoded_);
  // Events too far from the first one of a packet begin another one.
  while (decoder_->has_backlog()) {
    decoder_->begin(decoded_, kAll);
    order_.add(decoded_);
  }
}

}  // namespace puck
