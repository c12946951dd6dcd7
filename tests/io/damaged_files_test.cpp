// Files of our own simulator's events, written by other people's encoders, whole and damaged.
#include <algorithm>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "tests/io/digest.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"

namespace puck {
namespace {

constexpr const char* kAllEvents =
    "63bb155db62ec1cd8ffe4b5791f6b2bcc867ee0889f574f0c6efcdceea15f7b7";

struct Encoded {
  const char* file = nullptr;
  const char* encoder = nullptr;
  std::int64_t events = 0;
  const char* sha256 = nullptr;  ///< Of what was given to the encoder; as EventDigest.
};

const std::vector<Encoded> kEncoded{
    {"evt2.raw", "faery 0.7.1", 700, kAllEvents},
    {"evt3.raw", "faery 0.7.1", 700, kAllEvents},
    {"dat2.dat", "faery 0.7.1", 700, kAllEvents},
    {"dvs.es", "faery 0.7.1", 700, kAllEvents},
    {"dat1.dat", "faery 0.7.1", 222,
     "157be4073eece54e9299485d84a050d0d3481c5dea07de8034e1058cab584119"},
    {"events.csv", "faery 0.7.1", 300,
     "e862012bd903bfcf4c0c3f40544d45a86ae71568d3c0b144f5ca9f72d7d1ef62"},
    {"savetxt.txt", "numpy 2.4.6", 50,
     "b23c17950aef3914362a76ed30bbc0d3a20a5fb524d9d3083f73ab8312b27c14"},
};

std::string encoded_content(const char* file) {
  return read_text(source_folder() / "tests" / "io" / "data" / file);
}

TEST_CASE("files of other people's encoders give the events that they were given") {
  for (const Encoded& encoded : kEncoded) {
    CAPTURE(encoded.file);
    CAPTURE(encoded.encoder);
    const auto reader = open_event_file(source_folder() / "tests" / "io" / "data" / encoded.file);
    CHECK(digest_of(*reader) == EventDigest{encoded.events, encoded.sha256});
  }
}

// What a file gave before it ended or was refused.
struct Outcome {
  std::vector<PlainEvent> events;
  SensorSize sensor;
  std::string message;  // The error, or all warnings.
};

Outcome outcome_of(const TemporaryFolder& folder, const std::string& content) {
  Outcome outcome;
  try {
    const auto reader = open_event_file(folder.write("damaged", content), {.sensor = {}});
    outcome.sensor = reader->sensor_size();
    EventPacket packet;
    while (reader->read(packet, 100)) append_plain(packet, outcome.events);
    for (const std::string& warning : reader->warnings()) outcome.message += warning + "\n";
  } catch (const EventFileError& error) {
    outcome.message += error.what();
  }
  return outcome;
}

bool is_beginning(const std::vector<PlainEvent>& part, const std::vector<PlainEvent>& whole) {
  return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

TEST_CASE("a file that is cut anywhere keeps its whole events, and says where it ends") {
  const TemporaryFolder folder;
  for (const Encoded& encoded : kEncoded) {
    CAPTURE(encoded.file);
    const std::string content = encoded_content(encoded.file).substr(0, 1200);
    const Outcome whole = outcome_of(folder, content);
    REQUIRE(whole.events.size() > 10);
    std::size_t most = 0;
    for (std::size_t length = 0; length < content.size(); ++length) {
      CAPTURE(length);
      const Outcome cut = outcome_of(folder, content.substr(0, length));
      REQUIRE(is_beginning(cut.events, whole.events));
      // The last line of a text may be an event or not, as its last number is cut.
      REQUIRE(cut.events.size() + 1 >= most);
      most = std::max(most, cut.events.size());
      if (cut.events.empty()) REQUIRE_FALSE(cut.message.empty());
      if (contains(cut.message, "cut off")) REQUIRE(contains(cut.message, " at byte "));
    }
    CHECK(most + 2 >= whole.events.size());
  }
}

TEST_CASE("a header line that is missing or doubled is named where it matters") {
  const TemporaryFolder folder;
  for (const char* file : {"evt2.raw", "evt3.raw", "dat1.dat", "dat2.dat", "events.csv"}) {
    CAPTURE(file);
    const std::string content = encoded_content(file);
    const Outcome whole = outcome_of(folder, content);
    std::size_t line = 0;
    while (content[line] == '%' || content[line] == 't') {
      CAPTURE(line);
      const std::size_t next = content.find('\n', line) + 1;
      const Outcome missing = outcome_of(folder, content.substr(0, line) + content.substr(next));
      if (missing.message.empty()) {
        CHECK(missing.events == whole.events);
        CHECK(missing.sensor == whole.sensor);
      }
      const Outcome doubled = outcome_of(folder, content.substr(0, next) + content.substr(line));
      // An end that stands twice leaves data that begin with it.
      CHECK_FALSE(doubled.message.empty());
      CHECK((contains(doubled.message, "line ") || contains(doubled.message, "byte ")));
      line = next;
    }
    CHECK(line > 0);
  }
}

TEST_CASE("joined files are read as two parts, and the second header's place is named") {
  const TemporaryFolder folder;
  for (const char* file : {"evt2.raw", "evt3.raw", "dat2.dat", "dvs.es", "events.csv"}) {
    CAPTURE(file);
    const std::string content = encoded_content(file);
    const Outcome once = outcome_of(folder, content);
    for (const std::string& joined : {content + content, content + content + content}) {
      const Outcome twice = outcome_of(folder, joined);
      REQUIRE(twice.events.size() == joined.size() / content.size() * once.events.size());
      CHECK(contains(twice.message, "another header at byte " + std::to_string(content.size())));
      CHECK(contains(twice.message, "are shifted by "));
      for (std::size_t i = 0; i < twice.events.size(); ++i) {
        const PlainEvent& original = once.events[i % once.events.size()];
        REQUIRE(twice.events[i].x == original.x);
        REQUIRE(twice.events[i].y == original.y);
        if (i > 0) REQUIRE(twice.events[i].t_us >= twice.events[i - 1].t_us);
      }
    }
  }
}

TEST_CASE("of a file of very many parts only the first are named") {
  const TemporaryFolder folder;
  const std::string content = encoded_content("evt2.raw");
  std::string joined;
  constexpr std::size_t kParts = 300;
  for (std::size_t i = 0; i < kParts; ++i) joined += content;
  const Outcome outcome = outcome_of(folder, joined);
  CHECK(outcome.events.size() == kParts * outcome_of(folder, content).events.size());
  CHECK(contains(outcome.message, "another header at byte " + std::to_string(content.size())));
  CHECK(contains(outcome.message, "more headers and shifts like these"));
  CHECK(outcome.message.size() < 10'000);
}

TEST_CASE("words in the wrong order or from an odd byte on are refused with their share") {
  const TemporaryFolder folder;
  for (const char* file : {"evt2.raw", "evt3.raw"}) {
    CAPTURE(file);
    const std::string content = encoded_content(file);
    const std::size_t header = content.rfind("\n% ");
    const std::size_t data = content.find('\n', header + 1) + 1;
    CHECK(contains(outcome_of(folder, content.substr(0, data) + content.substr(data + 1)).message,
                   "words are of no type that EVT"));
    std::string swapped = content;
    const std::size_t word = std::string_view(file) == "evt2.raw" ? 4 : 2;
    for (std::size_t i = data; i + word <= swapped.size(); i += word) {
      std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(i),
                   swapped.begin() + static_cast<std::ptrdiff_t>(i + word));
    }
    CHECK(contains(outcome_of(folder, swapped).message, "words are of no type that EVT"));
  }
}

TEST_CASE(
    "an event file is read from a pipe, and needs the sensor's size where its header lacks it") {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  const auto read_pipe = [&](const std::string& content, const EventFileOptions& options) {
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::jthread writer([&] { write_text(pipe, content); });
    const auto reader = open_event_file(pipe, options);
    const std::vector<PlainEvent> events = read_all(*reader);
    writer.join();
    std::filesystem::remove(pipe);
    return events;
  };
  for (const char* file : {"evt3.raw", "events.csv", "dvs.es"}) {
    const std::string content = encoded_content(file);
    CHECK(read_pipe(content, {}) == outcome_of(folder, content).events);
  }
  const std::string text = "1 2 3 1\n2 3 4 0\n";
  CHECK(read_pipe(text, {.sensor = {10, 10}}).size() == 2);
  CHECK(read_pipe(text, {.fallback_sensor = {10, 10}}).size() == 2);
  CHECK_THROWS_AS(read_pipe(text, {}), SensorUnknownError);
}

}  // namespace
}  // namespace puck
