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

/// A message of a log, looked at.
struct LoggedMessage {
  const LogRecord& record;
  std::optional<Channel> channel;        ///< Nothing: not one of ours, so it cannot be checked.
  std::optional<std::string> rejection;  ///< Why no receiver takes it.
};

/// What was found in a log.
struct LogTally {
  std::int64_t messages = 0;
  std::int64_t foreign = 0;    ///< Of them: on channels that are not ours.
  std::int64_t malformed = 0;  ///< Of them: on channels of ours, but not valid.
  std::int64_t damaged_places = 0;
  std::int64_t damaged_bytes = 0;

  bool is_fine() const { return malformed == 0 && damaged_places == 0; }
};

/// Reads a log once, in constant memory, and calls for every message and every damaged place as
/// they come. Throws LogFileError when it cannot be read.
LogTally read_log(const std::filesystem::path& path,
                  const std::function<void(const LoggedMessage&)>& on_message,
                  const std::function<void(const LogDamage&)>& on_damage);

/// For a terminal: whatever is not printable becomes a question mark.
std::string for_terminal(std::string_view text);

/// `3 places, 120 bytes, are damaged; …` or `the log is valid`.
std::string in_words(const LogTally& tally);

}  // namespace puck
