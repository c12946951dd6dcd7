// Any file at all as a log.
#include "common/messaging/log_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  puck::MemoryFile file;
  const auto& path = file.write(data, size);
  try {
    puck::LogReader reader(path);
    puck::LogRecord record;
    std::int64_t bytes = 0;
    while (reader.next(record)) {
      bytes += puck::LogWriter::record_bytes(record.channel, record.bytes.size());
    }
    // Nothing is silently left out.
    puck::require(bytes + reader.bytes_skipped() == static_cast<std::int64_t>(size),
                  "every byte is read or counted as skipped");
    puck::require(reader.damage().has_value() == (reader.bytes_skipped() > 0),
                  "what is skipped is told of");
    if (reader.damage()) puck::require_one_line(*reader.damage());
  } catch (const puck::LogFileError& error) {
    puck::require_one_line(error.what());
  }
  return 0;
}
