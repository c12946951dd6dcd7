#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/calibration/hot_pixels.h"
#include "common/io/event_reader.h"
#include "tools/info/rate_history.h"

namespace puck {

/// A time without events.
struct EventGap {
  Timestamp from;
  std::int64_t length_us = 0;
};

/// What is in a recording.
struct Survey {
  std::string name;
  std::optional<std::int64_t> bytes;  ///< Of the file; nothing for a stream.
  RecordingFacts facts;
  SensorSize sensor;
  EventCounters counters;
  Timestamp first;
  Timestamp last;
  std::int64_t brighter = 0;
  std::int64_t time_step_us = 0;  ///< Largest number that divides all differences of times.
  RateHistory rates;
  std::vector<EventGap> gaps;                ///< The longest of 10 ms and more, longest first.
  std::int64_t gap_count = 0;                ///< Of 10 ms and more.
  std::optional<HotPixelReport> hot_pixels;  ///< Nothing for less than 1 s.
  std::vector<std::uint32_t> pixel_counts;   ///< Row by row.
  std::vector<std::string> warnings;         ///< Of the reader.
  std::vector<std::string> problems;         ///< What is wrong with the file.

  double seconds() const { return static_cast<double>(last - first) * 1e-6; }
};

/// Reads a recording to its end. An error on the way becomes a problem, with what was read before
/// it.
Survey survey_recording(EventReader& events, const std::string& name);

}  // namespace puck
