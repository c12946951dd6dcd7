#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/io/event_decoder.h"
#include "common/io/event_reader.h"

namespace puck {

/// The beginning of a stream, as far as it has come.
struct StreamHead {
  std::string name;  ///< Of the stream, in messages.
  std::span<const std::byte> bytes;
  bool is_all = false;           ///< The stream ends with `bytes`, or its beginning is too long.
  std::size_t sample_bytes = 0;  ///< So much of it is at hand before a guess is made from it.
  EventFileOptions options;

  std::string_view text() const {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
};

/// What the beginning of a stream states, and how to decode the rest.
struct StreamStart {
  std::size_t header_bytes = 0;                             ///< Before the data.
  std::string encoding;                                     ///< In messages.
  std::vector<std::pair<std::string, std::string>> header;  ///< Its keys and values.
  std::size_t word_bytes = 0;  ///< Of one word; 0: the decoder itself refuses what is malformed.
  std::optional<SensorSize> stated_sensor;
  std::optional<SensorSize> camera_sensor;  ///< By the camera's name.
  std::string repeat;  ///< How another header within the data begins; empty: cannot be told.
  std::vector<std::string> notes;  ///< Warnings, without the stream's name.
  std::function<std::unique_ptr<EventDecoder>(SensorSize sensor, std::int64_t reorder_us)>
      make_decoder;
};

/// The start of a stream of any format that is one; `std::nullopt` while more bytes are needed.
/// Throws EventFileError for other formats, and for a header that is malformed or incomplete.
std::optional<StreamStart> find_stream_start(const StreamHead& head);

}  // namespace puck
