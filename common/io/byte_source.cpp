#include "common/io/byte_source.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "common/io/event_reader.h"
#include "common/io/file_bytes.h"
#include "common/io/gzip_bytes.h"
#include "common/io/peeked_bytes.h"
#include "common/io/zstd_bytes.h"

namespace puck {
namespace {

struct Archive {
  std::string_view start;
  const char* name = nullptr;
  const char* remedy = nullptr;
};

constexpr std::array<Archive, 6> kArchives{{
    {std::string_view("\xfd\x37zXZ\0", 6), "xz", "unpack it first (xz -d)"},
    {"BZh", "bzip2", "unpack it first (bzip2 -d)"},
    {"PK\x03\x04", "zip", "unpack it first (unzip)"},
    {"7z\xbc\xaf\x27\x1c", "7-Zip", "unpack it first (7z x)"},
    {"\x04\x22\x4d\x18", "LZ4", "unpack it first (lz4 -d)"},
    {"Rar!\x1a\x07", "RAR", "unpack it first (unrar)"},
}};

constexpr std::size_t kLongestStart = 6;

}  // namespace

std::unique_ptr<ByteSource> open_bytes(const std::string& path, const Interruption* interruption) {
  std::error_code error;
  if (path != "-" && std::filesystem::is_directory(path, error)) {
    throw EventFileError(path + ": is a folder; expected an event file");
  }
  auto bytes = std::make_unique<PeekedBytes>(open_file_bytes(path, interruption), kLongestStart);
  const std::string_view start = bytes->head();
  if (start.starts_with("\x1f\x8b")) return open_gzip_bytes(std::move(bytes));
  if (start.starts_with("\x28\xb5\x2f\xfd")) return open_zstd_bytes(std::move(bytes));
  for (const Archive& archive : kArchives) {
    if (start.starts_with(archive.start)) {
      throw EventFileError(bytes->name() + ": is compressed as " + archive.name +
                           "; expected no compression, gzip or zstd: " + archive.remedy);
    }
  }
  return bytes;
}

}  // namespace puck
