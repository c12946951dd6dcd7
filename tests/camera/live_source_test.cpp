#include "services/camera/live_source.h"

#include <array>
#include <atomic>
#include <deque>
#include <stdexcept>

#include <doctest/doctest.h>
#include <unistd.h>

#include "common/io/event_reader.h"
#include "services/camera/publish_limit.h"
#include "services/camera/stream_source.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

/// Plays a script, then the end or a failure. `done` becomes true on the call after the script.
class ScriptedSource final : public EventSource {
 public:
  ScriptedSource(std::deque<Chunk> script, bool fails, std::atomic<bool>& done)
      : script_(std::move(script)), fails_(fails), done_(done) {}

  Outcome next(Chunk& chunk) override {
    if (script_.empty()) {
      done_ = true;
      if (fails_) throw EventFileError("the cable is out");
      return Outcome::kEnd;
    }
    chunk = script_.front();
    script_.pop_front();
    return Outcome::kEvents;
  }
  std::optional<SensorSize> sensor_size() const override { return SensorSize{64, 48}; }
  std::int64_t events_dropped() const override { return 3; }
  std::vector<std::string> warnings() const override { return {"all is well"}; }

 private:
  std::deque<Chunk> script_;
  bool fails_;
  std::atomic<bool>& done_;
};

/// Chunks of so many events each, one event a µs.
std::deque<EventSource::Chunk> chunks_of(std::size_t events, int count) {
  std::deque<EventSource::Chunk> chunks(static_cast<std::size_t>(count));
  std::int64_t time_us = 1000;
  for (EventSource::Chunk& chunk : chunks) {
    chunk.packet.start = {time_us};
    for (std::size_t i = 0; i < events; ++i) {
      chunk.packet.events.push_back({.x = 1, .offset_us = static_cast<std::uint32_t>(i)});
    }
    chunk.until = chunk.packet.newest();
    time_us += static_cast<std::int64_t>(events);
  }
  chunks.front().new_clock = true;
  return chunks;
}

class Live {
 public:
  Live(std::deque<EventSource::Chunk> script, std::size_t most_chunks, bool fails = false)
      : source_(std::make_unique<ScriptedSource>(std::move(script), fails, done_), most_chunks) {
    while (!done_) std::this_thread::yield();
  }

  std::vector<EventSource::Chunk> take_all() {
    std::vector<EventSource::Chunk> taken;
    EventSource::Chunk chunk;
    while (true) {
      const auto outcome = source_.next(chunk);
      if (outcome == EventSource::Outcome::kEnd) return taken;
      if (outcome == EventSource::Outcome::kEvents) taken.push_back(chunk);
    }
  }

  std::atomic<bool> done_{false};
  LiveSource source_;
};

TEST_CASE("a live source delivers everything if fetched in time, and joins small pieces") {
  Live live(chunks_of(100, 200), 4);
  const auto taken = live.take_all();
  REQUIRE(taken.size() == 3);  // 81 pieces of 100 events fit into 8192.
  std::vector<SeenEvent> events;
  for (const EventSource::Chunk& chunk : taken) {
    append_seen(chunk.packet, events);
    CHECK(chunk.until == chunk.packet.newest());
    CHECK(chunk.came_utime > 0);
  }
  REQUIRE(events.size() == 20000);
  for (std::size_t i = 0; i < events.size(); ++i) {
    REQUIRE(events[i].t_us == 1000 + static_cast<std::int64_t>(i));
  }
  CHECK(live.source_.events_overflowed() == 0);
  CHECK(live.source_.events_dropped() == 3);
  CHECK(live.source_.sensor_size() == SensorSize{64, 48});
  CHECK(live.source_.warnings() == std::vector<std::string>{"all is well"});
}

