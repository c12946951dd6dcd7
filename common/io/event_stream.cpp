#include "common/io/event_stream.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "common/io/byte_search.h"
#include "common/io/reader_warnings.h"
#include "common/io/sensor_choice.h"

namespace puck {
namespace {

constexpr std::size_t kLongestHeader = 65536;
// The words' types are checked after so many bytes of data, and at the end.
constexpr std::int64_t kCheckBytes = 4096;
// Fewer words prove nothing.
constexpr std::int64_t kFewestWords = 16;
// Random bytes have a quarter of unknown words in EVT3, half or more in the others.
constexpr std::int64_t kLeastShareOfUnknown = 8;

std::string_view text_of_bytes(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

EventStream::EventStream(std::string name, EventFileOptions options, std::size_t sample_bytes)
    : name_(std::move(name)), options_(std::move(options)), sample_bytes_(sample_bytes) {}

std::size_t EventStream::decode(std::span<const std::byte> bytes, EventPacket& packet,
                                std::size_t max_events) {
  try {
    const std::size_t used = decode_on(bytes, packet, max_events);
    update_counters();
    return used;
  } catch (const EventFileError&) {
    update_counters();
    throw;
  }
}

std::size_t EventStream::decode_on(std::span<const std::byte> bytes, EventPacket& packet,
                                   std::size_t max_events) {
  std::size_t used = 0;
  while (true) {
    if (is_check_due_ && !check_words(packet, max_events)) return used;
    if (is_part_ended_ && !begin_next_part(packet, max_events)) break;
    if (!decoder_) {
      used += collect(bytes.subspan(used));
      if (!try_start()) break;
    }
    const bool is_early = early_used_ < early_.size();
    const auto rest =
        is_early ? std::span<const std::byte>(early_).subspan(early_used_) : bytes.subspan(used);
    const std::size_t taken = take(rest, packet, max_events);
    (is_early ? early_used_ : used) += taken;
    if (taken == 0 && !is_part_ended_ && !is_check_due_) break;
  }
  const bool is_all_taken = decoder_ && early_used_ == early_.size() && repeat_matched_ == 0;
  if (is_ending_ && !is_ended_ && is_all_taken && !is_part_ended_) {
    decoder_->finish();
    is_ended_ = true;
    is_check_due_ = true;
    check_words(packet, max_events);
  }
  return used;
}

void EventStream::finish() {
  is_ending_ = true;
  EventPacket nothing;
  decode({}, nothing, 0);
}

bool EventStream::has_backlog() const {
  if ((is_ending_ && !is_ended_) || is_check_due_) return true;
  return decoder_ && (early_used_ < early_.size() || is_part_ended_ || decoder_->has_backlog());
}

std::vector<std::string> EventStream::warnings(bool is_complete) const {
  std::vector<std::string> lines;
  for (const std::string& note : notes_) lines.push_back(name_ + ": " + note);
  if (decoder_) {
    for (const std::string& note : decoder_->notes()) lines.push_back(name_ + ": " + note);
  }
  if (more_notes_ > 0) {
    lines.push_back(name_ + ": " + std::to_string(more_notes_) +
                    " more headers and shifts like these");
  }
  for (std::string& line : reader_warnings(name_, counters_, is_complete, bytes_taken_)) {
    lines.push_back(std::move(line));
  }
  return lines;
}

// Keeps the next bytes for the header. Returns their number.
std::size_t EventStream::collect(std::span<const std::byte> bytes) {
  const std::size_t most = std::max(kLongestHeader, sample_bytes_);
  const std::size_t count = std::min(bytes.size(), most - std::min(most, early_.size()));
  early_.insert(early_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

// Returns false while the header is incomplete.
bool EventStream::try_start() {
  const bool is_all = is_ending_ || early_.size() >= std::max(kLongestHeader, sample_bytes_);
  const std::string part =
      sensor_ ? name_ + ": in its part from byte " + std::to_string(bytes_taken_) + " on" : name_;
  auto start = find_stream_start({.name = part,
                                  .bytes = early_,
                                  .is_all = is_all,
                                  .sample_bytes = sample_bytes_,
                                  .options = options_});
  if (!start) return false;
  if (!sensor_) {
    sensor_ = choose_sensor(name_, start->stated_sensor, start->camera_sensor, options_);
  } else if (start->stated_sensor && *start->stated_sensor != *sensor_) {
    throw EventFileError(part + ": the sensor is " + std::to_string(start->stated_sensor->width) +
                         "x" + std::to_string(start->stated_sensor->height) + " and before " +
                         std::to_string(sensor_->width) + "x" + std::to_string(sensor_->height) +
                         "; expected one sensor");
  }
  start_ = std::move(*start);
  for (std::string& note : start_.notes) add_note(std::move(note));
  decoder_ = start_.make_decoder(*sensor_, options_.reorder_us);
  early_used_ = start_.header_bytes;
  bytes_taken_ += static_cast<std::int64_t>(start_.header_bytes);
  data_bytes_ = 0;
  // What begins like a header and is none must not be found again.
  clean_bytes_ = start_.header_bytes == 0 ? start_.repeat.size() : 0;
  return true;
}

// Decodes some of the bytes, up to another header. Returns their number; 0 when the packet is full,
// there are none, or the part has ended.
std::size_t EventStream::take(std::span<const std::byte> bytes, EventPacket& packet,
                              std::size_t max_events) {
  if (repeat_matched_ > 0) return take_possible_repeat(bytes, packet, max_events);
  if (clean_bytes_ == 0 && !bytes.empty()) {
    clean_bytes_ = start_.repeat.empty() ? bytes.size() : find_start_of(start_.repeat, bytes);
    if (clean_bytes_ == 0) {
      repeat_matched_ = std::min(bytes.size(), start_.repeat.size());
      return repeat_matched_;
    }
  }
  std::size_t most = std::min(clean_bytes_, bytes.size());
  if (data_bytes_ < kCheckBytes) {
    most = std::min(most, static_cast<std::size_t>(kCheckBytes - data_bytes_));
  }
  const std::size_t taken = decode_data(bytes.first(most), packet, max_events);
  clean_bytes_ -= taken;
  return taken;
}

// The bytes taken last are the beginning of another header, or data that look like it.
std::size_t EventStream::take_possible_repeat(std::span<const std::byte> bytes, EventPacket& packet,
                                              std::size_t max_events) {
  const std::string_view wanted = std::string_view(start_.repeat).substr(repeat_matched_);
  const std::string_view next = text_of_bytes(bytes).substr(0, wanted.size());
  if (repeat_fed_ == 0 && wanted.empty()) {
    add_note("another header at byte " + std::to_string(bytes_taken_) +
             ", as in joined files; what follows is read as another part");
    decoder_->finish();
    is_part_ended_ = true;
    return 0;
  }
  const bool is_end = bytes.empty() && is_ending_ && early_used_ == early_.size();
  if (repeat_fed_ == 0 && !is_end && next == wanted.substr(0, next.size())) {
    repeat_matched_ += next.size();
    return next.size();
  }
  const auto matched = std::as_bytes(std::span(start_.repeat)).first(repeat_matched_);
  repeat_fed_ += decode_data(matched.subspan(repeat_fed_), packet, max_events);
  if (repeat_fed_ < repeat_matched_) return 0;
  repeat_fed_ = 0;
  repeat_matched_ = 0;
  return take(bytes, packet, max_events);
}

std::size_t EventStream::decode_data(std::span<const std::byte> bytes, EventPacket& packet,
                                     std::size_t max_events) {
  if (!packet.empty()) packet.start = packet.start - shift_us_;
  std::size_t taken = 0;
  try {
    taken = decoder_->decode(bytes, packet, max_events);
  } catch (const EventFileError&) {
    place(packet);
    throw;
  }
  place(packet);
  bytes_taken_ += static_cast<std::int64_t>(taken);
  data_bytes_ += static_cast<std::int64_t>(taken);
  if (taken > 0 && data_bytes_ == kCheckBytes) is_check_due_ = true;
  return taken;
}

// Shifts the packet to its place in the time of all parts.
void EventStream::place(EventPacket& packet) {
  if (packet.empty()) return;
  if (!is_shift_known_) {
    is_shift_known_ = true;
    const Timestamp first = packet.time_of(packet.events.front());
    // Events of this part may come so much late.
    const std::int64_t gap_us = options_.reorder_us + 1;
    shift_us_ = newest_ && first < *newest_ + gap_us ? *newest_ + gap_us - first : 0;
    if (shift_us_ != 0) {
      add_note("the times of its last part are shifted by " + std::to_string(shift_us_) +
               " µs, to follow those before");
    }
  }
  packet.start = packet.start + shift_us_;
  const Timestamp newest = decoder_->newest() + shift_us_;
  newest_ = newest_ ? std::max(*newest_, newest) : newest;
}

// Of a file with any number of parts, the first notes are enough.
void EventStream::add_note(std::string note) {
  constexpr std::size_t kMostNotes = 20;
  if (notes_.size() < kMostNotes) {
    notes_.push_back(std::move(note));
  } else {
    ++more_notes_;
  }
}

// Returns false while events of the ended part wait for space, or fill the packet.
bool EventStream::begin_next_part(EventPacket& packet, std::size_t max_events) {
  if (decoder_->has_backlog()) decode_data({}, packet, max_events);
  if (decoder_->has_backlog() || !packet.empty()) return false;
  counters_before_ += decoder_->counters();
  for (std::string& note : decoder_->notes()) add_note(std::move(note));
  decoder_.reset();
  const auto repeat = std::as_bytes(std::span(start_.repeat));
  early_.erase(early_.begin(), early_.begin() + static_cast<std::ptrdiff_t>(early_used_));
  early_.insert(early_.begin(), repeat.begin(), repeat.end());
  early_used_ = 0;
  repeat_matched_ = 0;
  is_shift_known_ = false;
  shift_us_ = 0;
  is_part_ended_ = false;
  return true;
}

// Throws where the data cannot be of this encoding. Returns false while events decoded before wait
// for space.
bool EventStream::check_words(EventPacket& packet, std::size_t max_events) {
  if (decoder_->has_backlog()) decode_data({}, packet, max_events);
  if (decoder_->has_backlog()) return false;
  is_check_due_ = false;
  if (start_.word_bytes == 0) return true;
  const std::int64_t words = data_bytes_ / static_cast<std::int64_t>(start_.word_bytes);
  const std::int64_t unknown = decoder_->counters().malformed_words;
  if (words < kFewestWords || unknown * kLeastShareOfUnknown < words) return true;
  throw EventFileError(name_ + ": " + std::to_string(100 * unknown / words) + " % of " +
                       (is_ended_ ? "its " : "its first ") + std::to_string(words) +
                       " words are of no type that " + start_.encoding +
                       " has; expected none: is it another encoding, are the bytes of each word in "
                       "another order, or is a byte missing?");
}

void EventStream::update_counters() {
  counters_ = counters_before_;
  if (decoder_) counters_ += decoder_->counters();
}

}  // namespace puck
