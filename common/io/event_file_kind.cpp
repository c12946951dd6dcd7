#include "common/io/event_file_kind.h"

#include <algorithm>
#include <span>

#include "common/io/aedat4_header.h"
#include "common/io/event_reader.h"
#include "common/io/hdf5_reader.h"
#include "common/io/raw_header.h"
#include "common/io/yarp_packet.h"

namespace puck {
namespace {

// So many bytes without a line's end, or against `from`, are text.
constexpr std::size_t kTextBytes = 4096;

constexpr const char* kExpected =
    "expected Prophesee RAW (EVT2, EVT2.1, EVT3, EVT4) or DAT, HDF5, Event Stream, AEDAT 2.0 or 4, "
    "text or a YARP log";

struct Signature {
  std::string_view start;
  EventFileKind kind;
};

constexpr std::array<Signature, 4> kOwn{{
    {"#!AER-DAT2", EventFileKind::kAedat2},
    {"Event Stream", EventFileKind::kEventStream},
    {kAedat4Signature, EventFileKind::kAedat4},
    {kHdf5Signature, EventFileKind::kHdf5},
}};

struct ForeignSignature {
  std::string_view start;
  const char* kind = nullptr;
};

constexpr std::array<ForeignSignature, 14> kForeign{{
    {"#!AER-DAT1", "an AEDAT 1.0 file"},
    {"#!AER-DAT3", "an AEDAT 3 file"},
    {"#!AER-DAT", "an AEDAT file"},
    {"\x89PNG", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
    {"#ROSBAG", "a ROS bag"},
    {"SQLite format 3", "an SQLite file, as ROS 2 bags are"},
    {"\x89MCAP0", "an MCAP file, as ROS 2 bags are"},
    {"\xed\xa1\xda\x01", "an LCM log"},
    {"\x93NUMPY", "a NumPy array"},
    {"MATLAB 5.0", "a MATLAB file"},
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

bool is_raw(const RawHeader& header) {
  return !header.encoding().empty() || !header.value("system_ID").empty();
}

bool is_dat(const RawHeader& header, std::string_view head) {
  if (header.fields.empty()) return false;
  return head.starts_with("% Data file containing") || !header.value("Version").empty() ||
         (!header.value("Width").empty() && !header.value("Height").empty());
}

bool is_raw_format(std::string_view from) { return from.starts_with("evt"); }

}  // namespace

const char* name_of(EventFileKind kind) {
  switch (kind) {
    case EventFileKind::kRaw:
      return "a Prophesee RAW file";
    case EventFileKind::kDat:
      return "a Prophesee DAT file";
    case EventFileKind::kEventStream:
      return "an Event Stream file";
    case EventFileKind::kAedat2:
      return "an AEDAT 2.0 file";
    case EventFileKind::kAedat4:
      return "an AEDAT4 file";
    case EventFileKind::kHdf5:
      return "an HDF5 file";
    case EventFileKind::kText:
      return "a text file";
    case EventFileKind::kYarpLog:
      return "a YARP log";
  }
  return "a file";
}

std::optional<EventFileKind> event_file_kind(const std::string& name, std::string_view head,
                                             bool is_all, std::string_view from) {
  if (std::find(kEventFormats.begin(), kEventFormats.end(), from) == kEventFormats.end()) {
    std::string known;
    for (const std::string_view format : kEventFormats) {
      if (!format.empty()) known += (known.empty() ? "" : ", ") + std::string(format);
    }
    throw EventFileError(name + ": the format to read must be one of " + known + ", got \"" +
                         std::string(from) + "\"");
  }
  if (head.empty()) {
    if (!is_all) return std::nullopt;
    throw EventFileError(name + ": is empty; " + kExpected);
  }
  const auto may_become = [&](std::string_view start) {
    return !is_all && head.size() < start.size() && start.starts_with(head);
  };
  for (const Signature& signature : kOwn) {
    if (head.starts_with(signature.start)) return signature.kind;
    if (may_become(signature.start)) return std::nullopt;
  }
  for (const ForeignSignature& signature : kForeign) {
    if (head.starts_with(signature.start)) {
      throw EventFileError(name + ": is " + signature.kind + "; " + kExpected);
    }
    if (may_become(signature.start)) return std::nullopt;
  }
  const auto header = parse_raw_header(std::as_bytes(std::span(head)), is_all);
  if (!header) return std::nullopt;
  if (is_raw(*header)) return EventFileKind::kRaw;
  if (is_dat(*header, head)) return EventFileKind::kDat;

  // Only the caller can tell a log with a damaged beginning, and words without a header.
  if (from == "yarp") return EventFileKind::kYarpLog;
  if (from == "text") return EventFileKind::kText;
  // What decides must not depend on how much of a stream has come.
  std::string_view start = head.substr(0, kTextBytes);
  if (!is_all) {
    const std::size_t line_end = start.find('\n');
    const bool has_line = line_end != std::string_view::npos && !is_raw_format(from);
    if (is_raw_format(from) && !is_text(start)) return EventFileKind::kRaw;
    if (!has_line && start.size() < kTextBytes) return std::nullopt;
    if (has_line) start = start.substr(0, line_end + 1);
  }
  if (is_yarp_log(start)) return EventFileKind::kYarpLog;
  if (is_text(start)) return EventFileKind::kText;
  if (is_raw_format(from)) return EventFileKind::kRaw;
  if (!header->fields.empty() || name.ends_with(".raw") || name.find('.') == std::string::npos) {
    throw EventFileError(
        name +
        ": has no Prophesee RAW header that says how events are encoded; expected one (\"% evt "
        "3.0\"), or the format as an option (--from or camera.format: evt2, evt21, evt3 or evt4)");
  }
  throw EventFileError(name + ": is of an unknown format; " + kExpected);
}

}  // namespace puck
