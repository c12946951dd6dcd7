#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace puck {

inline std::string required_environment(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) {
    throw std::runtime_error("an environment variable that ctest sets is missing: " +
                             std::string(name));
  }
  return value;
}

/// Folder of the project's own files.
inline std::filesystem::path source_folder() { return required_environment("PUCK_SOURCE_DIR"); }

/// Path of a program of this build.
inline std::string program_path(const std::string& name) {
  return required_environment("PUCK_BIN_DIR") + "/" + name;
}

}  // namespace puck
