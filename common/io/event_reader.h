#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/io/event_decoder.h"
#include "common/io/one_line.h"

namespace puck {

/// An event file or stream cannot be read: the message is one line that names it and says what was
/// expected.
class EventFileError : public std::runtime_error {
 public:
  explicit EventFileError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

/// How to read what a file does not say about itself.
struct EventFileOptions {
  /// "evt2", "evt3", "text" or "yarp"; empty: told from the file's header, else from its ending.
  std::string from;
  /// For files that do not say how large their sensor is; {0, 0}: not known.
  SensorSize sensor;

  /// Text: the order of time, x, y and polarity, with any of ` ,;` between the letters.
  std::string text_columns = "t x y p";
  /// Text: "s", "us", or "auto": seconds where the first time has a decimal point, else µs, and
  /// then one with a fraction is refused.
  std::string text_unit = "auto";
  /// Text: what stands between the columns, "auto" being any run of spaces, tabs, `,` and `;`.
  std::string text_separator = "auto";

  /// YARP log: whose events are read, "left", "right", or "auto": those of the eye that has most at
  /// the beginning.
  std::string yarp_eye = "auto";
};

/// Events of a file, in the order of their times, which are as they stand in the file: no shift.
/// One thread at a time.
class EventReader {
 public:
  /// So many events at a time cost few calls and little memory, where nothing else decides.
  static constexpr std::size_t kUsualEvents = 4096;

  virtual ~EventReader() = default;

  virtual SensorSize sensor_size() const = 0;

  /// Replaces the events in `packet` by the next ones, at most `max_events` (1 or more) of them,
  /// reusing its memory. False at the end of the file; the packet is then empty. Throws
  /// EventFileError when the file cannot be read on, or holds a line that is not an event.
  virtual bool read(EventPacket& packet, std::size_t max_events) = 0;

  /// Starts again from the first event. Counters and warnings start afresh.
  virtual void rewind() = 0;

  /// What was read and what was dropped so far.
  virtual const EventCounters& counters() const = 0;

  /// What was wrong with the file, one line each; complete once `read` has returned false.
  virtual std::vector<std::string> warnings() const = 0;
};

/// Opens Prophesee RAW files (EVT2, EVT3), text files and YARP text logs. Throws EventFileError for
/// a file that is missing, empty, of another format, or does not say how large its sensor is when
/// `options` does not either.
std::unique_ptr<EventReader> open_event_file(const std::filesystem::path& path,
                                             const EventFileOptions& options = {});

}  // namespace puck
