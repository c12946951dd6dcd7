#include "common/io/byte_source.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <thread>

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <zstd.h>

#include "common/io/event_reader.h"
#include "tests/io/gzip_text.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

// Long enough for several blocks, and hardly compressible.
std::string long_text() {
  std::string text;
  std::uint32_t state = 1;
  for (int i = 0; i < 300'000; ++i) {
    state = state * 1664525 + 1013904223;
    text += static_cast<char>(state >> 24);
  }
  return text;
}

std::string zstd(const std::string& text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 1));
  return packed;
}

std::string text_of_source(ByteSource& source, std::size_t at_once = 65536) {
  std::string text;
  std::vector<std::byte> block(at_once);
  while (const std::size_t size = source.read(block)) {
    text.append(reinterpret_cast<const char*>(block.data()), size);
  }
  return text;
}

TEST_CASE("bytes are read plain, from gzip and from zstd, of one part or more, and again") {
  const TemporaryFolder folder;
  const std::string text = long_text();
  const std::string zeros(1000, '\0');
  for (const std::string& packed :
       {text, gzip(text), zstd(text), gzip(text.substr(0, 1000)) + gzip(text.substr(1000)),
        gzip(text) + zeros, zstd(text.substr(0, 1000)) + zstd(text.substr(1000))}) {
    const auto source = open_bytes(folder.write("a", packed));
    CHECK(text_of_source(*source) == text);
    CHECK(source->can_rewind());
    source->rewind();
    CHECK(text_of_source(*source, 777) == text);
  }
}

TEST_CASE("compressed bytes that end early or are damaged give those before, then an error") {
  const TemporaryFolder folder;
  const std::string text = long_text();
  for (const auto& packed : {gzip(text), zstd(text)}) {
    const auto cut = open_bytes(folder.write("cut", packed.substr(0, packed.size() - 100)));
    std::string read;
    const std::string message = message_of<EventFileError>([&] {
      std::array<std::byte, 1000> block{};
      while (const std::size_t size = cut->read(block)) {
        read.append(reinterpret_cast<const char*>(block.data()), size);
      }
    });
    CHECK(contains(message, "cut: cannot be read to its end: its bytes end too early"));
    CHECK(contains(message, "at byte " + std::to_string(packed.size() - 100)));
    CHECK(read.size() > 100'000);
    CHECK(text.starts_with(read));

    const auto damaged = open_bytes(folder.write("bad", packed.substr(0, 50) + "???" + packed));
    CHECK(contains(message_of<EventFileError>([&] { text_of_source(*damaged); }), "are no valid"));
  }
}

TEST_CASE("archives of other kinds are refused by name with the remedy") {
  const TemporaryFolder folder;
  const auto refusal = [&](std::string_view start) {
    return message_of<EventFileError>([&] { open_bytes(folder.write("a", start)); });
  };
  CHECK(contains(refusal(std::string_view("\xfd\x37zXZ\0\0", 7)), "compressed as xz; expected"));
  CHECK(contains(refusal("BZh91AY&SY"), "compressed as bzip2; expected"));
  CHECK(contains(refusal("PK\x03\x04xx"), "compressed as zip; expected"));
  CHECK(contains(message_of<EventFileError>([&] { open_bytes(folder / "none"); }),
                 "none: cannot be opened: No such file"));
  CHECK(contains(message_of<EventFileError>([&] { open_bytes(folder / ""); }), "is a folder"));
}

TEST_CASE("a pipe is read once, without seeking") {
  const TemporaryFolder folder;
  const std::string text = long_text();
  for (const std::string& packed : {text, gzip(text), zstd(text)}) {
    const std::string pipe = folder / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::jthread writer([&] { write_text(pipe, packed); });
    const auto source = open_bytes(pipe);
    CHECK_FALSE(source->can_rewind());
    CHECK(text_of_source(*source) == text);
    CHECK(contains(message_of<EventFileError>([&] { source->rewind(); }), "can be read only once"));
    writer.join();
    std::filesystem::remove(pipe);
  }
}

}  // namespace
}  // namespace puck
