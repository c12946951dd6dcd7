#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/motion/joint_table.h"

namespace puck {

/// Reads [line]: joints, from_m, to_m; and for each joint, in the control board's order, [joint_0],
/// [joint_1], …: name, lowest_deg, highest_deg, max_velocity_deg_s, max_acceleration_deg_s2,
/// max_jerk_deg_s3, control_deg. All but the names are required. Throws ConfigError.
JointTableParams read_joint_table_file(const std::filesystem::path& path);

/// The text that `read_joint_table_file` reads. `provenance`: origin of the table; becomes a
/// comment.
std::string joint_table_text(const JointTableParams& params, std::string_view provenance);

/// Writes joint_table_text to a file. Throws ConfigError when it cannot be written.
void write_joint_table_file(const std::filesystem::path& path, const JointTableParams& params,
                            std::string_view provenance);

}  // namespace puck
