#include "common/io/yarp_bottle.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "common/io/word_assembler.h"

namespace puck {
namespace {

// Codes of a bottle's items. The code of a list whose items are all of one kind contains that kind,
// and the items then have no codes of their own.
constexpr std::int32_t kInt32 = 1;
constexpr std::int32_t kString = 4;
constexpr std::int32_t kVocab32 = 9;
constexpr std::int32_t kFloat64 = 10;
constexpr std::int32_t kBlob = 12;
constexpr std::int32_t kInt64 = 17;
constexpr std::int32_t kVocab64 = 25;
constexpr std::int32_t kInt8 = 32;
constexpr std::int32_t kInt16 = 64;
constexpr std::int32_t kFloat32 = 128;
constexpr std::int32_t kList = 256;

constexpr int kDeepestList = 8;
constexpr std::size_t kWordBytes = 4;

// An item: its kind, and its bytes or the items of a list.
struct Item {
  std::int32_t kind = 0;  // A list's contains the kind of its items.
  std::size_t items = 0;  // Of a list.
  std::span<const std::uint8_t> bytes;

  bool is_list() const { return (kind & kList) != 0; }
  bool has_bytes() const { return kind == kString || kind == kBlob; }
};

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return load_word<std::uint32_t>(std::as_bytes(bytes).data() + at);
}

// Size of an item whose size is fixed; 0: it is not.
std::size_t fixed_bytes(std::int32_t kind) {
  switch (kind) {
    case kInt8:
      return 1;
    case kInt16:
      return 2;
    case kInt32:
    case kVocab32:
    case kFloat32:
      return 4;
    case kInt64:
    case kVocab64:
    case kFloat64:
      return 8;
    default:
      return 0;
  }
}

// Takes items from the beginning of bytes; nothing where they are no item.
class BottleCursor {
 public:
  explicit BottleCursor(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  std::size_t left() const { return rest_.size(); }

  std::optional<std::int32_t> take_int() {
    if (rest_.size() < kWordBytes) return std::nullopt;
    return static_cast<std::int32_t>(word_at(take(kWordBytes), 0));
  }

  /// `kind`: 0 where the item has a code of its own. The items of a list are not taken.
  std::optional<Item> take_item(std::int32_t kind) {
    if (kind == 0) {
      const auto code = take_int();
      if (!code) return std::nullopt;
      kind = *code;
    }
    Item item{.kind = kind};
    const std::size_t size = fixed_bytes(kind);
    if (size > 0) return take_bytes(item, size);
    if (!item.is_list() && !item.has_bytes()) return std::nullopt;
    const auto length = take_int();
    if (!length || *length < 0) return std::nullopt;
    if (item.has_bytes()) return take_bytes(item, static_cast<std::size_t>(*length));
    item.items = static_cast<std::size_t>(*length);
    return item;
  }

  /// Takes the items of a list. False where they are no items.
  bool skip_list(const Item& list, int depth) {
    const std::int32_t kind = list.kind & ~kList;
    // Each item takes a byte or more.
    if (depth > kDeepestList || list.items > rest_.size()) return false;
    for (std::size_t i = 0; i < list.items; ++i) {
      const auto item = take_item(kind);
      if (!item || (item->is_list() && !skip_list(*item, depth + 1))) return false;
    }
    return true;
  }

  /// Takes a list of int32, appending them in pairs.
  bool take_pairs(const Item& list, YarpPacket& packet) {
    if (list.kind != (kList | kInt32) || list.items > rest_.size() / kWordBytes) return false;
    const auto bytes = take(kWordBytes * list.items);
    const std::size_t paired = list.items / 2 * 2;
    for (std::size_t i = 0; i < paired; ++i) {
      packet.words.push_back(word_at(bytes, kWordBytes * i));
    }
    if (paired != list.items) ++packet.malformed_values;
    return true;
  }

 private:
  std::span<const std::uint8_t> take(std::size_t size) {
    const auto taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }
  std::optional<Item> take_bytes(Item& item, std::size_t size) {
    if (size > rest_.size()) return std::nullopt;
    item.bytes = take(size);
    return item;
  }

  std::span<const std::uint8_t> rest_;
};

std::string_view tag_of(const Item& item) {
  if (item.kind != kString) return {};
  std::string_view text(reinterpret_cast<const char*>(item.bytes.data()), item.bytes.size());
  // Some versions send the NUL, too.
  if (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  return is_yarp_tag(text) ? text : std::string_view{};
}

void read_words(std::span<const std::uint8_t> bytes, YarpPacket& packet) {
  std::size_t at = 0;
  for (; at + kWordBytes <= bytes.size(); at += kWordBytes) {
    packet.words.push_back(word_at(bytes, at));
  }
  if (at != bytes.size()) ++packet.malformed_values;
}

// Collects the events of a bottle from its items.
class BottleReader {
 public:
  BottleReader(BottleCursor& cursor, YarpPacket& packet) : cursor_(cursor), packet_(packet) {}

  /// False where there is no item.
  bool take(std::int32_t kind) {
    const auto item = cursor_.take_item(kind);
    if (!item) return false;
    const std::string_view tag = awaits_ == Awaits::kBytes ? std::string_view{} : tag_of(*item);
    if (!tag.empty()) {
      finish();
      const bool is_first = tag == kYarpEventTag && !std::exchange(has_events_, true);
      if (!is_first) ++packet_.other_records;
      awaits_ = is_first ? Awaits::kEvents : Awaits::kTag;
      return true;
    }
    return item->is_list() ? take_list(*item) : take_value(*item);
  }

  /// A tag of events without events behind it is malformed.
  void finish() {
    if (awaits_ != Awaits::kTag) ++packet_.malformed_values;
    awaits_ = Awaits::kTag;
  }

  bool has_tag() const { return has_events_ || packet_.other_records > 0; }

 private:
  enum class Awaits : std::uint8_t { kTag, kEvents, kBytes };

  bool take_list(const Item& list) {
    // An empty list has no kind.
    const bool is_events = awaits_ == Awaits::kEvents && (list.kind == (kList | kInt32) ||
                                                          (list.kind == kList && list.items == 0));
    if (!is_events) return cursor_.skip_list(list, 1);
    awaits_ = Awaits::kTag;
    return list.items == 0 || cursor_.take_pairs(list, packet_);
  }

  bool take_value(const Item& item) {
    if (awaits_ == Awaits::kEvents && item.kind == kInt32) {
      packet_.duration_us = static_cast<std::int32_t>(word_at(item.bytes, 0));
      awaits_ = packet_.duration_us >= 0 ? Awaits::kBytes : Awaits::kEvents;
    } else if (awaits_ == Awaits::kBytes && item.has_bytes()) {
      packet_.is_bytes = true;
      read_words(item.bytes, packet_);
      awaits_ = Awaits::kTag;
    }
    return true;
  }

  BottleCursor& cursor_;
  YarpPacket& packet_;
  Awaits awaits_ = Awaits::kTag;
  bool has_events_ = false;
};

}  // namespace

bool parse_yarp_bottle(std::span<const std::uint8_t> bytes, YarpPacket& packet) {
  YarpPacket empty;
  empty.words = std::move(packet.words);
  empty.words.clear();
  packet = std::move(empty);
  BottleCursor cursor(bytes);
  const auto bottle = cursor.take_item(0);
  if (!bottle || !bottle->is_list()) return false;
  BottleReader reader(cursor, packet);
  for (std::size_t i = 0; i < bottle->items; ++i) {
    if (!reader.take(bottle->kind & ~kList)) return false;
  }
  reader.finish();
  return reader.has_tag() && cursor.left() == 0;
}

}  // namespace puck
