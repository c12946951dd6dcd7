#include "tools/compare/content_hash.h"

#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace puck {

ContentHash& ContentHash::add(std::string_view bytes) {
  for (const char byte : bytes) {
    hash_ ^= static_cast<unsigned char>(byte);
    hash_ *= 0x100000001b3;
  }
  return *this;
}

ContentHash& ContentHash::add_file(const std::filesystem::path& path) {
  std::ostringstream bytes;
  std::ifstream file(path, std::ios::binary);
  // For an empty file, operator<< would set the failure flag of `bytes`.
  if (file && file.peek() != std::ifstream::traits_type::eof()) bytes << file.rdbuf();
  if (!file.is_open()) throw std::runtime_error(path.string() + ": cannot be read");
  return add(bytes.view());
}

std::string ContentHash::text() const {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
  return digits;
}

}  // namespace puck
