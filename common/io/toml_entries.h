#pragma once

#include <map>
#include <string>
#include <string_view>

#include "common/io/config_entry.h"

namespace puck {

/// All settings of a TOML text by their dotted keys. `name` stands for the text in messages. Throws
/// ConfigError when the text is not TOML, or a line is longer than 4096 bytes.
std::map<std::string, ConfigEntry, std::less<>> parse_toml(std::string_view text,
                                                           const std::string& name);

/// A single TOML value; a text that is not one, or is too long, counts as a string.
ConfigEntry parse_toml_value(std::string_view text);

/// The number as TOML; reading it gives the same bits.
std::string toml_number(double value);

/// The text as a TOML string.
std::string quoted_toml(std::string_view text);

}  // namespace puck
