#include "common/io/event_file_kind.h"

#include <algorithm>
#include <array>
#include <span>

#include "common/io/aedat4_header.h"
#include "common/io/event_reader.h"
#include "common/io/hdf5_reader.h"
#include "common/io/raw_header.h"
#include "common/io/yarp_packet.h"

namespace puck {
namespace {

constexpr const char* kExpected =
    "expected a Prophesee RAW file (EVT2 or EVT3), AEDAT4, HDF5, a text file or a YARP log";

struct Signature {
  std::string_view start;
  const char* kind = nullptr;
};

constexpr std::array<Signature, 11> kForeign{{
    {"#!AER-DAT", "an AEDAT file"},
    {"Event Stream", "an Event Stream (.es) file"},
    {"% Data file containing", "a Prophesee DAT file"},
    {"\x89PNG", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
    {"#ROSBAG", "a ROS bag"},
    {"SQLite format 3", "an SQLite file, as ROS 2 bags are"},
    {"\xed\xa1\xda\x01", "an LCM log"},
    {"PK\x03\x04", "a zip archive"},
    {"\x1f\x8b", "a gzip archive"},
    {"\x28\xb5\x2f\xfd", "a zstd archive"},
}};

bool is_text(std::string_view head) {
  return std::all_of(head.begin(), head.end(), [](char character) {
    const auto byte = static_cast<unsigned char>(character);
    return byte >= 0x20 ? byte != 0x7f : byte == '\t' || byte == '\r' || byte == '\n';
  });
}

bool has_raw_header(std::string_view head) {
  const auto header = parse_raw_header(std::as_bytes(std::span(head)), true);
  return !header->encoding().empty() || !header->value("system_ID").empty();
}

}  // namespace

EventFileKind event_file_kind(const std::filesystem::path& path, std::string_view head,
                              std::string_view from) {
  const std::string name = path.string();
  if (std::find(kEventFormats.begin(), kEventFormats.end(), from) == kEventFormats.end()) {
    throw EventFileError(name + ": the format to read must be evt2, evt3, text or yarp, got \"" +
                         std::string(from) + "\"");
  }
  if (head.empty()) throw EventFileError(name + ": is empty; " + kExpected);
  if (head.starts_with(kAedat4Signature)) return EventFileKind::kAedat4;
  if (head.starts_with(kHdf5Signature)) return EventFileKind::kHdf5;
  for (const Signature& signature : kForeign) {
    if (head.starts_with(signature.start)) {
      throw EventFileError(name + ": is " + signature.kind + "; " + kExpected);
    }
  }
  if (has_raw_header(head)) return EventFileKind::kRaw;
  // Only the caller can tell a log with a damaged beginning, and words without a header.
  if (is_yarp_log(head) || from == "yarp") return EventFileKind::kYarpLog;
  if (is_text(head)) return EventFileKind::kText;
  if (from == "evt2" || from == "evt3") return EventFileKind::kRaw;
  if (path.extension() == ".raw") {
    throw EventFileError(name +
                         ": has no Prophesee RAW header; expected one (\"% evt 3.0\"), or the "
                         "format as an option (evt2 or evt3)");
  }
  throw EventFileError(name + ": is of an unknown format; " + kExpected);
}

}  // namespace puck
