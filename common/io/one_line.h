#pragma once

#include <string>

namespace puck {

/// A message for a terminal, with `?` for line ends and control characters: it may quote any file.
std::string one_line(std::string message);

}  // namespace puck