TEST_CASE("without fetching, a live source keeps the newest chunks and counts the dropped ones") {
  Live live(chunks_of(8000, 10), 3);
  const auto taken = live.take_all();
  REQUIRE(taken.size() == 3);
  CHECK(taken.front().packet.start.us == 1000 + 7 * 8000);
  CHECK(taken.back().packet.newest().us == 1000 + 10 * 8000 - 1);
  CHECK(live.source_.events_overflowed() == 7 * 8000);
  CHECK(live.source_.events_dropped() == 7 * 8000 + 3);
}

TEST_CASE("a new clock is reported even if its first events were dropped") {
  Live live(chunks_of(8000, 10), 3);
  const auto taken = live.take_all();
  REQUIRE(taken.size() == 3);
  CHECK(taken[0].new_clock);
  CHECK_FALSE(taken[1].new_clock);
}

TEST_CASE("a live source's exception follows all of its earlier events") {
  Live live(chunks_of(8000, 2), 3, true);
  EventSource::Chunk chunk;
  CHECK(live.source_.next(chunk) == EventSource::Outcome::kEvents);
  CHECK(live.source_.next(chunk) == EventSource::Outcome::kEvents);
  CHECK_THROWS_WITH_AS(live.source_.next(chunk), "the cable is out", EventFileError);
}

TEST_CASE("a pipe without fetching never blocks, and its newest events stay available") {
  constexpr int kEvents = 500'000;
  constexpr std::size_t kChunks = 4;
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(kEvents, 0, 1));
  const std::string bytes = read_text(folder / "a.raw");
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  class PipeSource final : public EventSource {
   public:
    explicit PipeSource(int descriptor) : events_(descriptor, "pipe", {}) {}
    Outcome next(Chunk& chunk) override {
      const auto outcome = events_.next(chunk.packet);
      if (outcome == DescriptorEvents::Outcome::kEnd) return Outcome::kEnd;
      if (outcome == DescriptorEvents::Outcome::kNothingYet) return Outcome::kNothingYet;
      chunk.until = chunk.packet.newest();
      return Outcome::kEvents;
    }
    std::optional<SensorSize> sensor_size() const override {
      return events_.stream().sensor_size();
    }

   private:
    DescriptorEvents events_;
  };
  LiveSource live(std::make_unique<PipeSource>(ends[0]), kChunks);
  // A write without a reader would block for ever.
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = write(ends[1], bytes.data() + written, bytes.size() - written);
    REQUIRE(count > 0);
    written += static_cast<std::size_t>(count);
  }
  close(ends[1]);

  std::vector<SeenEvent> events;
  EventSource::Chunk chunk;
  // The last bytes may still be in the pipe: together more than the queue held.
  for (auto outcome = live.next(chunk); outcome != EventSource::Outcome::kEnd;
       outcome = live.next(chunk)) {
    if (outcome == EventSource::Outcome::kEvents) append_seen(chunk.packet, events);
  }
  close(ends[0]);
  CHECK(events.back().t_us == kEvents - 1);
  CHECK(static_cast<std::int64_t>(events.size()) + live.events_dropped() == kEvents);
  CHECK(events.size() < kEvents / 2);
}

TEST_CASE("a limit allows a mean rate, and a burst of at most a millisecond") {
  using Clock = PublishLimit::Clock;
  PublishLimit limit(2);
  const Clock::time_point start{std::chrono::seconds(100)};
  CHECK(limit.due() <= start);
  // 2000 events at 2 Mev/s take 1 ms, which is the longest burst.
  limit.count(2000, start);
  CHECK(limit.due() == start);
  limit.count(2000, start);
  CHECK(limit.due() == start + std::chrono::milliseconds(1));
  // 0.3 ms too late: the next is due as if it had been in time.
  limit.count(2000, start + std::chrono::microseconds(1300));
  CHECK(limit.due() == start + std::chrono::milliseconds(2));

  PublishLimit none(0);
  none.count(1'000'000'000, start);
  CHECK(none.due() <= start);
}

}  // namespace
}  // namespace puck
