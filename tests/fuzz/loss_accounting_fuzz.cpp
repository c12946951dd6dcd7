// Any order of any numbers of any publishers.
#include <algorithm>

#include <fuzzer/FuzzedDataProvider.h>

#include "common/messaging/loss_accounting.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;  // check_message()'s limit.
  FuzzedDataProvider input(data, size);
  puck::LossAccount account;
  std::int64_t seq = 0;
  std::int64_t messages = 0;
  while (input.remaining_bytes() > 0) {
    // Mostly close to the last, so that windows and duplicates occur.
    seq = input.ConsumeBool()
              ? input.ConsumeIntegralInRange<std::int64_t>(0, kMost)
              : std::clamp<std::int64_t>(seq + input.ConsumeIntegral<std::int8_t>(), 0, kMost);
    const auto session = input.ConsumeIntegralInRange<std::int64_t>(1, 20);
    const auto items_before = input.ConsumeIntegralInRange<std::int64_t>(0, kMost);
    const auto items = input.ConsumeIntegralInRange<std::int64_t>(0, 16384);
    account.add(session, seq, items_before, items);
    ++messages;
    const puck::LossCounters& counters = account.counters();
    puck::require(counters.received == messages, "every message is counted");
    puck::require(counters.lost >= 0 && counters.lost <= kMost, "losses are a count");
    puck::require(counters.items_lost >= 0 && counters.items_lost <= kMost,
                  "lost events are a count");
    puck::require(counters.late >= 0 && counters.duplicates >= 0 &&
                      counters.late + counters.duplicates + counters.sessions <= messages,
                  "a message arrives in one way");
  }
  return 0;
}
