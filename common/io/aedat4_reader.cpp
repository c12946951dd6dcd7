#include "common/io/aedat4_reader.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "common/io/flat_table.h"
#include "common/io/known_sensors.h"
#include "common/io/reader_warnings.h"
#include "common/io/record_run.h"
#include "common/io/sensor_choice.h"
#include "common/io/word_assembler.h"

namespace puck {
namespace {

constexpr std::size_t kMostHeaderBytes = std::size_t{16} << 20;
constexpr std::size_t kEventRecordBytes =
    16;  // i64 t, µs; i16 x; i16 y; u8 polarity; three unused.
constexpr std::size_t kMostFaultLines = 5;
constexpr std::size_t kRestBlockBytes = 65536;

EventRecord record_at(const std::byte* bytes) {
  const auto signed_word = [](const std::byte* word) {
    return static_cast<std::uint32_t>(static_cast<std::int16_t>(load_word<std::uint16_t>(word)));
  };
  return {static_cast<std::int64_t>(load_word<std::uint64_t>(bytes)), signed_word(bytes + 8),
          signed_word(bytes + 10), bytes[12] != std::byte{0}};
}

}  // namespace

Aedat4Reader::Aedat4Reader(std::unique_ptr<ByteSource> bytes, const EventFileOptions& options)
    : bytes_(std::move(bytes)), reorder_us_(options.reorder_us) {
  read_header();
  find_stream(options);
  sink_ = EventSink(sensor_, reorder_us_);
}

void Aedat4Reader::read_header() {
  const auto fail = [this](const std::string& what) {
    throw EventFileError(bytes_->name() + ": has no AEDAT4 header: " + what);
  };
  std::array<std::byte, kAedat4Signature.size() + 4> start{};
  if (bytes_->read(start) < start.size()) fail("it ends within the first line");
  const std::size_t size = load_word<std::uint32_t>(start.data() + kAedat4Signature.size());
  if (size > kMostHeaderBytes) {
    fail(std::to_string(size) + " bytes long by its own account, expected up to 16 MiB");
  }
  std::vector<std::byte> buffer(4 + size);
  std::copy(start.end() - 4, start.end(), buffer.begin());
  const std::size_t got = bytes_->read(std::span(buffer).subspan(4));
  if (got < size) {
    fail("it ends after " + std::to_string(got) + " of " + std::to_string(size) + " bytes");
  }
  position_ = static_cast<std::int64_t>(start.size() + size);
  try {
    header_ = parse_aedat4_header(buffer);
  } catch (const std::invalid_argument& error) {
    fail(error.what());
  }
  if (header_.end_of_packets < position_) header_.end_of_packets = -1;
  unpacker_ = Aedat4Unpacker(header_.packing);
}

void Aedat4Reader::find_stream(const EventFileOptions& options) {
  const std::string& name = bytes_->name();
  const auto found = std::find_if(header_.streams.begin(), header_.streams.end(),
                                  [](const Aedat4Stream& one) { return one.type == "EVTS"; });
  if (found == header_.streams.end()) {
    throw EventFileError(name + ": describes " + std::to_string(header_.streams.size()) +
                         " streams, none of events; expected one of type EVTS");
  }
  stream_ = *found;
  const bool is_told = stream_.sensor != SensorSize{};
  sensor_ = choose_sensor(name, is_told ? std::optional(stream_.sensor) : std::nullopt,
                          sensor_of_camera(stream_.source), options);
}

bool Aedat4Reader::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  sink_.begin(packet, max_events);
  while (sink_.has_room()) {
    if (records_.empty()) {
      if (!take_packet()) break;
      continue;  // It may hold none.
    }
    const std::size_t taken = take_records(
        sink_, run_, records_.size() / kEventRecordBytes,
        [this](std::size_t i) { return record_at(records_.data() + i * kEventRecordBytes); });
    records_ = records_.subspan(taken * kEventRecordBytes);
  }
  return !packet.empty();
}

void Aedat4Reader::rewind() {
  bytes_->rewind();
  read_header();
  sink_ = EventSink(sensor_, reorder_us_);
  records_ = {};
  is_at_end_ = false;
  faults_.clear();
}

