#pragma once

#include <cstddef>
#include <filesystem>

#include "common/control/joint_angles.h"
#include "common/io/joint_table_file.h"
#include "tests/support/test_board.h"

namespace puck {

/// Moves the board's first joints so that an arm with this joint table has its mallet in the middle
/// of the line. Throws ConfigError.
inline void move_to_the_middle(TestBoard& board, const std::filesystem::path& joint_table) {
  const JointAngles middle = joints_at(JointTable(read_joint_table_file(joint_table)), 0);
  for (std::size_t joint = 0; joint < middle.size(); ++joint) {
    board.move_joint(joint, middle[joint]);
  }
}

}  // namespace puck
