#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/command_line/bus_options.h"
#include "tools/command_line/event_filter_options.h"
#include "tools/view/live/live_source.h"
#include "tools/view/output/picture_files.h"
#include "tools/view/recording/opened_recording.h"

namespace puck {

/// Options of the command line.
struct ViewOptions {
  RecordingOptions recording;  ///< Its path is empty for the live bus.
  EventFilterOptions filter;
  std::string detection_region;
  std::vector<std::string> trackers;  ///< Of the sides; empty: chosen by the recording.
  PictureFiles files;
  double speed = 1;
  std::string listen = "127.0.0.1:8080";
  BusOptions bus;      ///< Without the prefix, which is the recording's.
  PictureWishes look;  ///< What all pictures have in common.
  std::vector<std::string> shown{"events"};
  std::vector<std::string> hidden;  ///< Names of layers.
  bool is_light = false;
  std::string size = "1280x720";

  bool has_pictures() const { return !files.png_folder.empty() || !files.video.empty(); }
};

/// `options` must outlive the parsing.
void add_options(CLI::App& app, ViewOptions& options);

/// The options after the parsing, with their files read. Throws with a one-line message.
RecordingOptions recording_options(const ViewOptions& options);

/// For the live bus. Throws with a one-line message.
LiveOptions live_options(const ViewOptions& options);

/// The trackers of the two sides: those named, else a log's own estimates, else preset default if
/// there is a size model. Throws std::invalid_argument for more than two.
std::array<std::string, kViewSides> trackers_of(const ViewOptions& options,
                                                const OpenedRecording& recording);

/// What --png or --video writes, with a picture of each kind for each tracker.
PictureFiles picture_files(const ViewOptions& options,
                           const std::array<std::string, kViewSides>& trackers);

}  // namespace puck
