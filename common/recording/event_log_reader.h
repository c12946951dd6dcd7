#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/io/event_reader.h"
#include "common/messaging/event_log.h"

namespace puck {

/// The events of PUCK_EVENTS in an LCM log, read as from a file: in the order of publication, one
/// packet at a time. Malformed and late packets are left out; lost events, and those that the
/// source dropped, count as missing. `prefix`: that of the channels. Throws LogFileError, also for
/// a log without events.
std::unique_ptr<EventReader> open_event_log(const std::filesystem::path& path,
                                            const std::string& prefix, EventLog::Sessions sessions);

}  // namespace puck
