// Speed of the decoders, each beside the straightforward form of the same work.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/io/event_stream.h"
#include "common/io/evt3_writer.h"
#include "common/io/raw_header.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/message_codec.h"
#include "tests/bench/bench_streams.h"
#include "tests/bench/encoded_streams.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

// As many events as the camera service requests at once.
constexpr std::size_t kChunkEvents = 8192;

std::vector<std::byte> content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Events of outlines that move over a sensor, about 10 a µs, with some noise.
EventPacket moving_outlines(SensorSize sensor, std::size_t count) {
  std::mt19937 random(1);
  EventPacket packet;
  packet.events.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Event& event = packet.events[i];
    const bool is_noise = random() % 8 == 0;
    const auto width = static_cast<std::uint32_t>(sensor.width);
    const auto height = static_cast<std::uint32_t>(sensor.height);
    const std::uint32_t edge = static_cast<std::uint32_t>(i / 500 % 7) * (width / 8);
    event.x = static_cast<std::uint16_t>(is_noise ? random() % width : edge + random() % 20);
    event.y = static_cast<std::uint16_t>(random() % height) & 0x7fff;
    event.polarity = random() & 1U;
    event.offset_us = static_cast<std::uint32_t>(i / 10);
  }
  return packet;
}

/// The recording; without it, a generated file.
std::vector<std::byte> evt3_bytes(benchmark::State& state) {
  if (is_there(BenchStream::kDriving)) {
    state.SetLabel("the driving recording");
    return content_of(bench_recordings() / "driving_gen41_1280x720_evt3.raw");
  }
  state.SetLabel("made events, for the driving recording is absent");
  const TemporaryFolder folder;
  Evt3Writer writer(folder / "made.raw", {1280, 720});
  writer.write(moving_outlines({1280, 720}, 300'000));
  writer.close();
  return content_of(folder / "made.raw");
}

void decode_stream(benchmark::State& state, const std::vector<std::byte>& bytes) {
  EventPacket packet;
  std::int64_t events = 0;
  for (auto _ : state) {
    EventStream stream("benchmark", {});
    std::span<const std::byte> rest = bytes;
    while (!rest.empty() || stream.has_backlog()) {
      packet.events.clear();
      rest = rest.subspan(stream.decode(rest, packet, kChunkEvents));
      benchmark::DoNotOptimize(packet.events.data());
    }
    events += stream.counters().events;
  }
  state.SetItemsProcessed(events);
}

/// Made events in a format, as a file of it holds them.
void made_stream(benchmark::State& state, const char* format) {
  constexpr SensorSize kDavis346{346, 260};
  decode_stream(state, encoded_stream(format, moving_outlines(kDavis346, 1'000'000), kDavis346));
}

void evt3_ours(benchmark::State& state) { decode_stream(state, evt3_bytes(state)); }

void evt2_ours(benchmark::State& state) {
  decode_stream(state, content_of(bench_recordings() / "sparklers_gen31_640x480_evt2.raw"));
}

/// The format's plain description: no checks, no division, no time beyond its wrap.
void plain_evt3(std::span<const std::byte> bytes, std::vector<Event>& events) {
  std::uint32_t high = 0;
  std::uint32_t low = 0;
  Event event;
  std::uint32_t base = 0;
  bool base_polarity = false;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint16_t word = 0;
    std::memcpy(&word, bytes.data() + i, 2);
    const std::uint32_t low11 = word & 0x7ffU;
    switch (word >> 12) {
      case 0x0:
        event.y = low11 & 0x7fff;
        break;
      case 0x2:
        event.x = static_cast<std::uint16_t>(low11);
        event.polarity = word >> 11 & 1U;
        event.offset_us = high << 12 | low;
        events.push_back(event);
        break;
      case 0x3:
        base = low11;
        base_polarity = (word >> 11 & 1U) != 0;
        break;
      case 0x4:
      case 0x5: {
        const std::uint32_t width = word >> 12 == 0x4 ? 12 : 8;
        for (std::uint32_t x = 0; x < width; ++x) {
          if ((word >> x & 1U) == 0) continue;
          event.x = static_cast<std::uint16_t>(base + x);
          event.polarity = base_polarity ? 1 : 0;
          event.offset_us = high << 12 | low;
          events.push_back(event);
        }
        base += width;
        break;
      }
      case 0x6:
        low = word & 0xfffU;
        break;
      case 0x8:
        high = word & 0xfffU;
        break;
      default:
        break;
    }
  }
}

void evt3_plain(benchmark::State& state) {
  const auto bytes = evt3_bytes(state);
  const auto header = parse_raw_header(bytes, true);
  std::vector<Event> events;
  std::int64_t count = 0;
  for (auto _ : state) {
    events.clear();
    plain_evt3(std::span(bytes).subspan(header->length), events);
    benchmark::DoNotOptimize(events.data());
    count += static_cast<std::int64_t>(events.size());
  }
  state.SetItemsProcessed(count);
}

/// Encoded packets of a stream.
std::vector<std::vector<std::uint8_t>> packets_of(const EventPacket& events, SensorSize sensor,
                                                  int packet_bytes) {
  std::vector<std::vector<std::uint8_t>> packets;
  EventPacker packer({.sensor = sensor, .packet_bytes = packet_bytes});
  packer.pack(events.start, events.events, [&](event_packet_t& packet) {
    packet.session = 1;
    encode(packet, packets.emplace_back());
  });
  return packets;
}

constexpr SensorSize kSensor{640, 480};
constexpr std::size_t kPackedEvents = 150'000;

/// From received bytes to events, as in bus and tracker: check, view, unpack.
void packet_decode_ours(benchmark::State& state, int packet_bytes) {
  const auto packets = packets_of(moving_outlines(kSensor, kPackedEvents), kSensor, packet_bytes);
  EventPacket events;
  std::int64_t count = 0;
  for (auto _ : state) {
    for (const auto& bytes : packets) {
      if (check_message(Channel::kEvents, bytes)) std::abort();
      EventPacketView packet;
      decode_checked(bytes, packet);
      unpack(packet, events);
      benchmark::DoNotOptimize(events.events.data());
      count += static_cast<std::int64_t>(events.events.size());
    }
  }
  state.SetItemsProcessed(count);
}

/// The same without a single check, an event at a time.
void packet_decode_plain(benchmark::State& state, int packet_bytes) {
  const auto packets = packets_of(moving_outlines(kSensor, kPackedEvents), kSensor, packet_bytes);
  EventPacket events;
  std::int64_t count = 0;
  for (auto _ : state) {
    for (const auto& bytes : packets) {
      event_packet_t packet{};
      packet.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
      events.events.clear();
      events.start = {packet.first_event_us};
      for (std::size_t i = 0; i < static_cast<std::size_t>(packet.count); ++i) {
        std::uint32_t word = 0;
        std::memcpy(&word, packet.data.data() + 4 * i, 4);
        Event event;
        event.x = static_cast<std::uint16_t>(word >> 22);
        event.y = word >> 13 & 0x1ffU;
        event.polarity = word >> 12 & 1U;
        event.offset_us = word & 0xfffU;
        events.events.push_back(event);
      }
      benchmark::DoNotOptimize(events.events.data());
      count += packet.count;
    }
  }
  state.SetItemsProcessed(count);
}

void packet_encode_ours(benchmark::State& state, int packet_bytes) {
  const EventPacket events = moving_outlines(kSensor, kPackedEvents);
  EventPacker packer({.sensor = kSensor, .packet_bytes = packet_bytes});
  std::vector<std::uint8_t> bytes;
  for (auto _ : state) {
    packer.pack(events.start, events.events, [&](event_packet_t& packet) {
      packet.session = 1;
      encode(packet, bytes);
      benchmark::DoNotOptimize(bytes.data());
    });
  }
  state.SetItemsProcessed(packer.events_packed());
}

[[maybe_unused]] const bool registered = [] {
  using benchmark::RegisterBenchmark;
  constexpr int kLarge = EventPackerParams::kMaxBytes;
  constexpr int kFrame = EventPackerParams::kOneFrame;
  RegisterBenchmark("evt3_decode/ours", evt3_ours);
  RegisterBenchmark("evt3_decode/plain", evt3_plain);
  if (is_there(BenchStream::kSparklers)) RegisterBenchmark("evt2_decode/ours", evt2_ours);
  for (const char* format : {"evt2", "evt21", "evt4", "dat", "es", "aedat2", "text"}) {
    RegisterBenchmark((std::string(format) + "_decode/made").c_str(), made_stream, format);
  }
  RegisterBenchmark("packet_decode/ours", packet_decode_ours, kLarge);
  RegisterBenchmark("packet_decode/plain", packet_decode_plain, kLarge);
  RegisterBenchmark("packet_decode_frame/ours", packet_decode_ours, kFrame);
  RegisterBenchmark("packet_encode/ours", packet_encode_ours, kLarge);
  RegisterBenchmark("packet_encode_frame/ours", packet_encode_ours, kFrame);
  return true;
}();

}  // namespace
}  // namespace puck
