#include "common/messaging/shared_key.h"

#include <fstream>
#include <vector>

#include <sodium.h>
#include <sys/stat.h>

#include "common/messaging/bus_error.h"
#include "common/messaging/byte_order.h"

namespace puck {
namespace {

constexpr std::size_t kLeastBytes = 32;
constexpr std::size_t kMostBytes = 4096;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw BusError("lcm.key_file \"" + file.string() + "\" " + what);
}

void check_owner_only(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    fail(file, "cannot be read; \"head -c 32 /dev/urandom\" makes a key");
  }
  if (!S_ISREG(status.st_mode)) fail(file, "is not a file");
  if ((status.st_mode & 077) != 0) {
    fail(file, "may be read by others; \"chmod 600 " + file.string() + "\" mends it");
  }
}

std::vector<std::uint8_t> read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(kMostBytes + 1);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  if (bytes.size() < kLeastBytes || bytes.size() > kMostBytes) {
    fail(file, "must have " + std::to_string(kLeastBytes) + " to " + std::to_string(kMostBytes) +
                   " bytes, has " +
                   (bytes.size() > kMostBytes ? "more" : std::to_string(bytes.size())));
  }
  return bytes;
}

}  // namespace

SharedKey::SharedKey(const std::filesystem::path& file) {
  if (sodium_init() < 0) throw BusError("lcm.key_file: libsodium does not start");
  check_owner_only(file);
  std::vector<std::uint8_t> bytes = read_file(file);
  crypto_generichash(key_.data(), key_.size(), bytes.data(), bytes.size(), nullptr, 0);
  sodium_memzero(bytes.data(), bytes.size());
}

SharedKey::Hash SharedKey::hash(std::string_view channel, std::span<const std::uint8_t> message,
                                std::uint64_t sender, std::uint64_t number) const {
  // The lengths before the parts, so that no byte can move from one to the other.
  std::array<std::uint8_t, 32> header{};
  put_big_endian(std::uint64_t{channel.size()}, header.data());
  put_big_endian(std::uint64_t{message.size()}, header.data() + 8);
  put_big_endian(sender, header.data() + 16);
  put_big_endian(number, header.data() + 24);
  crypto_generichash_state state;
  Hash hash{};
  crypto_generichash_init(&state, key_.data(), key_.size(), hash.size());
  crypto_generichash_update(&state, header.data(), header.size());
  crypto_generichash_update(&state, reinterpret_cast<const std::uint8_t*>(channel.data()),
                            channel.size());
  crypto_generichash_update(&state, message.data(), message.size());
  crypto_generichash_final(&state, hash.data(), hash.size());
  return hash;
}

}  // namespace puck
