#include "common/io/event_reader.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "common/io/aedat4_reader.h"
#include "common/io/byte_source.h"
#include "common/io/event_file_kind.h"
#include "common/io/hdf5_reader.h"
#include "common/io/raw_file_reader.h"
#include "common/io/text_event_reader.h"
#include "common/io/yarp_log_reader.h"

namespace puck {

std::unique_ptr<EventReader> open_event_file(const std::filesystem::path& path,
                                             const EventFileOptions& options) {
  const std::string name = path.string();
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw EventFileError(name + ": is a folder; expected an event file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw EventFileError(name + ": cannot be opened: " + std::strerror(errno));

  std::array<char, 4096> head{};
  file.read(head.data(), head.size());
  const std::string_view start(head.data(), static_cast<std::size_t>(file.gcount()));
  switch (event_file_kind(path, start, options.from)) {
    case EventFileKind::kRaw:
      return std::make_unique<RawFileReader>(path, options);
    case EventFileKind::kYarpLog:
      return std::make_unique<YarpLogReader>(path, options);
    case EventFileKind::kAedat4:
      return std::make_unique<Aedat4Reader>(open_bytes(name), options);
    case EventFileKind::kHdf5:
      return open_hdf5_reader(open_bytes(name), path, options);
    case EventFileKind::kText:
      break;
  }
  return std::make_unique<TextEventReader>(path, options);
}

}  // namespace puck
