#include "common/io/config.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>

#include "common/io/toml_entries.h"

namespace puck {
namespace {

constexpr std::string_view kBareCharacters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";

std::string toml_list(std::span<const double> values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += ", ";
    text += toml_number(values[i]);
  }
  return text + "]";
}

// `an integer from 1 to 8`; an end that is the type's own limit is left out.
template <typename Number>
std::string range_text(std::string kind, Number lowest, Number highest) {
  const auto number = [](Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
      std::string text = toml_number(value);
      return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
    } else {
      return std::to_string(value);
    }
  };
  const bool has_lowest = lowest > std::numeric_limits<Number>::lowest();
  const bool has_highest = highest < std::numeric_limits<Number>::max();
  if (has_lowest && has_highest) {
    return kind + " from " + number(lowest) + " to " + number(highest);
  }
  if (has_lowest) return kind + " of at least " + number(lowest);
  if (has_highest) return kind + " of at most " + number(highest);
  return kind;
}

// Levenshtein distance.
std::size_t distance_between(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

bool is_dotted_key(std::string_view key) {
  bool is_start = true;
  for (const char character : key) {
    if (character == '.') {
      if (is_start) return false;
      is_start = true;
    } else if (kBareCharacters.find(character) == std::string_view::npos) {
      return false;
    } else {
      is_start = false;
    }
  }
  return !is_start;
}

}  // namespace

Config Config::from_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw ConfigError(path.string() + ": is a folder; expected a TOML file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ConfigError(path.string() + ": cannot be opened: " + std::strerror(errno));
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw ConfigError(path.string() + ": cannot be read to its end");
  return from_text(text, path.string());
}

Config Config::from_text(std::string_view text, std::string name) {
  Config config;
  config.name_ = std::move(name);
  config.entries_ = parse_toml(text, config.name_);
  return config;
}

void Config::override_with(std::string_view assignment) {
  const std::string where = "--set " + std::string(assignment);
  const std::size_t equals = assignment.find('=');
  const std::string_view key = assignment.substr(0, equals);
  if (equals == std::string_view::npos || !is_dotted_key(key) || equals + 1 == assignment.size()) {
    throw ConfigError(where + ": expected KEY=VALUE, as in tracker.half_width_px=5");
  }
  ConfigEntry entry = parse_toml_value(assignment.substr(equals + 1));
  entry.where = where;
  entries_[std::string(key)] = std::move(entry);
}

bool Config::has(std::string_view key) const { return entries_.find(key) != entries_.end(); }

void Config::read(std::string_view key, bool& value) {
  if (const ConfigEntry* entry = find(key)) {
    const bool* set = std::get_if<bool>(&entry->value);
    if (!set) fail_expected(key, *entry, "true or false");
    value = *set;
  }
  record_known(key, value ? "true" : "false");
}

void Config::read(std::string_view key, int& value, int lowest, int highest) {
  std::int64_t wide = value;
  const ConfigEntry* entry = find(key);
  if (entry) {
    const auto* set = std::get_if<std::int64_t>(&entry->value);
    if (!set || *set < lowest || *set > highest) {
      fail_expected(key, *entry, range_text("an integer", lowest, highest));
    }
    wide = *set;
  }
  value = static_cast<int>(wide);
  record_known(key, std::to_string(value));
}

void Config::read(std::string_view key, std::int64_t& value, std::int64_t lowest,
                  std::int64_t highest) {
  if (const ConfigEntry* entry = find(key)) {
    const auto* set = std::get_if<std::int64_t>(&entry->value);
    if (!set || *set < lowest || *set > highest) {
      fail_expected(key, *entry, range_text("an integer", lowest, highest));
    }
    value = *set;
  }
  record_known(key, std::to_string(value));
}

void Config::read(std::string_view key, double& value, double lowest, double highest) {
  if (const ConfigEntry* entry = find(key)) {
    double set = std::numeric_limits<double>::quiet_NaN();
    if (const auto* number = std::get_if<double>(&entry->value)) set = *number;
    if (const auto* whole = std::get_if<std::int64_t>(&entry->value)) {
      set = static_cast<double>(*whole);
    }
    if (!std::isfinite(set) || set < lowest || set > highest) {
      fail_expected(key, *entry, range_text("a number", lowest, highest));
    }
    value = set;
  }
  record_known(key, toml_number(value));
}

