#include "common/io/raw_header.h"

#include <algorithm>
#include <stdexcept>

#include "common/io/known_sensors.h"
#include "common/io/parse_number.h"

namespace puck {
namespace {

// Longer lines, and lines with unprintable characters, belong to the data.
constexpr std::size_t kLongestHeaderLine = 1024;

bool is_printable(char character) {
  return character == '\t' || character == '\r' || (character >= 0x20 && character < 0x7f);
}

int parse_size(std::string_view text, const std::string& line) {
  int value = 0;
  if (!parse_number(text, value) || value < 1 || value > SensorSize::kMax) {
    throw std::invalid_argument("the header's line \"% " + line +
                                "\" must give a width and height from 1 to 2048");
  }
  return value;
}

// The value of `key` in `EVT3;height=720;width=1280`.
std::optional<std::string_view> option_of(std::string_view format, std::string_view key) {
  while (true) {
    const std::size_t semicolon = format.find(';');
    const std::string_view part = format.substr(0, semicolon);
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos && part.substr(0, equals) == key) {
      return part.substr(equals + 1);
    }
    if (semicolon == std::string_view::npos) return std::nullopt;
    format.remove_prefix(semicolon + 1);
  }
}

std::optional<SensorSize> sensor_of_system(std::string_view text) {
  int id = 0;
  if (!parse_number(text, id)) return std::nullopt;
  switch (id) {
    // Gen3.0 and Gen3.1 cameras, IMX637, IMX647.
    case 0x15:
    case 0x17:
    case 0x19:
    case 0x1c:
    case 0x1d:
    case 0x21:
    case 0x22:
    case 0x23:
    case 0x28:
    case 0x29:
    case 0x34:
    case 0x36:
    case 0x97:
    case 0x99:
    case 0xa1:
    case 0xa2:
      return SensorSize{640, 480};
    // Gen4.0 and Gen4.1 cameras, IMX636, IMX646.
    case 0x1a:
    case 0x1e:
    case 0x1f:
    case 0x20:
    case 0x27:
    case 0x2e:
    case 0x30:
    case 0x31:
    case 0x32:
    case 0x35:
    case 0x3a:
    case 0x9a:
      return SensorSize{1280, 720};
    // GenX320.
    case 0x40:
      return SensorSize{320, 320};
    default:
      return std::nullopt;
  }
}

std::optional<SensorSize> sensor_of_format(std::string_view format) {
  const auto width = option_of(format, "width");
  const auto height = option_of(format, "height");
  if (!width && !height) return std::nullopt;
  const std::string line = "format " + std::string(format);
  return SensorSize{parse_size(width.value_or(""), line), parse_size(height.value_or(""), line)};
}

std::optional<SensorSize> sensor_of_geometry(std::string_view geometry) {
  if (geometry.empty()) return std::nullopt;
  const std::string line = "geometry " + std::string(geometry);
  const std::size_t x = geometry.find('x');
  if (x == std::string_view::npos) return SensorSize{parse_size("", line), 0};
  return SensorSize{parse_size(geometry.substr(0, x), line),
                    parse_size(geometry.substr(x + 1), line)};
}

}  // namespace

std::string_view RawHeader::value(std::string_view key) const {
  const auto field = std::find_if(fields.begin(), fields.end(),
                                  [key](const auto& candidate) { return candidate.first == key; });
  return field == fields.end() ? std::string_view{} : std::string_view{field->second};
}

std::vector<std::string> RawHeader::repeated_lines() const {
  std::vector<std::string> warnings;
  for (auto field = fields.begin(); field != fields.end(); ++field) {
    const auto first = std::find_if(
        fields.begin(), field, [&](const auto& earlier) { return earlier.first == field->first; });
    if (first == field) continue;
    warnings.push_back("the header's line " + std::to_string(field - fields.begin() + 1) +
                       " repeats \"% " + field->first + "\" of line " +
                       std::to_string(first - fields.begin() + 1) +
                       "; expected it once, and took the first");
  }
  return warnings;
}

std::string_view RawHeader::format_option(std::string_view key) const {
  return option_of(value("format"), key).value_or("");
}

std::string RawHeader::encoding() const {
  const std::string_view format = value("format");
  if (!format.empty()) return std::string(format.substr(0, format.find(';')));
  const std::string_view version = value("evt");
  if (version == "2.0") return "EVT2";
  if (version == "2.1") return "EVT21";
  if (version == "3.0") return "EVT3";
  if (version == "4.0") return "EVT4";
  return version.empty() ? std::string{} : "EVT " + std::string(version);
}

std::optional<SensorSize> RawHeader::sensor() const {
  const auto by_format = sensor_of_format(value("format"));
  const auto by_geometry = sensor_of_geometry(value("geometry"));
  if (by_format && by_geometry && *by_format != *by_geometry) {
    throw std::invalid_argument("the header's lines \"% format\" and \"% geometry\" disagree");
  }
  return by_format ? by_format : by_geometry;
}

std::optional<SensorSize> RawHeader::sensor_of_camera() const {
  if (const auto sensor = sensor_of_system(value("system_ID"))) return sensor;
  for (const std::string_view key : {"generation", "sensor_generation"}) {
    if (value(key).starts_with("3.")) return SensorSize{640, 480};
    if (value(key).starts_with("4.")) return SensorSize{1280, 720};
  }
  for (const std::string_view key : {"sensor_name", "plugin_name"}) {
    if (const auto sensor = puck::sensor_of_camera(value(key))) return sensor;
  }
  return std::nullopt;
}

std::optional<RawHeader> parse_raw_header(std::span<const std::byte> bytes, bool is_all) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  RawHeader header;
  while (true) {
    const std::string_view rest = text.substr(header.length);
    const std::string_view start = rest.substr(0, 2);
    if (start != std::string_view("% ").substr(0, start.size())) return header;
    const std::size_t line_end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, line_end);
    if (line.size() > kLongestHeaderLine || !std::all_of(line.begin(), line.end(), is_printable)) {
      return header;
    }
    if (line_end == rest.size()) {
      if (is_all) return header;
      return std::nullopt;
    }
    header.length += line_end + 1;

    std::string_view content = line.substr(2);
    if (content.ends_with('\r')) content.remove_suffix(1);
    if (content == "end") return header;
    const std::size_t space = std::min(content.find(' '), content.size());
    header.fields.emplace_back(content.substr(0, space),
                               content.substr(std::min(space + 1, content.size())));
  }
}

}  // namespace puck
