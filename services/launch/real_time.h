#pragma once

#include <string>

#include <spdlog/logger.h>

namespace puck {

/// Lets the calling thread, and none that it makes, run before all that is not real-time, and keeps
/// the process's memory from being paged out. Why not, when that is not permitted; empty: it does.
std::string run_in_real_time(int priority);

/// The same, and what became of it in the log. Priority 0: not asked for.
void run_in_real_time_and_tell(int priority, spdlog::logger& log);

}  // namespace puck