void Config::read(std::string_view key, std::string& value) {
  if (const ConfigEntry* entry = find(key)) {
    const auto* set = std::get_if<std::string>(&entry->value);
    if (!set) fail_expected(key, *entry, "a text in quotes");
    value = *set;
  }
  record_known(key, quoted_toml(value));
}

void Config::read_choice(std::string_view key, std::string& value,
                         std::span<const std::string_view> choices) {
  if (const ConfigEntry* entry = find(key)) {
    const auto* set = std::get_if<std::string>(&entry->value);
    if (!set || std::find(choices.begin(), choices.end(), *set) == choices.end()) {
      std::string expected;
      for (std::size_t i = 0; i < choices.size(); ++i) {
        if (i > 0) expected += i + 1 == choices.size() ? " or " : ", ";
        expected += '"' + std::string(choices[i]) + '"';
      }
      fail_expected(key, *entry, expected);
    }
    value = *set;
  }
  record_known(key, quoted_toml(value));
}

void Config::read(std::string_view key, std::vector<double>& value, double lowest, double highest) {
  if (const ConfigEntry* entry = find(key)) {
    const auto* set = std::get_if<std::vector<double>>(&entry->value);
    const auto is_allowed = [&](double number) {
      return std::isfinite(number) && number >= lowest && number <= highest;
    };
    if (!set || !std::all_of(set->begin(), set->end(), is_allowed)) {
      fail_expected(key, *entry, range_text("a list of numbers", lowest, highest));
    }
    value = *set;
  }
  record_known(key, toml_list(value));
}

void Config::read_numbers(std::string_view key, std::span<double> value, double lowest,
                          double highest) {
  std::vector<double> numbers(value.begin(), value.end());
  const ConfigEntry* entry = find(key);
  if (entry) {
    const auto* set = std::get_if<std::vector<double>>(&entry->value);
    if (!set || set->size() != value.size()) {
      fail_expected(
          key, *entry,
          range_text("a list of " + std::to_string(value.size()) + " numbers", lowest, highest));
    }
  }
  read(key, numbers, lowest, highest);
  std::copy(numbers.begin(), numbers.end(), value.begin());
}

void Config::fail(std::string_view key, std::string_view message) const {
  const ConfigEntry* entry = find(key);
  throw ConfigError((entry ? entry->where : name_) + ": " + std::string(key) + " " +
                    std::string(message));
}

void Config::fail_expected(std::string_view key, const std::string& expected) const {
  const ConfigEntry* entry = find(key);
  if (!entry) fail(key, "must be " + expected);
  fail_expected(key, *entry, expected);
}

void Config::reject_unknown() const {
  for (const auto& [key, entry] : entries_) reject_unless_read(key, entry);
}

void Config::reject_unknown_in(std::string_view table) const {
  const std::string below = std::string(table) + '.';
  for (const auto& [key, entry] : entries_) {
    if (key.starts_with(below)) reject_unless_read(key, entry);
  }
}

void Config::reject_unless_read(const std::string& key, const ConfigEntry& entry) const {
  if (effective_.contains(key)) return;
  // An empty table is harmless if it may have keys.
  const std::string prefix = key + ".";
  const auto below = effective_.lower_bound(prefix);
  if (entry.is_empty_table && below != effective_.end() && below->first.starts_with(prefix)) return;
  std::string message = entry.where + ": unknown key " + key;
  const auto nearest = std::min_element(
      known_keys_.begin(), known_keys_.end(), [&key](const auto& left, const auto& right) {
        return distance_between(key, left) < distance_between(key, right);
      });
  if (nearest != known_keys_.end()) message += "; the nearest known key is " + *nearest;
  throw ConfigError(message);
}

std::string Config::effective() const {
  std::string text;
  for (const std::string& key : known_keys_) text += key + " = " + effective_.at(key) + "\n";
  return text;
}

const ConfigEntry* Config::find(std::string_view key) const {
  const auto entry = entries_.find(key);
  return entry == entries_.end() ? nullptr : &entry->second;
}

void Config::record_known(std::string_view key, std::string effective_value) {
  const auto [place, is_new] =
      effective_.insert_or_assign(std::string(key), std::move(effective_value));
  if (is_new) known_keys_.push_back(place->first);
}

void Config::fail_expected(std::string_view key, const ConfigEntry& entry,
                           const std::string& expected) const {
  throw ConfigError(entry.where + ": " + std::string(key) + " must be " + expected + ", got " +
                    entry.text);
}

}  // namespace puck
