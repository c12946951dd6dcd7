#include "tools/log/log_messages.h"

#include <algorithm>

#include "common/messaging/message_check.h"
#include "common/messaging/message_seal.h"

namespace puck {

LogTally read_log(const std::filesystem::path& path,
                  const std::function<void(const LoggedMessage&)>& on_message,
                  const std::function<void(const LogDamage&)>& on_damage) {
  LogReader reader(path);
  LogTally tally;
  reader.on_damage([&](const LogDamage& damage) {
    ++tally.damaged_places;
    tally.damaged_bytes += damage.bytes;
    on_damage(damage);
  });
  for (LogRecord record; reader.next(record);) {
    ++tally.messages;
    LoggedMessage message{record, find_channel_of_any_prefix(record.channel), std::nullopt};
    if (message.channel) {
      message.rejection = check_message(*message.channel, record.bytes);
    } else {
      ++tally.foreign;
    }
    if (message.rejection && looks_sealed(record.bytes)) {
      message.rejection = "is sealed; the logger had no key (lcm.key_file)";
    }
    if (message.rejection) ++tally.malformed;
    on_message(message);
  }
  return tally;
}

std::string for_terminal(std::string_view text) {
  std::string shown(text);
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  return shown;
}

std::string in_words(const LogTally& tally) {
  if (tally.is_fine()) return "the log is valid";
  std::string text;
  if (tally.damaged_places > 0) {
    text = std::to_string(tally.damaged_bytes) + " bytes at " +
           std::to_string(tally.damaged_places) + " places belong to no message";
  }
  if (tally.malformed > 0) {
    if (!text.empty()) text += ", ";
    text += std::to_string(tally.malformed) + " messages are malformed";
  }
  return text;
}

}  // namespace puck
