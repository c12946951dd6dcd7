#pragma once

#include <array>
#include <cstddef>
#include <filesystem>

#include "common/io/joint_table_file.h"
#include "common/motion/joint_table.h"
#include "tests/support/test_board.h"

namespace puck {

/// Puts the board's first joints where an arm with this joint table has its mallet in the middle of
/// the line. Throws ConfigError.
inline void move_to_the_middle(TestBoard& board, const std::filesystem::path& joint_table) {
  const JointTable table(read_joint_table_file(joint_table));
  std::array<double, JointTable::kMostJoints> deg{};
  table.at(0, deg);
  for (std::size_t joint = 0; joint < table.size(); ++joint) board.move_joint(joint, deg[joint]);
}

}  // namespace puck
