#include "tests/intruder/attacks.h"

#include <algorithm>
#include <array>

namespace puck {
namespace {

// Slow enough for a receiver to get them all, except for the flood.
constexpr int kPaced = 4000;
constexpr int kFast = 20'000;
constexpr int kFlood = 100'000;

constexpr std::array kAttacks{
    Attack{"fragments", "overlapping, wrapping, contradicting and endless fragments",
           &send_fragments, "messages_foreign", kPaced},
    Attack{"names", "channel names that are empty, too long or do not end", &send_endless_names,
           "messages_foreign", kPaced},
    Attack{"headers", "datagrams cut off within their header", &send_short_headers,
           "messages_foreign", kPaced},
    Attack{"random", "datagrams of random bytes", &send_random_datagrams, "messages_foreign",
           kPaced},
    Attack{"counts", "giant and negative counts on every channel", &send_wrong_counts,
           "messages_rejected", kPaced},
    Attack{"payloads", "random bytes, cut off and too long messages on every channel",
           &send_random_payloads, "messages_rejected", kPaced},
    Attack{"fingerprints", "messages with the fingerprint of another type, or of none",
           &send_wrong_fingerprints, "messages_rejected", kPaced},
    Attack{"values", "messages with NaN, infinite and impossible values on every channel",
           &send_impossible_values, "messages_rejected", kPaced},
    Attack{"channels", "messages on 20000 channels that nobody knows", &send_many_channels, "",
           kFast},
    Attack{"time-travel", "valid messages of a stranger whose numbers repeat, go back and leap",
           &send_time_travel, "messages_duplicate", kPaced},
    Attack{"flood", "large and small malformed messages as fast as they go", &send_flood,
           "messages_rejected", kFlood},
};

}  // namespace

std::span<const Attack> all_attacks() { return kAttacks; }

const Attack* find_attack(std::string_view name) {
  const auto found = std::find_if(kAttacks.begin(), kAttacks.end(),
                                  [name](const Attack& attack) { return attack.name == name; });
  return found == kAttacks.end() ? nullptr : &*found;
}

}  // namespace puck
