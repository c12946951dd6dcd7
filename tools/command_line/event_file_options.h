#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/io/event_file_kind.h"
#include "common/io/event_reader.h"

namespace puck {

/// Options for what a recording's header may lack. `file` must outlive the parsing.
inline void add_event_file_options(CLI::App& app, EventFileOptions& file) {
  const std::vector<std::string> formats(kEventFormats.begin() + 1, kEventFormats.end());
  app.add_option("--from", file.from, "format of the recording, if its content does not tell it")
      ->check(CLI::IsMember(formats));
  auto* width = app.add_option("--width", file.sensor.width,
                               "of the sensor, px, if the recording does not name it");
  auto* height = app.add_option("--height", file.sensor.height,
                                "of the sensor, px, if the recording does not name it");
  width->needs(height);
  height->needs(width);
  app.add_option("--reorder-us", file.reorder_us, "put events in order that are so many µs late")
      ->check(CLI::Range(std::int64_t{0}, EventFileOptions::kMostReorderUs))
      ->capture_default_str();
  app.add_option("--columns", file.text_columns, "text: order of the columns")
      ->capture_default_str();
  app.add_option("--separator", file.text_separator,
                 "text: between the columns, if blanks belong to a column, such as ,")
      ->capture_default_str();
  app.add_option("--unit", file.text_unit, "text: unit of the times")
      ->check(CLI::IsMember({"auto", "s", "ms", "us", "ns"}))
      ->capture_default_str();
  app.add_option("--eye", file.yarp_eye, "YARP log with two cameras: the eye to read")
      ->check(CLI::IsMember({"auto", "left", "right"}))
      ->capture_default_str();
}

}  // namespace puck
