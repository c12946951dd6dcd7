#include "common/io/raw_start.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "common/io/evt21_decoder.h"
#include "common/io/raw_header.h"

namespace puck {
namespace {

// The order of EVT 2.1's halves is judged from so much data.
constexpr std::size_t kOrderSampleBytes = 4096;

struct Encoding {
  std::string_view name;  // In a header.
  std::string_view from;
  RawEncoding encoding;
  std::size_t word_bytes;
};

constexpr std::array<Encoding, 4> kEncodings{{
    {"EVT2", "evt2", RawEncoding::kEvt2, 4},
    {"EVT21", "evt21", RawEncoding::kEvt21, 8},
    {"EVT3", "evt3", RawEncoding::kEvt3, 2},
    {"EVT4", "evt4", RawEncoding::kEvt4, 4},
}};

constexpr const char* kExpected = "expected EVT2, EVT21, EVT3 or EVT4";

const Encoding& encoding_of(const StreamHead& head, const RawHeader& header) {
  const std::string name = header.encoding();
  const auto found = std::find_if(kEncodings.begin(), kEncodings.end(), [&](const auto& known) {
    return name.empty() ? known.from == head.options.from : known.name == name;
  });
  if (found != kEncodings.end()) return *found;
  if (!name.empty()) {
    throw EventFileError(head.name + ": events are encoded as " + name + "; " + kExpected);
  }
  throw EventFileError(
      head.name +
      ": the header does not say how events are encoded; expected a line such as \"% evt 3.0\", or "
      "the format as an option (evt2, evt21, evt3 or evt4)");
}

// The order of EVT 2.1's halves, by the data; where they cannot tell, by the header.
Evt21Decoder::Order order_of(const StreamHead& head, const RawHeader& header,
                             std::span<const std::byte> data, std::vector<std::string>& notes) {
  using Order = Evt21Decoder::Order;
  const std::string_view stated = header.format_option("endianness");
  if (!stated.empty() && stated != "little" && stated != "legacy") {
    throw EventFileError(head.name + ": the header's endianness is \"" + std::string(stated) +
                         "\"; expected little or legacy");
  }
  const Order stated_order = stated == "legacy" ? Order::kLegacy : Order::kLittle;
  const Order order = Evt21Decoder::likely_order(data).value_or(stated_order);
  if (!stated.empty() && order != stated_order) {
    notes.push_back("the header says that the words' order is " + std::string(stated) +
                    ", but there are time words only in the other order, which was taken");
  }
  return order;
}

}  // namespace

std::optional<StreamStart> begin_raw(const StreamHead& head) {
  const auto header = parse_raw_header(head.bytes, head.is_all);
  if (!header) return std::nullopt;
  const Encoding& known = encoding_of(head, *header);
  RawEncoding encoding = known.encoding;
  StreamStart start{.header_bytes = header->length,
                    .encoding = std::string(known.name),
                    .header = header->fields,
                    .word_bytes = known.word_bytes,
                    .notes = header->repeated_lines()};
  if (encoding == RawEncoding::kEvt21) {
    const auto data = head.bytes.subspan(header->length);
    if (data.size() < kOrderSampleBytes && !head.is_all) return std::nullopt;
    const auto sample = data.first(std::min(data.size(), kOrderSampleBytes));
    if (order_of(head, *header, sample, start.notes) == Evt21Decoder::Order::kLegacy) {
      encoding = RawEncoding::kEvt21Legacy;
    }
  }
  try {
    start.stated_sensor = header->sensor();
  } catch (const std::invalid_argument& error) {
    throw EventFileError(head.name + ": " + error.what());
  }
  start.camera_sensor = header->sensor_of_camera();
  start.repeat = "% " + (header->fields.empty() ? "evt" : header->fields.front().first) + " ";
  start.make_decoder = [encoding](SensorSize sensor, std::int64_t reorder_us) {
    return make_event_decoder(encoding, sensor, reorder_us);
  };
  return start;
}

}  // namespace puck
