#include "common/messaging/shared_key.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/messaging/bus_error.h"
#include "common/messaging/byte_order.h"

namespace puck {
namespace {

constexpr std::size_t kLeastBytes = 32;
constexpr std::size_t kMostBytes = 4096;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw BusError("lcm.key_file \"" + file.string() + "\" " + what);
}

/// Checks the open file, so that it cannot be replaced after the check.
void check_owner_only(const std::filesystem::path& file, int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) fail(file, "is not a file");
  if ((status.st_mode & 077) != 0) {
    fail(file, "may be read by others; \"chmod 600 " + file.string() + "\" mends it");
  }
  if (status.st_uid != geteuid() && status.st_uid != 0) {
    fail(file, "belongs to another user");
  }
}

std::vector<std::uint8_t> read_file(const std::filesystem::path& file) {
  // O_NONBLOCK: opening a pipe without a writer must not block.
  const int descriptor = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(
      descriptor < 0 ? nullptr : fdopen(descriptor, "rb"), &std::fclose);
  if (!stream) {
    fail(file, std::string("cannot be read: ") + std::strerror(errno) +
                   "; \"head -c 32 /dev/urandom\" makes a key");
  }
  check_owner_only(file, descriptor);
  std::vector<std::uint8_t> bytes(kMostBytes + 1);
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), stream.get()));
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
  std::vector<std::uint8_t> bytes = read_file(file);
  crypto_generichash(key_.data(), key_.size(), bytes.data(), bytes.size(), nullptr, 0);
  sodium_memzero(bytes.data(), bytes.size());
}

SharedKey::Hash SharedKey::hash(std::string_view channel, std::span<const std::uint8_t> message,
                                std::uint64_t sender, std::uint64_t number) const {
  std::array<std::uint8_t, crypto_core_hchacha20_INPUTBYTES> which{};
  put_big_endian(sender, which.data());
  put_big_endian(number, which.data() + 8);
  std::array<std::uint8_t, crypto_onetimeauth_KEYBYTES> message_key{};
  crypto_core_hchacha20(message_key.data(), which.data(), key_.data(), nullptr);

  // The lengths come first, so that no byte can move from one part to the other.
  std::array<std::uint8_t, 16> lengths{};
  put_big_endian(std::uint64_t{channel.size()}, lengths.data());
  put_big_endian(std::uint64_t{message.size()}, lengths.data() + 8);
  crypto_onetimeauth_state state;
  Hash hash{};
  static_assert(std::tuple_size_v<Hash> == crypto_onetimeauth_BYTES);
  crypto_onetimeauth_init(&state, message_key.data());
  crypto_onetimeauth_update(&state, lengths.data(), lengths.size());
  crypto_onetimeauth_update(&state, reinterpret_cast<const std::uint8_t*>(channel.data()),
                            channel.size());
  crypto_onetimeauth_update(&state, message.data(), message.size());
  crypto_onetimeauth_final(&state, hash.data());
  return hash;
}

}  // namespace puck
