#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/event_reader.h"
#include "common/io/event_sink.h"

namespace puck {

/// Text files with one event a line. Lines that begin with `#` or `%` are comments, except
/// `%geometry:WIDTH,HEIGHT`, which states the sensor's size. A first line of column names, such as
/// `x,y,p,t`, overrides the order in the options. Times are seconds or µs, rounded to whole µs;
/// polarity is 1 for brighter and 0 or −1 for darker.
class TextEventReader final : public EventReader {
 public:
  /// Reads up to the first event. Throws EventFileError.
  TextEventReader(const std::filesystem::path& path, const EventFileOptions& options);

  SensorSize sensor_size() const override { return sensor_; }
  bool read(EventPacket& packet, std::size_t max_events) override;
  void rewind() override;
  const EventCounters& counters() const override { return sink_.counters(); }
  std::vector<std::string> warnings() const override;

 private:
  // Index of each value in a line.
  struct Columns {
    std::size_t time = 0;
    std::size_t x = 1;
    std::size_t y = 2;
    std::size_t polarity = 3;
  };
  static constexpr std::size_t kColumnCount = 4;

  static Columns parse_columns(std::string_view text);
  void read_preamble();
  bool next_event_line();
  void take_geometry();
  bool take_column_names();
  void choose_unit();
  bool split(std::array<std::string_view, kColumnCount>& fields) const;
  void take_line();
  [[noreturn]] void fail(const std::string& expected) const;

  std::string name_;
  EventFileOptions options_;
  Columns columns_;
  std::ifstream file_;
  std::string line_;
  std::int64_t line_number_ = 0;
  bool has_line_ = false;       // line_ holds an event that was not returned yet.
  bool line_was_ended_ = true;  // The line had a line end; not cut by the end of the file.
  double us_per_unit_ = 1;
  SensorSize said_sensor_;
  SensorSize sensor_;
  EventSink sink_;
};

}  // namespace puck
