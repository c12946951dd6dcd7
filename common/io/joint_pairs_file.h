#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "common/motion/joint_pair.h"

namespace puck {

/// Reads `y_m,joint_0_deg,joint_1_deg,…`: as many joints as the header has. Throws CsvError.
std::vector<JointPair> read_joint_pairs(const std::filesystem::path& path);

/// Which of the robot's parts to take from a table of the authors.
enum class RobotPart { kTorso, kArm, kHead };

/// Reads the table.tsv that the authors' sampling of the arm wrote: no header, columns separated by
/// tabs or blanks: the hand's y in m, three joints of the torso, seven of the arm, six of the head,
/// in deg. The torso comes in its reverse order and is turned round. Throws CsvError.
std::vector<JointPair> read_authors_joint_table(const std::filesystem::path& path, RobotPart part);

}  // namespace puck
