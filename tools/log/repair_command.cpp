#include "tools/log/repair_command.h"

#include <cinttypes>
#include <cstdio>

namespace puck {

LogTally repair_log(const std::filesystem::path& input, const std::filesystem::path& output) {
  LogReader{input};  // Fails before an output is created if the file is not a log.
  LogWriter writer(output);
  const LogTally tally = read_log(
      input,
      [&](const LoggedMessage& message) {
        const LogRecord& record = message.record;
        if (!message.rejection) return writer.write(record.channel, record.utime, record.bytes);
        std::printf("byte %" PRId64 ": left out a message on %s: %s\n", record.offset,
                    for_terminal(record.channel).c_str(), message.rejection->c_str());
      },
      [](const LogDamage& damage) {
        std::printf("byte %" PRId64 ": left out %" PRId64 " bytes: %s\n", damage.offset,
                    damage.bytes, damage.why.c_str());
      });
  writer.flush();
  std::printf("%" PRId64 " messages copied to %s: %s\n", writer.messages(),
              for_terminal(output.string()).c_str(),
              tally.is_fine() ? "there was nothing to repair" : in_words(tally).c_str());
  return tally;
}

}  // namespace puck
