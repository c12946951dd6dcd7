#pragma once

#include <filesystem>
#include <string>

namespace puck {

struct MotionCommand {
  std::filesystem::path track;
  std::filesystem::path table;
  std::filesystem::path output;
};

/// Fits the puck's damping and bounces to a recorded game, writes them into the table's file in
/// place of earlier ones, and prints the residuals. `typed`: the command line, for a comment in the
/// file. Throws as read_table_file, read_recorded_track and fit_motion do.
void calibrate_motion(const MotionCommand& command, const std::string& typed);

}  // namespace puck
