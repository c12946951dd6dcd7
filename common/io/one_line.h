#pragma once

#include <string>

namespace puck {

/// A message for a person, with `?` for what would break its line or steer a terminal: it may quote
/// any file.
std::string one_line(std::string message);

}  // namespace puck
