#include "tests/support/test_board_bytes.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace puck {
namespace {

using namespace std::string_literals;

const std::string kHello = "YA\x64\x1E\0\0RP"s;
const std::string kIndex = "YA\x0A\0\0\0RP"s;

[[noreturn]] void refuse(const char* what) { throw std::runtime_error(what); }

std::int32_t int_at(const std::string& bytes, std::size_t at) {
  if (at + 4 > bytes.size()) refuse("an int32 is missing");
  std::int32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string bytes_of(std::int32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

void expect(bool holds, const char* what) {
  if (!holds) refuse(what);
}

std::string real_block(const std::vector<double>& deg) {
  return {reinterpret_cast<const char*>(deg.data()), deg.size() * sizeof(double)};
}

std::string list_block(const std::vector<double>& deg) {
  return bytes_of(266) + bytes_of(static_cast<int>(deg.size()));
}

}  // namespace

std::string carrier_message(const std::vector<std::string>& blocks) {
  std::string bytes = kIndex + static_cast<char>(blocks.size()) + '\1' + std::string(8, '\xFF');
  for (const std::string& block : blocks) bytes += bytes_of(static_cast<int>(block.size()));
  bytes += bytes_of(0);
  for (const std::string& block : blocks) bytes += block;
  return bytes;
}

std::optional<std::string> take_bytes(std::string& input, std::size_t size) {
  if (input.size() < size) return std::nullopt;
  std::string taken = input.substr(0, size);
  input.erase(0, size);
  return taken;
}

std::optional<std::string> take_hello(std::string& input) {
  if (input.size() < 12) return std::nullopt;
  expect(input.starts_with(kHello), "no greeting of the binary carrier");
  const std::int32_t length = int_at(input, 8);
  expect(length > 1 && length < 200, "a greeting without a name");
  const auto greeting = take_bytes(input, 12 + static_cast<std::size_t>(length));
  if (!greeting) return std::nullopt;
  expect(greeting->back() == '\0', "a name without its NUL");
  return greeting->substr(12, static_cast<std::size_t>(length) - 1);
}

std::optional<std::vector<std::string>> take_message(std::string& input) {
  if (input.size() < 18) return std::nullopt;
  expect(input.starts_with(kIndex), "no message");
  const auto blocks = static_cast<std::size_t>(input[8]);
  expect(blocks >= 1 && blocks <= 8 && input[9] == '\1', "a wrong number of blocks");
  expect(input.substr(10, 8) == std::string(8, '\xFF'), "an index that is not padded");
  const std::size_t head = 18 + 4 * blocks + 4;
  if (input.size() < head) return std::nullopt;
  std::size_t total = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::int32_t size = int_at(input, 18 + 4 * i);
    expect(size >= 0 && size < 2000, "a block of a size that cannot be");
    total += static_cast<std::size_t>(size);
  }
  expect(int_at(input, head - 4) == 0, "an answer is asked for");
  if (input.size() < head + total) return std::nullopt;
  const std::string sizes = *take_bytes(input, head);
  std::vector<std::string> taken;
  for (std::size_t i = 0; i < blocks; ++i) {
    taken.push_back(*take_bytes(input, static_cast<std::size_t>(int_at(sizes, 18 + 4 * i))));
  }
  expect(taken[0].size() == 8 && taken[0].substr(0, 5) == "\0\0\0\0~"s &&
             taken[0].substr(6) == "\0\1"s,
         "no port command first");
  return taken;
}

SetPointMessage read_set_points(const std::vector<std::string>& blocks) {
  expect(blocks.size() == 2 && blocks[0][5] == 'd', "not two blocks of data");
  const std::string& block = blocks[1];
  std::size_t at = 0;
  const auto next = [&] {
    at += 4;
    return int_at(block, at - 4);
  };
  expect(next() == 256 && next() == 2, "no pair");
  expect(next() == 256, "no header");
  const int items = next();
  expect(next() == 9, "no vocab first");
  SetPointMessage message;
  message.kind = block.substr(at, 4);
  at += 4;
  expect(next() == 1, "no count of joints");
  const int joints = next();
  if (message.kind == "dpog") {
    expect(items == 3 && next() == 257 && next() == joints, "no list of joints");
    for (int i = 0; i < joints; ++i) message.joints.push_back(static_cast<std::size_t>(next()));
  } else {
    expect(message.kind == "dpos" && items == 2, "another kind of set-points");
  }
  expect(next() == 266 && next() == joints, "no vector of that many joints");
  expect(block.size() == at + 8 * static_cast<std::size_t>(joints), "a vector of another size");
  message.deg.resize(static_cast<std::size_t>(joints));
  std::memcpy(message.deg.data(), block.data() + at, block.size() - at);
  return message;
}

std::string state_message(long long count, double time_s, const std::vector<double>& deg) {
  return carrier_message({stamp_block(count, time_s), list_block(deg), real_block(deg)});
}

std::string stamp_block(long long count, double time_s) {
  std::array<char, 64> text{};
  const int length = std::snprintf(text.data(), text.size(), "D %lld %.6f", count, time_s) + 1;
  return bytes_of(length) + "~\0\0\1"s + std::string(text.data()) + '\0';
}

std::string block_without_stamp() { return "\0\0\0\0~D\0\1"s; }

std::string state_message_without_stamp(const std::vector<double>& deg) {
  return carrier_message({block_without_stamp(), list_block(deg), real_block(deg)});
}

}  // namespace puck
