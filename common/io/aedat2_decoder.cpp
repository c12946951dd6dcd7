#include "common/io/aedat2_decoder.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/io/known_sensors.h"
#include "common/io/stamped_record_decoder.h"

namespace puck {
namespace {

constexpr std::size_t kRecordBytes = StampedRun::kRecordBytes;
// Without a camera's name, the addresses in so much data decide.
constexpr std::size_t kAddressSampleBytes = 4096;

constexpr SensorSize kDvs128{128, 128};
constexpr SensorSize kDavis240{240, 180};
constexpr SensorSize kDavis346{346, 260};

// Counters wrap after 31 or 32 bits; counting 31 is right for both.
constexpr int kCountedBits = 31;

// Bit 15 marks a synchronising pulse.
constexpr StampedLayout kDvs128Layout{
    .is_big_endian = true,
    .stamp_bits = kCountedBits,
    .other_bits = 0xffff8000U,
    .x = {.shift = 1, .mask = 127, .is_mirrored = true, .last = 127},
    .y = {.shift = 8, .mask = 127, .is_mirrored = true, .last = 127},
    .polarity = {.mask = 1, .is_mirrored = true, .last = 1}};

// Bit 31 marks samples of frames and of the IMU, bit 10 external pulses.
StampedLayout davis_layout(SensorSize sensor) {
  return {.is_big_endian = true,
          .stamp_bits = kCountedBits,
          .other_bits = 0x80000400U,
          .x = {.shift = 12,
                .mask = 1023,
                .is_mirrored = true,
                .last = static_cast<std::uint32_t>(sensor.width - 1)},
          .y = {.shift = 22,
                .mask = 511,
                .is_mirrored = true,
                .last = static_cast<std::uint32_t>(sensor.height - 1)},
          .polarity = {.shift = 11, .mask = 1}};
}

// Whether a line, or as much of it as there is, can be of the header: data may begin with `#` too.
bool is_header_text(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  // Names of people and folders may hold other letters than ASCII's.
  const bool may_be_beyond_ascii = line.starts_with("# ");
  return std::all_of(line.begin(), line.end(), [&](char character) {
    const auto byte = static_cast<unsigned char>(character);
    return byte == '\t' || (byte >= 0x20 && byte < 0x7f) || (byte >= 0x80 && may_be_beyond_ascii);
  });
}

bool is_last_line(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
  return line.starts_with("End Of ASCII Header");
}

// Length of the lines of text that begin with `#`, up to the one that ends the header, if there is
// one; `std::nullopt` while the last one is incomplete.
std::optional<std::size_t> header_length(const StreamHead& head) {
  const std::string_view text = head.text();
  std::size_t length = 0;
  while (length < text.size() && text[length] == '#') {
    const std::size_t end = text.find('\n', length);
    const std::string_view line = text.substr(length, end - length + (end != text.npos ? 1 : 0));
    if (!is_header_text(line)) return length;
    if (end == std::string_view::npos) {
      if (!head.is_all) return std::nullopt;
      throw EventFileError(head.name + ": ends within its AEDAT header, at byte " +
                           std::to_string(text.size()));
    }
    length = end + 1;
    if (is_last_line(line)) return length;
  }
  if (length == text.size() && !head.is_all) return std::nullopt;
  return length;
}

// The rest of the header's line `# AEChip: `, or of another that names the camera.
std::optional<SensorSize> sensor_of_header(std::string_view header) {
  for (const std::string_view key : {"AEChip:", "HardwareInterface:"}) {
    const std::size_t at = header.find(key);
    if (at == std::string_view::npos) continue;
    if (const auto sensor = sensor_of_camera(header.substr(at, header.find('\n', at) - at))) {
      return sensor;
    }
  }
  return std::nullopt;
}

bool fits_dvs128(std::span<const std::byte> data) {
  for (std::size_t i = 0; i + kRecordBytes <= data.size(); i += kRecordBytes) {
    if (AddressRecord(kDvs128Layout, data.data() + i).address >> 16 != 0) return false;
  }
  return true;
}

}  // namespace

std::optional<StreamStart> begin_aedat2(const StreamHead& head) {
  const auto length = header_length(head);
  if (!length) return std::nullopt;
  StreamStart start{.header_bytes = *length, .encoding = "AEDAT 2.0", .word_bytes = kRecordBytes};
  std::optional<SensorSize> camera = sensor_of_header(head.text().substr(0, *length));
  if (!camera && head.options.sensor != SensorSize{}) camera = head.options.sensor;
  if (!camera) {
    const auto data = head.bytes.subspan(*length);
    if (data.size() < kAddressSampleBytes && !head.is_all) return std::nullopt;
    if (fits_dvs128(data.first(std::min(data.size(), kAddressSampleBytes)))) {
      camera = kDvs128;
      start.notes.push_back("the header names no camera; the addresses look like a DVS128's");
    }
  }
  if (camera != kDvs128 && camera != kDavis240 && camera != kDavis346) {
    throw EventFileError(head.name +
                         ": the AEDAT header names no camera whose addresses are known; expected "
                         "a DVS128, DAVIS240 or DAVIS346, or its size as --width and --height");
  }
  start.stated_sensor = camera;
  start.repeat = "#!AER-DAT2";
  start.make_decoder = [](SensorSize sensor, std::int64_t reorder_us) {
    const StampedLayout layout = sensor == kDvs128 ? kDvs128Layout : davis_layout(sensor);
    return std::make_unique<StampedRecordDecoder>(layout, sensor, reorder_us);
  };
  return start;
}

}  // namespace puck
