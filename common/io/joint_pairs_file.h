#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "common/motion/joint_pair.h"

namespace puck {

/// Reads `y_m,joint_0_deg,joint_1_deg,…`: as many joints as the header has. Throws CsvError.
std::vector<JointPair> read_joint_pairs(const std::filesystem::path& path);

/// The part of the robot to read from the authors' table.
enum class RobotPart { kTorso, kArm, kHead };

/// Reads the table.tsv of the authors' sampling of the arm. No header; columns separated by tabs or
/// blanks: the hand's y in m, three joints of the torso, seven of the arm, six of the head, in deg.
/// The torso's joints are in reverse order in the file, and are returned in the robot's. Throws
/// CsvError.
std::vector<JointPair> read_authors_joint_table(const std::filesystem::path& path, RobotPart part);

}  // namespace puck
