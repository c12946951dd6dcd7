#include "common/io/toml_entries.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include <toml++/toml.h>

#include "common/io/config.h"

namespace puck {
namespace {

// The parser recurses: a key with thousands of nested parts would overflow its stack.
constexpr std::size_t kLongestLine = 4096;

void check_lines(std::string_view text, const std::string& name) {
  std::size_t number = 1;
  while (true) {
    const std::size_t end = text.find('\n');
    if (std::min(end, text.size()) > kLongestLine) {
      throw ConfigError(name + ":" + std::to_string(number) + ": is longer than " +
                        std::to_string(kLongestLine) + " bytes; expected shorter lines");
    }
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
    ++number;
  }
}

std::string one_line_of(const toml::node& node) {
  if (const auto* string = node.as_string()) return quoted_toml(string->get());
  std::ostringstream stream;
  node.visit([&stream](const auto& value) { stream << value; });
  std::string text = stream.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t kLongestQuote = 80;
  return text.size() > kLongestQuote ? text.substr(0, kLongestQuote) + "…" : text;
}

ConfigEntry entry_of(const toml::node& node) {
  ConfigEntry entry;
  entry.text = one_line_of(node);
  if (const auto* boolean = node.as_boolean()) {
    entry.value = boolean->get();
  } else if (const auto* integer = node.as_integer()) {
    entry.value = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    entry.value = number->get();
  } else if (const auto* text = node.as_string()) {
    entry.value = text->get();
  } else if (const auto* list = node.as_array()) {
    std::vector<double> numbers;
    for (const toml::node& element : *list) {
      if (!element.is_number()) return entry;
      numbers.push_back(element.value<double>().value_or(0));
    }
    entry.value = std::move(numbers);
  }
  return entry;
}

void collect(const toml::table& table, const std::string& prefix, const std::string& name,
             std::map<std::string, ConfigEntry, std::less<>>& entries) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    const toml::table* inner = node.as_table();
    if (inner && !inner->empty()) {
      collect(*inner, path + ".", name, entries);
      continue;
    }
    ConfigEntry entry = entry_of(node);
    entry.where = name + ":" + std::to_string(key.source().begin.line);
    entry.is_empty_table = inner != nullptr;
    entries[path] = std::move(entry);
  }
}

}  // namespace

std::map<std::string, ConfigEntry, std::less<>> parse_toml(std::string_view text,
                                                           const std::string& name) {
  check_lines(text, name);
  std::map<std::string, ConfigEntry, std::less<>> entries;
  try {
    collect(toml::parse(text), "", name, entries);
  } catch (const toml::parse_error& error) {
    throw ConfigError(name + ":" + std::to_string(error.source().begin.line) +
                      ": is not valid TOML: " + std::string(error.description()));
  }
  return entries;
}

ConfigEntry parse_toml_value(std::string_view text) {
  try {
    if (text.size() <= kLongestLine) {
      const toml::table table = toml::parse("value = " + std::string(text));
      if (table.size() == 1) return entry_of(*table.get("value"));
    }
  } catch (const toml::parse_error&) {
    // A bare word, not TOML.
  }
  ConfigEntry entry;
  entry.value = std::string(text);
  entry.text = quoted_toml(text);
  return entry;
}

std::string toml_number(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  std::string written(text.data(), result.ptr);
  // TOML distinguishes floats from integers by the point or exponent.
  if (written.find_first_of(".en") == std::string::npos) written += ".0";
  return written;
}

std::string quoted_toml(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\') {
      quoted += '\\';
      quoted += character;
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += "\\u00";
      quoted += kHex[byte >> 4];
      quoted += kHex[byte & 0xf];
    } else {
      quoted += character;
    }
  }
  return quoted + '"';
}

}  // namespace puck
