// A camera's bytes from stdin or TCP: their division must make no difference.
#include <fuzzer/FuzzedDataProvider.h>

#include "common/io/event_stream.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

struct Outcome {
  EventPacket events;  // all, with full times
  std::vector<std::int64_t> times_us;
  EventCounters counters;
  std::string refusal;
};

/// `next_size()`: the size of the next piece, and then that of the next packet, at most.
template <typename NextSize>
Outcome decode_all(std::span<const std::byte> bytes, const EventFileOptions& options,
                   NextSize next_size) {
  Outcome outcome;
  EventStream stream("stream", options);
  EventPacket packet;
  const auto keep = [&] {
    for (const Event& event : packet.events) {
      outcome.events.events.push_back(event);
      outcome.events.events.back().offset_us = 0;
      outcome.times_us.push_back(packet.time_of(event).us);
    }
    packet.events.clear();
  };
  const auto feed = [&](std::span<const std::byte> piece) {
    do {
      const std::size_t used = stream.decode(piece, packet, next_size());
      require(used <= piece.size(), "no more bytes are used than there are");
      require(used > 0 || !packet.empty() || piece.empty() || stream.has_backlog(),
              "decoding goes on");
      piece = piece.subspan(used);
      keep();
    } while (!piece.empty() || stream.has_backlog());
  };
  try {
    while (!bytes.empty()) {
      const std::size_t length = std::min(next_size(), bytes.size());
      feed(bytes.first(length));
      bytes = bytes.subspan(length);
    }
    stream.finish();
    feed({});
  } catch (const EventFileError& error) {
    keep();
    outcome.refusal = error.what();
    require_one_line(outcome.refusal);
  }
  outcome.counters = stream.counters();
  return outcome;
}

EventFileOptions options_of(FuzzedDataProvider& input) {
  EventFileOptions options;
  options.from = input.PickValueInArray({"", "evt2", "evt21", "evt3", "evt4", "text"});
  if (input.ConsumeBool()) options.sensor = {640, 480};
  if (input.ConsumeBool()) options.reorder_us = 0;
  return options;
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  const puck::EventFileOptions options = puck::options_of(input);
  const auto pieces = input.ConsumeBytes<std::uint8_t>(input.ConsumeIntegralInRange(0, 16));
  const auto bytes = input.ConsumeRemainingBytes<std::uint8_t>();
  const auto whole = std::as_bytes(std::span(bytes));

  std::size_t at = 0;
  const auto cut = puck::decode_all(whole, options, [&]() -> std::size_t {
    return pieces.empty() ? 1 : 1U + pieces[at++ % pieces.size()];
  });
  const auto uncut = puck::decode_all(whole, options, [] { return std::size_t{1} << 20; });
  puck::require(cut.refusal == uncut.refusal, "refused or not, wherever the bytes are cut");
  puck::require(cut.events.events == uncut.events.events && cut.times_us == uncut.times_us,
                "the events do not depend on where the bytes are cut");
  puck::require(cut.counters == uncut.counters, "nor do the counters");
  return 0;
}
