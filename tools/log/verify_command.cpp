#include "tools/log/verify_command.h"

#include <cinttypes>
#include <cstdio>

namespace puck {

LogTally verify_log(const std::filesystem::path& path) {
  const LogTally tally = read_log(
      path,
      [](const LoggedMessage& message) {
        if (!message.rejection) return;
        std::printf("byte %" PRId64 ": %s: %s\n", message.record.offset,
                    for_terminal(message.record.channel).c_str(), message.rejection->c_str());
      },
      [](const LogDamage& damage) {
        std::printf("byte %" PRId64 ": %" PRId64 " bytes are no message: %s\n", damage.offset,
                    damage.bytes, damage.why.c_str());
      });
  std::printf("%" PRId64 " messages", tally.messages);
  if (tally.foreign > 0) {
    std::printf(", of them %" PRId64 " on other channels and unchecked", tally.foreign);
  }
  std::printf(": %s\n", in_words(tally).c_str());
  return tally;
}

}  // namespace puck
