#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/io/event_reader.h"
#include "common/messaging/event_log.h"

namespace puck {

/// The events that a log of LCM holds on PUCK_EVENTS, as those of a file: in the order in which
/// they were published, one packet at a time. What is malformed or late is left out; what is
/// missing, or was dropped by the source, counts as missing. `prefix`: that of the channels.
/// Throws LogFileError, also for a log without events.
std::unique_ptr<EventReader> open_event_log(const std::filesystem::path& path,
                                            const std::string& prefix, EventLog::Sessions sessions);

}  // namespace puck
