#include "common/io/aedat4_header.h"

#include <algorithm>
#include <stdexcept>

#include "common/io/flat_table.h"
#include "common/io/parse_number.h"

namespace puck {
namespace {

constexpr std::size_t kDeepestNode = 32;

// The text between the next `before` and `after` of a tag; empty if there is none.
std::string_view part_of(std::string_view tag, std::string_view before, char after) {
  const std::size_t start = tag.find(before);
  if (start == std::string_view::npos) return {};
  const std::string_view rest = tag.substr(start + before.size());
  return rest.substr(0, rest.find(after));
}

// The description is XML of nested nodes: outInfo, in it one a stream, in that `info`.
class StreamList {
 public:
  explicit StreamList(std::string_view xml) {
    while (true) {
      const std::size_t start = xml.find('<');
      const std::size_t end = xml.find('>', std::min(start, xml.size()));
      if (end == std::string_view::npos) return;
      const std::string_view tag = xml.substr(start, end - start);
      xml.remove_prefix(end + 1);
      if (tag.starts_with("<node ")) {
        if (tag.ends_with('/')) continue;
        if (path_.size() == kDeepestNode) return;
        path_.push_back(part_of(tag, "name=\"", '"'));
      } else if (tag.starts_with("</node")) {
        if (!path_.empty()) path_.pop_back();
      } else if (tag.starts_with("<attr ")) {
        take(part_of(tag, "key=\"", '"'), xml.substr(0, xml.find('<')));
      }
    }
  }

  std::vector<Aedat4Stream> streams;

 private:
  void take(std::string_view key, std::string_view value) {
    const auto out = std::find(path_.begin(), path_.end(), "outInfo");
    Aedat4Stream* stream = out == path_.end() || out + 1 == path_.end() ? nullptr : at(out[1]);
    if (stream == nullptr) return;
    if (key == "typeIdentifier") stream->type = value;
    if (key == "source") stream->source = value;
    if (key == "sizeX") parse_number(value, stream->sensor.width);
    if (key == "sizeY") parse_number(value, stream->sensor.height);
  }

  Aedat4Stream* at(std::string_view name) {
    std::int32_t id = 0;
    if (!parse_number(name, id)) return nullptr;
    for (Aedat4Stream& stream : streams) {
      if (stream.id == id) return &stream;
    }
    streams.push_back({.id = id});
    return &streams.back();
  }

  std::vector<std::string_view> path_;
};

}  // namespace

Aedat4Header parse_aedat4_header(std::span<const std::byte> buffer) {
  const FlatTable table(buffer, "IOHE");
  const auto packing = table.number<std::int32_t>(0, 0);
  if (packing < 0 || packing > static_cast<std::int32_t>(Aedat4Packing::kZstdHigh)) {
    throw std::invalid_argument("compression " + std::to_string(packing) +
                                ", expected 0 (none), 1 or 2 (LZ4), 3 or 4 (zstd)");
  }
  Aedat4Header header;
  header.packing = static_cast<Aedat4Packing>(packing);
  header.end_of_packets = table.number<std::int64_t>(1, -1);
  const auto xml = table.list(2, 1);
  header.streams = StreamList({reinterpret_cast<const char*>(xml.data()), xml.size()}).streams;
  return header;
}

}  // namespace puck
