// Places in a recording, sought in its source alone.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "services/camera/file_source.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

using Outcome = EventSource::Outcome;

/// Reads until there are events, or there is no more.
Outcome next_events(FileSource& source, EventSource::Chunk& chunk) {
  Outcome outcome = Outcome::kNothingYet;
  while (outcome == Outcome::kNothingYet) outcome = source.next(chunk);
  return outcome;
}

std::int64_t first_time_us(const EventSource::Chunk& chunk) {
  return chunk.packet.time_of(chunk.packet.events.front()).us;
}

/// A recording of 2 s that comes through a pipe.
class PipedRecording {
 public:
  explicit PipedRecording(const CameraFolder& folder) : path_(folder / "pipe.raw") {
    write_recording(folder / "a.raw", even_events(40'000, 1'000'000, 50));
    if (mkfifo(path_.c_str(), 0600) != 0) throw std::runtime_error("no pipe");
    sender_ = std::jthread([bytes = read_text(folder / "a.raw"), path = path_] {
      std::ofstream(path, std::ios::binary) << bytes;
    });
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::jthread sender_;
};

TEST_CASE("any place in a recording is found, forwards and backwards, to the event") {
  const CameraFolder folder;
  // 100,000 events: more than ten chunks.
  write_recording(folder / "a.raw", even_events(100'000, 3'000'000, 50));
  FileSource source({.file = folder / "a.raw"});
  EventSource::Chunk chunk;
  CHECK(source.seek(0) == ControlVerdict::kNotBegun);
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK_FALSE(chunk.session_from);
  for (const std::int64_t place_us : {2'000'010, 100, 4'999'950, 4'990'000, 300'000, 350'000, 0}) {
    CAPTURE(place_us);
    REQUIRE(source.seek(place_us) == ControlVerdict::kSearching);
    REQUIRE(next_events(source, chunk) == Outcome::kEvents);
    REQUIRE(chunk.session_from == Timestamp{3'000'000 + place_us});
    CHECK(first_time_us(chunk) == 3'000'000 + (place_us + 49) / 50 * 50);
    CHECK(source.position_us(*chunk.session_from) == place_us);
  }
  // All that follows is there.
  std::int64_t events = std::ssize(chunk.packet.events);
  while (next_events(source, chunk) == Outcome::kEvents) events += std::ssize(chunk.packet.events);
  CHECK(events == 100'000);
  CHECK(source.seek(4'999'951) == ControlVerdict::kBeyondEnd);  // Known by now.
}

TEST_CASE("a search for a place beyond the end leaves the source where it was") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(100'000, 0, 50));
  FileSource source({.file = folder / "a.raw"});
  EventSource::Chunk chunk;
  std::vector<SeenEvent> events;
  for (int i = 0; i < 3; ++i) {
    REQUIRE(next_events(source, chunk) == Outcome::kEvents);
    append_seen(chunk.packet, events);
  }
  REQUIRE(source.seek(60'000'000) == ControlVerdict::kSearching);
  EventSource::Chunk sought;
  CHECK(next_events(source, sought) == Outcome::kNotFound);
  CHECK(source.seek(60'000'000) == ControlVerdict::kBeyondEnd);
  while (next_events(source, chunk) == Outcome::kEvents) {
    CHECK_FALSE(chunk.session_from);
    append_seen(chunk.packet, events);
  }
  CHECK(events == even_events(100'000, 0, 50));
}

TEST_CASE("a search may be changed while it goes on") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(100'000, 0, 50));
  FileSource source({.file = folder / "a.raw"});
  EventSource::Chunk chunk;
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  REQUIRE(source.seek(4'000'000) == ControlVerdict::kSearching);
  CHECK(source.next(chunk) == Outcome::kNothingYet);
  REQUIRE(source.seek(1'000'000) == ControlVerdict::kSearching);
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK(first_time_us(chunk) == 1'000'000);
}

TEST_CASE("a looped and stretched recording has the positions that were recorded") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(10'001, 1000, 100));  // 1 s at 10 kev/s.
  FileSource source({.file = folder / "a.raw", .loop = true, .rate_mev_s = 0.02});
  EventSource::Chunk chunk;
  for (int i = 0; i < 3; ++i) REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  // In the second round of half a second.
  CHECK(chunk.until.us > 500'000);
  CHECK(source.position_us(chunk.until) < 1'000'000);
  CHECK(source.seek(1'000'100) == ControlVerdict::kBeyondEnd);
  REQUIRE(source.seek(600'000) == ControlVerdict::kSearching);
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK(first_time_us(chunk) == doctest::Approx(301'000).epsilon(0.001));
  CHECK(source.position_us(chunk.packet.start) == doctest::Approx(600'000).epsilon(0.001));
}

TEST_CASE("a place outside the played part is not found; one before it is its beginning") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(100'000, 0, 50));
  FileSource source({.file = folder / "a.raw", .start_us = 1'000'000, .length_us = 2'000'000});
  EventSource::Chunk chunk;
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK(first_time_us(chunk) == 1'000'000);
  CHECK(source.position_us(chunk.packet.start) == 1'000'000);
  CHECK(source.seek(3'000'000) == ControlVerdict::kBeyondEnd);
  REQUIRE(source.seek(2'999'900) == ControlVerdict::kSearching);
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK(chunk.packet.events.size() == 2);
  CHECK(next_events(source, chunk) == Outcome::kEnd);
  REQUIRE(source.seek(0) == ControlVerdict::kSearching);
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK(first_time_us(chunk) == 1'000'000);
}

TEST_CASE("a recording from a pipe goes on, but not back") {
  const CameraFolder folder;
  const PipedRecording pipe(folder);
  FileSource source({.file = pipe.path()});
  EventSource::Chunk chunk;
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  REQUIRE(source.seek(1'500'000) == ControlVerdict::kSearching);
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK(first_time_us(chunk) == 2'500'000);
  std::filesystem::remove(pipe.path());
  CHECK(source.seek(0) == ControlVerdict::kReadOnlyOnce);
  // Within what was read last it can.
  REQUIRE(source.seek(1'490'000) == ControlVerdict::kSearching);
  REQUIRE(next_events(source, chunk) == Outcome::kEvents);
  CHECK(first_time_us(chunk) == 2'490'000);
  std::int64_t events = std::ssize(chunk.packet.events);
  while (next_events(source, chunk) == Outcome::kEvents) events += std::ssize(chunk.packet.events);
  CHECK(events == 40'000 - 1'490'000 / 50);
}

}  // namespace
}  // namespace puck
