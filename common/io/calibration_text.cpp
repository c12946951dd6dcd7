#include "common/io/calibration_text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

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

std::string read_calibration_text(const std::filesystem::path& path) {
  errno = 0;
  std::ostringstream text;
  const std::ifstream file(path, std::ios::binary);
  if (file) text << file.rdbuf();
  if (!file || !text) {
    throw ConfigError(path.string() + ": cannot be read: " + std::strerror(errno));
  }
  return text.str();
}

std::string without_table(std::string_view text, std::string_view table) {
  std::string header(1, '[');
  header += table;
  header += ']';
  std::string kept;
  std::string comment;  // Comment above the next line, which it belongs to.
  bool is_inside = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const std::string_view line = text.substr(0, end + 1);
    text.remove_prefix(end + 1);
    if (line.starts_with('#')) {
      comment += line;
      continue;
    }
    if (line.starts_with('[')) is_inside = line.starts_with(header);
    if (!is_inside) kept += comment + std::string(line);
    comment.clear();
  }
  return is_inside ? kept : kept + comment;
}

void write_calibration_text(const std::filesystem::path& path, std::string_view text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw ConfigError(path.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace puck
