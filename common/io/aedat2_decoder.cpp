#include "common/io/aedat2_decoder.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/io/known_sensors.h"
#include "common/io/stamped_record_decoder.h"

namespace puck {
namespace {

constexpr std::size_t kRecordBytes = 8;
// Without a camera's name, the addresses in so much data decide.
constexpr std::size_t kAddressSampleBytes = 4096;

constexpr SensorSize kDvs128{128, 128};
constexpr SensorSize kDavis240{240, 180};
constexpr SensorSize kDavis346{346, 260};

std::uint64_t swapped(std::uint64_t word) {
  word = (word & 0x00ff00ff00ff00ffU) << 8 | (word >> 8 & 0x00ff00ff00ff00ffU);
  word = (word & 0x0000ffff0000ffffU) << 16 | (word >> 16 & 0x0000ffff0000ffffU);
  return word << 32 | word >> 32;
}

struct Aedat2Layout {
  // Counters wrap after 31 or 32 bits; counting 31 is right for both.
  static constexpr int kStampBits = 31;

  static std::uint32_t stamp(std::uint64_t record) {
    return static_cast<std::uint32_t>(swapped(record)) & 0x7fffffffU;
  }
  static std::uint32_t address(std::uint64_t record) {
    return static_cast<std::uint32_t>(swapped(record) >> 32);
  }
};

struct Dvs128Layout : Aedat2Layout {
  // Bit 15 marks a synchronising pulse.
  static bool is_event(std::uint64_t record) { return (address(record) & 0xffff8000U) == 0; }
  static std::uint32_t x(std::uint64_t record) { return 127U - (address(record) >> 1 & 127U); }
  static std::uint32_t y(std::uint64_t record) { return 127U - (address(record) >> 8 & 127U); }
  static std::uint32_t polarity(std::uint64_t record) { return ~address(record) & 1U; }
};

struct DavisLayout : Aedat2Layout {
  // Bit 31 marks samples of frames and of the IMU, bit 10 external pulses.
  static bool is_event(std::uint64_t record) { return (address(record) & 0x80000400U) == 0; }
  std::uint32_t x(std::uint64_t record) const { return last_x - (address(record) >> 12 & 1023U); }
  std::uint32_t y(std::uint64_t record) const { return last_y - (address(record) >> 22 & 511U); }
  static std::uint32_t polarity(std::uint64_t record) { return address(record) >> 11 & 1U; }

  std::uint32_t last_x = 0;
  std::uint32_t last_y = 0;
};

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
    const auto record = load_word<std::uint64_t>(data.data() + i);
    if (Aedat2Layout::address(record) >> 16 != 0) return false;
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
  start.make_decoder = [](SensorSize sensor,
                          std::int64_t reorder_us) -> std::unique_ptr<EventDecoder> {
    if (sensor == kDvs128) {
      return std::make_unique<StampedRecordDecoder<Dvs128Layout>>(Dvs128Layout{}, sensor,
                                                                  reorder_us);
    }
    DavisLayout layout;
    layout.last_x = static_cast<std::uint32_t>(sensor.width - 1);
    layout.last_y = static_cast<std::uint32_t>(sensor.height - 1);
    return std::make_unique<StampedRecordDecoder<DavisLayout>>(layout, sensor, reorder_us);
  };
  return start;
}

}  // namespace puck
