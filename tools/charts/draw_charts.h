#pragma once

#include <string>
#include <vector>

namespace puck {

/// Runs charts/SCRIPT.py beside the running program and waits for its end. Throws
/// std::runtime_error with the last line that the script printed if it fails, and with the remedy
/// if it cannot be started.
void draw_charts(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace puck
