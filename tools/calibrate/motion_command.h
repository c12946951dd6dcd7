#pragma once

#include <filesystem>
#include <string>

namespace puck {

struct MotionCommand {
  std::filesystem::path track;
  std::filesystem::path table;
  std::filesystem::path output;
};

/// Fits how the puck glides and bounces on a table to what was recorded of a game, writes the
/// table's file with it, in place of what it may have had, and prints how good it is. `typed`: the
/// command, for a comment. Throws as read_table_file, read_recorded_track and fit_motion do.
void calibrate_motion(const MotionCommand& command, const std::string& typed);

}  // namespace puck
