#pragma once

#include <string>

#include <spdlog/logger.h>

namespace puck {

/// Gives the calling thread, but none that it creates, real-time priority, and locks the process's
/// memory. Returns the reason if that is not permitted; empty on success.
std::string run_in_real_time(int priority);

/// The same, with the result in the log. Priority 0: no change.
void run_in_real_time_and_tell(int priority, spdlog::logger& log);

}  // namespace puck
