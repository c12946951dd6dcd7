// A bus with a shared key.
#include <filesystem>

#include "common/messaging/message_seal.h"
#include "tests/doctor/doctor_bench.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

std::string key_file(const TemporaryFolder& folder, const std::string& name) {
  const auto file = folder.write(name, std::string(32, name.front()));
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  return file;
}

/// A STATUS as it goes over the wire, sealed with the key in a file; empty: with none.
std::vector<std::uint8_t> status_datagram(const std::string& file) {
  service_status_t status = a_status(1, "puck-arm");
  std::vector<std::uint8_t> payload;
  encode(status, payload);
  if (!file.empty()) {
    const SharedKey key(file);
    MessageSealer(key).seal("PUCK_STATUS", payload);
  }
  return lcm_datagram("PUCK_STATUS", payload);
}

Facts facts_with_key(const std::string& file) {
  Facts facts = healthy_facts();
  facts.key_file = file;
  facts.traffic = Traffic("", open_seals_with(file));
  return facts;
}

}  // namespace

TEST_CASE("messages sealed with our key are accepted") {
  const TemporaryFolder folder;
  const std::string file = key_file(folder, "key");
  Facts facts = facts_with_key(file);
  hear(facts.traffic, kOtherHost, status_datagram(file));
  CHECK(facts.traffic.services().size() == 1);
  CHECK(count_of(check_key(facts), Verdict::kOk) == 1);
  CHECK(count_of(check_senders(facts), Verdict::kWrong) == 0);
}

TEST_CASE("messages without our key, or with another, are reported and ignored") {
  const TemporaryFolder folder;
  const std::string file = key_file(folder, "key");
  for (const std::string& other : {std::string(), key_file(folder, "other")}) {
    Facts facts = facts_with_key(file);
    hear(facts.traffic, kOtherHost, status_datagram(other));
    CHECK(facts.traffic.services().empty());
    const Finding wrong = the_wrong_one(check_key(facts));
    CHECK(says(wrong, "10.0.0.9:5000 sent 1 messages that do not have our key"));
    CHECK(wrong.mend == "--set lcm.key_file=" + file);
  }
}

TEST_CASE("without a key, a sealed bus is reported, and its messages are still read") {
  const TemporaryFolder folder;
  Facts facts = healthy_facts();
  CHECK(count_of(check_key(facts), Verdict::kOk) == 1);
  hear(facts.traffic, kOtherHost, status_datagram(key_file(folder, "key")));
  CHECK(facts.traffic.is_sealed());
  CHECK(facts.traffic.services().size() == 1);
  CHECK(the_wrong_one(check_key(facts)).mend == "--set lcm.key_file=FILE");
  CHECK(count_of(check_senders(facts), Verdict::kWrong) == 0);
}

}  // namespace puck
