#include "common/io/dat_decoder.h"

#include <algorithm>

#include "common/io/parse_number.h"
#include "common/io/raw_header.h"
#include "common/io/stamped_record_decoder.h"

namespace puck {
namespace {

// The version of records whose header lacks it is judged from so much data.
constexpr std::size_t kVersionSampleBytes = 4096;
constexpr std::size_t kKindBytes = 2;

constexpr StampedLayout kDat2Layout{.x = {.mask = 0x3fff},
                                    .y = {.shift = 14, .mask = 0x3fff},
                                    .polarity = {.shift = 28, .mask = 1}};
constexpr StampedLayout kDat1Layout{
    .x = {.mask = 0x1ff}, .y = {.shift = 9, .mask = 0xff}, .polarity = {.shift = 17, .mask = 1}};

bool fits_version_1(std::span<const std::byte> data) {
  constexpr int kBits = 18;
  constexpr std::size_t kRecordBytes = StampedRun::kRecordBytes;
  for (std::size_t i = 0; i + kRecordBytes <= data.size(); i += kRecordBytes) {
    if (AddressRecord(kDat1Layout, data.data() + i).address >> kBits != 0) return false;
  }
  return true;
}

int header_number(const StreamHead& head, const RawHeader& header, std::string_view key) {
  int value = 0;
  const std::string_view text = header.value(key);
  if (!text.empty() && !parse_number(text, value)) {
    throw EventFileError(head.name + ": the header's line \"% " + std::string(key) + " " +
                         std::string(text) + "\" must give a number");
  }
  return value;
}

std::optional<SensorSize> stated_sensor(const StreamHead& head, const RawHeader& header) {
  const SensorSize sensor{header_number(head, header, "Width"),
                          header_number(head, header, "Height")};
  if (sensor == SensorSize{}) return std::nullopt;
  if (!sensor.is_valid()) {
    throw EventFileError(head.name +
                         ": the header's lines \"% Width\" and \"% Height\" must both be there, "
                         "with numbers from 1 to 2048");
  }
  return sensor;
}

// Throws unless the records are events.
void check_kind(const StreamHead& head, std::size_t at) {
  const auto kind = std::to_integer<unsigned>(head.bytes[at]);
  const auto size = std::to_integer<unsigned>(head.bytes[at + 1]);
  constexpr unsigned kOldEvents = 0x00;
  constexpr unsigned kEvents = 0x0c;
  constexpr unsigned kTriggers = 0x0e;
  if ((kind == kEvents || kind == kOldEvents) && size == 8) return;
  throw EventFileError(head.name + ": the DAT header ends with records of kind " +
                       std::to_string(kind) + (kind == kTriggers ? " (triggers)" : "") + " and " +
                       std::to_string(size) + " bytes, at byte " + std::to_string(at) +
                       "; expected events (kind 0 or 12) of 8 bytes");
}

}  // namespace

std::optional<StreamStart> begin_dat(const StreamHead& head) {
  const auto header = parse_raw_header(head.bytes, head.is_all);
  if (!header) return std::nullopt;
  const std::size_t data = header->length + kKindBytes;
  if (head.bytes.size() < data) {
    if (!head.is_all) return std::nullopt;
    throw EventFileError(head.name + ": ends within its DAT header, at byte " +
                         std::to_string(head.bytes.size()));
  }
  check_kind(head, header->length);

  StreamStart start{.header_bytes = data,
                    .encoding = "DAT",
                    .header = header->fields,
                    .word_bytes = 8,
                    .notes = header->repeated_lines()};
  int version = header_number(head, *header, "Version");
  if (version > 2) {
    throw EventFileError(head.name + ": is DAT of version " + std::to_string(version) +
                         "; expected 1 or 2");
  }
  if (header->value("Version").empty()) {
    const auto sample = head.bytes.subspan(data);
    if (sample.size() < kVersionSampleBytes && !head.is_all) return std::nullopt;
    version = fits_version_1(sample.first(std::min(sample.size(), kVersionSampleBytes))) ? 1 : 2;
    start.notes.push_back(
        "the header lacks its line \"% Version\"; the records look like version " +
        std::to_string(version));
  }
  start.stated_sensor = stated_sensor(head, *header);
  start.repeat = "% " + header->fields.front().first + " ";
  start.make_decoder = [version](SensorSize sensor, std::int64_t reorder_us) {
    const StampedLayout& layout = version < 2 ? kDat1Layout : kDat2Layout;
    return std::make_unique<StampedRecordDecoder>(layout, sensor, reorder_us);
  };
  return start;
}

}  // namespace puck