std::vector<std::string> Aedat4Reader::warnings() const {
  std::vector<std::string> lines = reader_warnings(
      bytes_->name(), counters(), is_at_end_ && records_.empty() && !sink_.has_backlog());
  for (const std::string& fault : faults_) lines.push_back(one_line(bytes_->name() + ": " + fault));
  return lines;
}

RecordingFacts Aedat4Reader::facts() const {
  constexpr std::array<const char*, 5> kPackings{"not packed", "LZ4", "LZ4", "zstd", "zstd"};
  RecordingFacts facts;
  facts.encoding =
      std::string("AEDAT4, ") + kPackings.at(static_cast<std::size_t>(header_.packing));
  for (const Aedat4Stream& stream : header_.streams) {
    std::string text = stream.type;
    if (stream.sensor != SensorSize{}) {
      text +=
          " " + std::to_string(stream.sensor.width) + "x" + std::to_string(stream.sensor.height);
    }
    if (!stream.source.empty()) text += " " + stream.source;
    facts.header.emplace_back("stream " + std::to_string(stream.id), text);
  }
  return facts;
}

// Returns false at the end; true also after a packet without events.
bool Aedat4Reader::take_packet() {
  if (is_at_end_) return false;
  if (header_.end_of_packets >= 0 && position_ >= header_.end_of_packets) return end();
  std::array<std::byte, 8> start{};
  const std::size_t got = bytes_->read(start);
  if (got < start.size()) {
    sink_.counters().truncated_bytes += static_cast<std::int64_t>(got);
    return end();
  }
  const auto id = static_cast<std::int32_t>(load_word<std::uint32_t>(start.data()));
  const std::size_t size = load_word<std::uint32_t>(start.data() + 4);
  if (size > Aedat4Unpacker::kMostBytes) {
    const std::string rest(reinterpret_cast<const char*>(start.data()), start.size());
    if (kAedat4Signature.starts_with(rest)) return end({}, rest);
    ++sink_.counters().malformed_words;
    return end("a packet at byte " + std::to_string(position_) + " claims " + std::to_string(size) +
                   " bytes; expected up to 32 MiB; the rest was left out",
               rest);
  }
  packed_.resize(size);
  const std::size_t bytes = bytes_->read(packed_);
  if (bytes < size) {
    sink_.counters().truncated_bytes += static_cast<std::int64_t>(start.size() + bytes);
    return end();
  }
  position_ += static_cast<std::int64_t>(start.size());
  if (id == stream_.id) {
    unpack(size);
  } else {
    ++sink_.counters().other_data;
  }
  position_ += static_cast<std::int64_t>(size);
  return true;
}

void Aedat4Reader::unpack(std::size_t bytes) {
  try {
    const auto content = unpacker_.unpack(std::span(packed_).first(bytes));
    records_ = FlatTable(content, "EVTS").list(0, kEventRecordBytes);
  } catch (const std::invalid_argument& error) {
    ++sink_.counters().malformed_words;
    if (faults_.size() >= kMostFaultLines) return;
    faults_.push_back("the packet at byte " + std::to_string(position_) + ": " + error.what());
  }
}

// `rest`: bytes from `position_` on that are read already. Throws EventFileError.
bool Aedat4Reader::end(const std::string& fault, std::string rest) {
  is_at_end_ = true;
  if (!fault.empty()) faults_.push_back(fault);
  read_rest(std::move(rest));
  return false;
}

void Aedat4Reader::read_rest(std::string rest) {
  bool is_found = false;
  while (true) {
    const std::size_t at = is_found ? std::string::npos : rest.find(kAedat4Signature);
    if (at != std::string::npos) {
      is_found = true;
      faults_.push_back("another AEDAT4 header at byte " +
                        std::to_string(position_ + static_cast<std::int64_t>(at)) +
                        ", as in joined files; what follows was left out: split them first");
    }
    // The signature may be cut by the end of the block.
    const std::size_t kept = std::min(rest.size(), kAedat4Signature.size() - 1);
    position_ += static_cast<std::int64_t>(rest.size() - kept);
    rest.erase(0, rest.size() - kept);
    rest.resize(kept + kRestBlockBytes);
    const std::size_t got = bytes_->read(std::as_writable_bytes(std::span(rest)).subspan(kept));
    if (got == 0) return;
    rest.resize(kept + got);
  }
}

}  // namespace puck
