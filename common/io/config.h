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

/// An error in a configuration, in one line: the file and line or the assignment, the key, and what
/// was expected.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

/// Settings from a TOML file, and assignments that override it. Keys are dotted:
/// `tracker.half_width_px`. Every setting must be read: `reject_unknown` checks that.
class Config {
 public:
  /// No settings: all values keep their defaults.
  Config() = default;

  /// Throws ConfigError when the file is missing or not TOML.
  static Config from_file(const std::filesystem::path& path);
  /// `name` stands for the file in messages.
  static Config from_text(std::string_view text, std::string name);

  /// Applies `tracker.half_width_px=5`, as given to `--set`. The value is TOML; text that is not
  /// TOML counts as a string. The last assignment of a key wins.
  void override_with(std::string_view assignment);

  /// Whether the key was set, by file or assignment.
  bool has(std::string_view key) const;

  // Each function takes `value` as the default, replaces it if the key was set, and marks the key
  // as known. Throws ConfigError for a wrong type or a value out of range (ends included).

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
  /// One of the given words.
  void read_choice(std::string_view key, std::string& value,
                   std::span<const std::string_view> choices);

  /// Throws ConfigError `where: key message`, for rules other than a range.
  [[noreturn]] void fail(std::string_view key, std::string_view message) const;
  /// Throws ConfigError `where: key must be EXPECTED, got VALUE` of a key that was set.
  [[noreturn]] void fail_expected(std::string_view key, const std::string& expected) const;

  /// Throws ConfigError when a setting was not read; names its place and the nearest known key.
  void reject_unknown() const;
  /// The same for the keys of one table: the rest of the file has other readers.
  void reject_unknown_in(std::string_view table) const;

  /// All values read so far, in the order of reading, as TOML: one `key = value` a line.
  std::string effective() const;

 private:
  const ConfigEntry* find(std::string_view key) const;
  void record_known(std::string_view key, std::string effective_value);
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
