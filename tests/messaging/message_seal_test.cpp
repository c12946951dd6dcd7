#include "common/messaging/message_seal.h"

#include <fstream>

#include <doctest/doctest.h>
#include <lcm/lcm.h>
#include <sys/stat.h>

#include "common/messaging/bus.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_url.h"

namespace puck {
namespace {

using Bytes = std::vector<std::uint8_t>;
using std::filesystem::perms;

std::filesystem::path key_file(const TemporaryFolder& folder, const std::string& name,
                               const std::string& content, perms mode = perms::owner_read) {
  const auto path = folder / name;
  std::ofstream(path) << content;
  std::filesystem::permissions(path, mode);
  return path;
}

struct Keys {
  TemporaryFolder folder;
  SharedKey key{key_file(folder, "key", std::string(32, 'k'))};
  SharedKey same{key_file(folder, "same", std::string(32, 'k'))};
  SharedKey other{key_file(folder, "other", std::string(31, 'k') + 'l')};
};

Bytes sealed(MessageSealer& sealer, Bytes message) {
  sealer.seal("PUCK_HEAD", message);
  return message;
}

/// The opened message, or the reason of its rejection.
std::string opened(SealOpener& opener, const Bytes& message,
                   std::string_view channel = "PUCK_HEAD") {
  std::string problem;
  const auto plain = opener.open(channel, message, problem);
  return plain ? std::string(plain->begin(), plain->end()) : problem;
}

constexpr const char* kChanged = "is sealed with a different key, or was modified on its way";
constexpr const char* kAgain =
    "was received before: it is a replay, or the network duplicated "
    "it";

}  // namespace

TEST_CASE("a sealed message is opened with the same key, and only once") {
  const Keys keys;
  MessageSealer sealer(keys.key);
  SealOpener opener(keys.same);
  const Bytes message = sealed(sealer, {'a', 'b', 'c'});
  CHECK(message.size() == 3 + kSealBytes);
  CHECK(looks_sealed(message));
  CHECK(opened(opener, message) == "abc");
  CHECK(opened(opener, message) == kAgain);
  CHECK(opened(opener, sealed(sealer, {})).empty());
}

TEST_CASE("a changed bit of a sealed message, its channel or its key is detected") {
  const Keys keys;
  MessageSealer sealer(keys.key);
  SealOpener opener(keys.key);
  const Bytes message = sealed(sealer, {'a', 'b', 'c'});
  for (std::size_t bit = 0; bit < 8 * message.size(); ++bit) {
    Bytes changed = message;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    CAPTURE(bit);
    const bool is_mark = bit / 8 >= message.size() - 4;
    const bool is_version = bit / 8 == message.size() - 1;
    if (is_version && looks_sealed(changed)) {
      CHECK(opened(opener, changed).starts_with("has a seal of version "));
    } else {
      CHECK(opened(opener, changed) ==
            (is_mark ? "is not sealed, and this service has a key" : kChanged));
    }
  }
  CHECK(opened(opener, message, "PUCK_HEAD_2") == kChanged);
  SealOpener stranger(keys.other);
  CHECK(opened(stranger, message) == kChanged);
  CHECK(opened(opener, {'a', 'b', 'c'}) == "is not sealed, and this service has a key");
  CHECK(opened(opener, message) == "abc");  // None of it has used the message up.
}

TEST_CASE("a seal of another version is distinguished from a wrong key, even without a key") {
  const Keys keys;
  MessageSealer sealer(keys.key);
  SealOpener opener(keys.key);
  Bytes message = sealed(sealer, {'a', 'b', 'c'});
  CHECK(std::string(message.end() - 4, message.end()) == "PSL2");
  message.back() = '1';
  CHECK(opened(opener, message) ==
        "has a seal of version 1, and this service's are of 2: one of the two is another version "
        "of PUCK");
  CHECK(looks_sealed(message));
}

TEST_CASE("messages may overtake one another, but a replay is rejected at any age") {
  const Keys keys;
  MessageSealer sealer(keys.key);
  SealOpener opener(keys.key);
  std::vector<Bytes> messages;
  for (char i = 0; i < 100; ++i)
    messages.push_back(sealed(sealer, {static_cast<unsigned char>('0' + i)}));
  CHECK(opened(opener, messages[0]) == "0");
  CHECK(opened(opener, messages[5]) == "5");
  CHECK(opened(opener, messages[3]) == "3");
  CHECK(opened(opener, messages[3]) == kAgain);
  CHECK(opened(opener, messages[5]) == kAgain);
  CHECK(opened(opener, messages[99]).size() == 1);
  CHECK(opened(opener, messages[36]).size() == 1);  // Of the 64 newest the oldest.
  CHECK(opened(opener, messages[35]) == kAgain);
}

TEST_CASE("publishers are distinguished") {
  const Keys keys;
  MessageSealer left(keys.key);
  MessageSealer right(keys.key);
  SealOpener opener(keys.key);
  CHECK(opened(opener, sealed(left, {'l'})) == "l");
  CHECK(opened(opener, sealed(right, {'r'})) == "r");
  CHECK(opened(opener, sealed(left, {'l'})) == "l");
}

TEST_CASE("a missing or short key, or one readable by others, ends the start") {
  const TemporaryFolder folder;
  const std::string content(32, 'k');
  const auto problem = [](const std::filesystem::path& file) -> std::string {
    try {
      const SharedKey key(file);
    } catch (const BusError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(problem(key_file(folder, "good", content)).empty());
  const auto open_to_all = key_file(folder, "open", content, perms::owner_read | perms::group_read);
  CHECK(problem(open_to_all) == "lcm.key_file \"" + open_to_all.string() +
                                    "\" may be read by others; \"chmod 600 " +
                                    open_to_all.string() + "\" mends it");
  CHECK(problem(folder / "missing").find("cannot be read") != std::string::npos);
  CHECK(problem(key_file(folder, "short", "secret")).find("must have 32 to 4096 bytes, has 6") !=
        std::string::npos);
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(problem(folder / "pipe").ends_with("is not a file"));
  CHECK_THROWS_AS(Bus({.url = "memq://", .key_file = (folder / "missing").string()}), BusError);
}

TEST_CASE("a bus with a key receives only messages sealed with it, and names the others") {
  const TemporaryFolder folder;
  const std::string key = key_file(folder, "key", std::string(32, 'k')).string();
  const std::string other = key_file(folder, "other", std::string(32, 'o')).string();
  const std::string url = private_lcm_url();
  Bus with_key({.url = url, .key_file = key});
  Bus friendly({.url = url, .key_file = key});
  Bus enemy({.url = url, .key_file = other});
  Bus plain({.url = url});
  std::vector<double> heard;
  std::size_t raw_bytes = 0;
  with_key.subscribe<head_state_t>(
      [&](const head_state_t& head, const Receipt&) { heard.push_back(head.yaw_deg); });
  with_key.subscribe_all([&](std::string_view, std::span<const std::uint8_t> bytes,
                             const Receipt&) { raw_bytes += bytes.size(); });
  int heard_plain = 0;
  plain.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++heard_plain; });
  for (Bus* bus : {&with_key, &friendly, &enemy, &plain}) {
    REQUIRE(bus->start({}, [](const std::string& reason) { MESSAGE(reason); }));
  }
  head_state_t head{};
  double yaw_deg = 0;
  for (Bus* bus : {&enemy, &plain, &friendly}) {
    head.yaw_deg = ++yaw_deg;
    REQUIRE(bus->publish(head));
  }
  // On an unknown channel, like a logger of all channels.
  lcm_t* const lcm = lcm_create(url.c_str());
  REQUIRE(lcm != nullptr);
  lcm_publish(lcm, "PUCK_UNKNOWN", "unsealed", 8);
  lcm_destroy(lcm);
  for (int i = 0; i < 100 && with_key.unknown_channels().unauthenticated == 0; ++i) {
    with_key.handle(std::chrono::milliseconds(50));
  }
  while (heard.empty()) REQUIRE(with_key.handle(std::chrono::milliseconds(5000)) > 0);
  CHECK(heard == std::vector<double>{3});
  CHECK(raw_bytes == static_cast<std::size_t>(head.getEncodedSize()));  // Logs hold it unsealed.
  const ChannelCounters counters = with_key.counters<head_state_t>();
  CHECK(counters.unauthenticated == 2);
  CHECK(counters.rejected == 0);
  CHECK(counters.last_rejection.starts_with("is not sealed, and this service has a key, from "));
  CHECK(with_key.unknown_channels().unauthenticated == 1);
  CHECK(with_key.unknown_channels().last_rejection.starts_with("is not sealed"));

  while (heard_plain == 0) REQUIRE(plain.handle(std::chrono::milliseconds(5000)) > 0);
  CHECK(plain.counters<head_state_t>().rejected == 2);
  CHECK(plain.counters<head_state_t>().last_rejection.starts_with(
      "is sealed, but this service has no key (lcm.key_file), from "));
}

}  // namespace puck
