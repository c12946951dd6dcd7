#include "common/io/calibration_text.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "common/io/config.h"

namespace puck {

std::string toml_comment(std::string_view text) {
  std::string comment;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    comment += "# " + std::string(text.substr(0, end)) + "\n";
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return comment;
}

void write_calibration_text(const std::filesystem::path& path, std::string_view text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw ConfigError(path.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace puck
