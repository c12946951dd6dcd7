#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace puck {

/// The lines of `text`, each after a `#`.
std::string toml_comment(std::string_view text);

/// Throws ConfigError when the file cannot be read.
std::string read_calibration_text(const std::filesystem::path& path);

/// The text of a TOML file without one of its tables and the comment directly above it.
std::string without_table(std::string_view text, std::string_view table);

/// Throws ConfigError when the file cannot be written.
void write_calibration_text(const std::filesystem::path& path, std::string_view text);

}  // namespace puck
