#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/config_entry.h"
#include "common/io/one_line.h"

namespace puck {

/// A configuration cannot be used: one line with the file and line or the assignment, the key, and
/// what was expected.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

/// Settings from a TOML file and from assignments that override it. Keys are dotted:
/// `tracker.half_width_px`. Everything that is set must be read: `reject_unknown` sees to that.
class Config {
 public:
  /// No settings: everything keeps its default.
  Config() = default;

  /// Throws ConfigError: file missing or not TOML.
  static Config from_file(const std::filesystem::path& path);
  /// `name` stands for the file in messages.
  static Config from_text(std::string_view text, std::string name);

  /// `tracker.half_width_px=5`, as `--set` takes it. The value is TOML; where it is not, the bare
  /// text counts as a string. A later one wins.
  void override_with(std::string_view assignment);

  /// Whether the key was set, by file or assignment.
  bool has(std::string_view key) const;

  // Each of these takes `value` as the default, replaces it if the key was set, and marks the key
  // as known. They throw ConfigError for a wrong type or a value out of the range, ends included.

  void read(std::string_view key, bool& value);
  void read(std::string_view key, int& value, int lowest, int highest);
  void read(std::string_view key, std::int64_t& value, std::int64_t lowest, std::int64_t highest);
  void read(std::string_view key, double& value, double lowest, double highest);
  void read(std::string_view key, std::string& value);
  /// A list of numbers of any length.
  void read(std::string_view key, std::vector<double>& value, double lowest, double highest);
  /// A list of exactly N numbers: a region, a homography.
  template <std::size_t N>
  void read(std::string_view key, std::array<double, N>& value, double lowest, double highest) {
    read_numbers(key, value, lowest, highest);
  }
  /// One of a few words.
  void read_choice(std::string_view key, std::string& value,
                   std::span<const std::string_view> choices);

  /// Throws ConfigError `where: key message`, for a rule that a range cannot express.
  [[noreturn]] void fail(std::string_view key, std::string_view message) const;

  /// Throws ConfigError when something was set that nobody read, naming where, and the nearest key
  /// that exists.
  void reject_unknown() const;
  /// The same for keys of one table: the rest of the file is somebody else's.
  void reject_unknown_in(std::string_view table) const;

  /// Everything that was read, in that order, one `key = value` a line: valid TOML.
  std::string effective() const;

 private:
  const ConfigEntry* find(std::string_view key) const;
  void know(std::string_view key, std::string effective_value);
  void reject_unless_read(const std::string& key, const ConfigEntry& entry) const;
  void read_numbers(std::string_view key, std::span<double> value, double lowest, double highest);
  [[noreturn]] void fail_expected(std::string_view key, const ConfigEntry& entry,
                                  const std::string& expected) const;

  std::string name_ = "configuration";
  std::map<std::string, ConfigEntry, std::less<>> entries_;
  std::vector<std::string> known_keys_;
  std::map<std::string, std::string, std::less<>> effective_;
};

}  // namespace puck
