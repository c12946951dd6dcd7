#include "common/messaging/wire_layout.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/environment.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

std::filesystem::path lcmtypes() { return source_folder() / "lcmtypes"; }

std::string kind_name(WireKind kind) {
  switch (kind) {
    case WireKind::kInt8:
      return "int8_t";
    case WireKind::kBoolean:
      return "boolean";
    case WireKind::kInt32:
      return "int32_t";
    case WireKind::kInt64:
      return "int64_t";
    case WireKind::kDouble:
      return "double";
    case WireKind::kString:
      return "string";
    case WireKind::kByte:
      return "byte";
  }
  return {};
}

/// The field's declaration in an .lcm file: `double covariance[16]`.
std::string declaration(const WireField& field) {
  std::string text = kind_name(field.kind) + " " + std::string(field.name);
  if (!field.count_field.empty()) return text + "[" + std::string(field.count_field) + "]";
  if (field.fixed_count != 1) return text + "[" + std::to_string(field.fixed_count) + "]";
  return text;
}

std::vector<std::string> declarations_in(const std::filesystem::path& file) {
  std::vector<std::string> found;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const auto code = line.substr(0, line.find("//"));
    const auto semicolon = code.find(';');
    std::istringstream words(code.substr(0, semicolon));
    std::string kind;
    std::string name;
    words >> kind >> name;
    if (semicolon == std::string::npos || kind == "package" || kind == "const") continue;
    found.push_back(kind + " " + name);
  }
  return found;
}

/// The field's constants in an .lcm file in their order: `const int8_t STATE_SHOT_AT = 0;` is
/// "shot at" of field "state".
std::vector<std::string> meanings_in(const std::filesystem::path& file, std::string field) {
  std::transform(field.begin(), field.end(), field.begin(), ::toupper);
  std::vector<std::string> found;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string keyword, kind, name, equals;
    std::size_t value = 0;
    words >> keyword >> kind >> name >> equals >> value;
    if (keyword != "const" || kind != "int8_t" || !name.starts_with(field + "_")) continue;
    CHECK(value == found.size());
    name.erase(0, field.size() + 1);
    std::transform(name.begin(), name.end(), name.begin(), ::tolower);
    std::replace(name.begin(), name.end(), '_', ' ');
    found.push_back(name);
  }
  return found;
}

}  // namespace

TEST_CASE("every type in lcmtypes has the layout of its declaration") {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(lcmtypes())) {
    if (entry.path().extension() == ".lcm") ++files;
  }
  CHECK(files == kAllChannels.size());

  for (const Channel channel : kAllChannels) {
    const WireLayout& layout = wire_layout(channel);
    CAPTURE(layout.type);
    std::vector<std::string> fields;
    for (const WireField& field : layout.fields) fields.push_back(declaration(field));
    CHECK(fields == declarations_in(lcmtypes() / (std::string(layout.type) + ".lcm")));
  }
}

TEST_CASE("the values of a state, mode or phase have their names of lcmtypes") {
  int named = 0;
  for (const Channel channel : kAllChannels) {
    const WireLayout& layout = wire_layout(channel);
    CAPTURE(layout.type);
    for (const WireField& field : layout.fields) {
      const auto meanings =
          meanings_in(lcmtypes() / (std::string(layout.type) + ".lcm"), std::string(field.name));
      CHECK(std::vector<std::string>(field.meanings.begin(), field.meanings.end()) == meanings);
      if (!meanings.empty()) ++named;
    }
  }
  CHECK(named == 6);
}

TEST_CASE("every channel has the layout of its type") {
  for (const Channel channel : kAllChannels) {
    with_message_type(channel, [&]<typename Message>(Message) {
      CHECK(kChannelOf<Message> == channel);
      CHECK(wire_layout(channel).type == Message::getTypeName());
      CHECK(wire_layout(channel).fingerprint() == Message::getHash());
    });
  }
}

TEST_CASE("every layout consumes exactly the output of the generated encoder") {
  std::mt19937_64 random(1);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    for (int i = 0; i < 200; ++i) {
      const auto bytes = random_structure(channel, random).bytes;
      with_message_type(channel, [&](auto message) {
        // Written in the layout, read and written again by LCM's code.
        const int size = static_cast<int>(bytes.size());
        REQUIRE(message.decode(bytes.data(), 0, size) == size);
        std::vector<std::uint8_t> again(static_cast<std::size_t>(message.getEncodedSize()));
        message.encode(again.data(), 0, static_cast<int>(again.size()));
        REQUIRE(again == bytes);
      });
      if (channel != Channel::kEvents) REQUIRE(check_message(channel, bytes) == std::nullopt);
    }
  }
}

}  // namespace puck
