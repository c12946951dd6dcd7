#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/io/event_reader.h"

namespace puck {

/// The events of a log of LCM, of all the camera's runs in it, one after the other. What is damaged
/// is passed over; what is missing counts as dropped. `prefix`: that of the channels. Throws
/// LogFileError, also for a log without events.
std::unique_ptr<EventReader> open_log(const std::filesystem::path& path, const std::string& prefix);

}  // namespace puck
