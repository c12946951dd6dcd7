#pragma once

#include <span>
#include <string_view>

#include "tests/intruder/raw_sender.h"

namespace puck {

/// One kind of invalid data on the bus.
struct Attack {
  std::string_view name;
  std::string_view sends;
  /// Sends some of it; called repeatedly. `round` counts from 0.
  void (*attack)(RawSender& sender, int round) = nullptr;
  /// The counter in STATUS of every receiver; empty: no counter that all of them have.
  std::string_view counted_as;
  int datagrams_per_s = 0;
};

std::span<const Attack> all_attacks();

/// Nothing for an unknown name.
const Attack* find_attack(std::string_view name);

// Datagrams that no LCM would send.
void send_fragments(RawSender& sender, int round);
void send_endless_names(RawSender& sender, int round);
void send_short_headers(RawSender& sender, int round);
void send_random_datagrams(RawSender& sender, int round);

// Well-formed datagrams with something wrong in them.
void send_wrong_counts(RawSender& sender, int round);
void send_random_payloads(RawSender& sender, int round);
void send_wrong_fingerprints(RawSender& sender, int round);
void send_impossible_values(RawSender& sender, int round);
void send_many_channels(RawSender& sender, int round);
void send_time_travel(RawSender& sender, int round);
void send_flood(RawSender& sender, int round);

}  // namespace puck
