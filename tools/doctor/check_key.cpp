#include "tools/doctor/checks.h"

namespace puck {
namespace {

constexpr const char* kKey = "key";

std::string key_option(const std::string& file) { return "--set lcm.key_file=" + file; }

Findings without_key(const Facts& facts) {
  std::int64_t sealed = 0;
  for (const auto& [source, sender] : facts.traffic.senders()) sealed += sender.sealed;
  if (sealed == 0) return {{Verdict::kOk, kKey, "no key is set, and no message is sealed"}};
  return {{Verdict::kWrong, kKey,
           std::to_string(sealed) +
               " messages are sealed with a key, and none is set here. Without the key a "
               "service can neither receive nor be received. Copy the key file of the other "
               "services",
           key_option("FILE")}};
}

}  // namespace

Findings check_key(const Facts& facts) {
  if (facts.key_file.empty()) return without_key(facts);
  Findings findings;
  for (const auto& [source, sender] : facts.traffic.senders()) {
    if (sender.unauthenticated == 0) continue;
    findings.push_back({Verdict::kWrong, kKey,
                        source.address + ":" + std::to_string(source.port) + " sent " +
                            std::to_string(sender.unauthenticated) +
                            " messages that do not have our key, the last on " +
                            sender.last_unauthenticated +
                            ". An intruder, or a service to be started with the same file",
                        key_option(facts.key_file)});
  }
  if (!findings.empty()) return findings;
  return {{Verdict::kOk, kKey, "all messages of ours have the key of " + facts.key_file}};
}

}  // namespace puck
