#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "common/messaging/channels.h"
#include "common/messaging/log_file.h"

namespace puck {

/// A message of a log with the result of its check.
struct LoggedMessage {
  const LogRecord& record;
  std::optional<Channel> channel;        ///< Empty: not a PUCK channel, not checked.
  std::optional<std::string> rejection;  ///< Why receivers reject it; empty: valid.
};

/// Counts of messages and defects in a log.
struct LogTally {
  std::int64_t messages = 0;
  std::int64_t foreign = 0;    ///< Of them: on other channels.
  std::int64_t malformed = 0;  ///< Of them: malformed on PUCK channels.
  std::int64_t damaged_places = 0;
  std::int64_t damaged_bytes = 0;

  bool is_fine() const { return malformed == 0 && damaged_places == 0; }
};

/// Reads a log once, in constant memory, and calls for every message and every damaged place in
/// their order. Throws LogFileError if the log cannot be read.
LogTally read_log(const std::filesystem::path& path,
                  const std::function<void(const LoggedMessage&)>& on_message,
                  const std::function<void(const LogDamage&)>& on_damage);

/// Replaces unprintable characters by question marks.
std::string for_terminal(std::string_view text);

/// `3 places, 120 bytes, are damaged; …` or `the log is valid`.
std::string in_words(const LogTally& tally);

}  // namespace puck
