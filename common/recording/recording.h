#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/event_reader.h"
#include "common/io/event_writer.h"

namespace puck {

/// The name of the format of LCM logs, beside those of io.
inline constexpr std::string_view kLcmLogFormat = "lcm";

/// Opens any recording: an event file, or an LCM log with all its sessions. `path` "-" is standard
/// input. A log from a pipe or within gzip or zstd is copied to a temporary file first. `prefix`:
/// that of a log's channels. Throws EventFileError.
std::unique_ptr<EventReader> open_recording(const std::filesystem::path& path,
                                            const EventFileOptions& options,
                                            const std::string& prefix);

/// As format_of_ending, and "lcm" for .lcm.
std::string_view format_of_recording(const std::filesystem::path& path);

/// The names of all formats that can be written.
std::vector<std::string> written_format_names();

/// The usual ending of files of a format, ".raw" for "evt2". `format`: one of
/// written_format_names().
std::string_view usual_ending_of(std::string_view format);

/// As make_event_writer, and "lcm" for LCM logs.
std::unique_ptr<EventWriter> make_recording_writer(const std::filesystem::path& path,
                                                   std::string_view format, SensorSize sensor,
                                                   const std::string& prefix);

}  // namespace puck
