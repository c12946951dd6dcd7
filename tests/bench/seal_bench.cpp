// Cost of a key: packets of events sealed by the camera and opened by a receiver.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/messaging/event_packing.h"
#include "common/messaging/message_seal.h"
#include "common/messaging/shared_key.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

// Of a packet beside its events: LCM's header, the longest channel name, the message's own fields.
constexpr int kOtherBytes = 130;

SharedKey make_key() {
  const TemporaryFolder folder;
  const auto path = folder / "key";
  std::ofstream(path) << std::string(32, 'k');
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  return SharedKey(path);
}

/// Counts events, so that 10 over its Mev/s is the share of a core at 10 Mev/s.
void packet_seal(benchmark::State& state, int packet_bytes) {
  const SharedKey key = make_key();
  MessageSealer sealer(key);
  SealOpener opener(key);
  const auto message_bytes = static_cast<std::size_t>(packet_bytes) - kSealBytes;
  const std::vector<std::uint8_t> plain(message_bytes, 7);
  const std::string channel = "PUCK_EVENTS";
  std::vector<std::uint8_t> message;
  std::string problem;
  for (auto _ : state) {
    message = plain;
    sealer.seal(channel, message);
    if (!opener.open(channel, message, problem)) std::abort();
  }
  state.SetItemsProcessed(state.iterations() * ((packet_bytes - kOtherBytes) / 4));
}

[[maybe_unused]] const bool registered = [] {
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("packet_seal/ours", packet_seal, EventPackerParams::kMaxBytes);
  RegisterBenchmark("packet_seal_frame/ours", packet_seal, EventPackerParams::kOneFrame);
  return true;
}();

}  // namespace
}  // namespace puck
