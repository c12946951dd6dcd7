#include "common/messaging/log_file.h"

#include <fstream>
#include <functional>
#include <random>

#include <doctest/doctest.h>
#include <lcm/eventlog.h>
#include <unistd.h>

#include "common/messaging/message_codec.h"

namespace puck {
namespace {

/// A path in a folder that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("puck_log_" + std::to_string(getpid()) + "_" +
               std::to_string(std::random_device{}()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Ten messages of 100 bytes each on channel PUCK_A: 134 bytes a record.
void write_ten(const std::filesystem::path& path) {
  LogWriter writer(path);
  for (int i = 0; i < 10; ++i) {
    writer.write("PUCK_A", 1000 + i, std::vector<std::uint8_t>(100, static_cast<std::uint8_t>(i)));
  }
  writer.flush();
  CHECK(writer.messages() == 10);
  CHECK(writer.bytes() == static_cast<std::int64_t>(std::filesystem::file_size(path)));
}

std::vector<std::int64_t> times_in(LogReader& reader) {
  std::vector<std::int64_t> times;
  LogRecord record;
  while (reader.next(record)) times.push_back(record.utime);
  return times;
}

std::string problem_of(const std::function<void()>& call) {
  try {
    call();
    return {};
  } catch (const LogFileError& error) {
    return error.what();
  }
}

void overwrite_bytes(const std::filesystem::path& path, long offset, const std::string& bytes) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(offset);
  file << bytes;
}

constexpr int kRecordBytes = 28 + 6 + 100;

}  // namespace

TEST_CASE("what is written is read again, and by LCM's own reader too") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  write_ten(path);
  CHECK(std::filesystem::file_size(path) == 10 * kRecordBytes);

  LogReader reader(path);
  LogRecord record;
  for (int i = 0; i < 10; ++i) {
    REQUIRE(reader.next(record));
    CHECK(record.number == i);
    CHECK(record.utime == 1000 + i);
    CHECK(record.channel == "PUCK_A");
    CHECK(record.bytes == std::vector<std::uint8_t>(100, static_cast<std::uint8_t>(i)));
  }
  CHECK_FALSE(reader.next(record));
  CHECK_FALSE(reader.damage().has_value());
  CHECK(reader.bytes_skipped() == 0);

  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "r");
  int count = 0;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    CHECK(std::string(event->channel) == "PUCK_A");
    lcm_eventlog_free_event(event);
    ++count;
  }
  lcm_eventlog_destroy(log);
  CHECK(count == 10);
}

TEST_CASE("a typed message goes into a log and out again") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  head_state_t head{};
  head.session = 5;
  head.yaw_deg = 1.5;
  std::vector<std::uint8_t> bytes;
  encode(head, bytes);
  { LogWriter(path).write("PUCK_HEAD", 1, bytes); }
  LogReader reader(path);
  LogRecord record;
  REQUIRE(reader.next(record));
  head_state_t again{};
  CHECK(decode(record.bytes, again) == std::nullopt);
  CHECK(again.yaw_deg == 1.5);
}

TEST_CASE("an existing log is not overwritten unless that is asked for") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  write_ten(path);
  CHECK(problem_of([&] { LogWriter writer(path); }) ==
        path.string() + ": exists already and is not overwritten");
  CHECK(std::filesystem::file_size(path) == 10 * kRecordBytes);
  { LogWriter writer(path, true); }
  CHECK(std::filesystem::file_size(path) == 0);
  CHECK(problem_of([&] { LogWriter writer(folder / "none/a.lcm"); }) ==
        (folder / "none/a.lcm").string() + ": cannot be written: No such file or directory");
}

TEST_CASE("a log cut off anywhere gives its whole messages and says that it ends within one") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  write_ten(path);
  for (int cut = 1; cut < kRecordBytes; ++cut) {
    std::filesystem::resize_file(path, static_cast<std::uintmax_t>(10 * kRecordBytes - cut));
    LogReader reader(path);
    REQUIRE(times_in(reader).size() == 9);
    REQUIRE(reader.damage() == "the log ends within a message at byte 1206");
    REQUIRE(reader.bytes_skipped() == kRecordBytes - cut);
  }
}

TEST_CASE("damage in the middle of a log costs what it hits") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  write_ten(path);
  overwrite_bytes(path, 3 * kRecordBytes, "XXXX");
  overwrite_bytes(path, 6 * kRecordBytes + 24, "\xff\xff\xff\xff");
  LogReader reader(path);
  CHECK(times_in(reader) ==
        std::vector<std::int64_t>{1000, 1001, 1002, 1004, 1005, 1007, 1008, 1009});
  CHECK(reader.damage() == "no message begins at byte 402");
  CHECK(reader.bytes_skipped() == 2 * kRecordBytes);
}

TEST_CASE("a length beyond the end of the log costs that message only") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  write_ten(path);
  overwrite_bytes(path, 5 * kRecordBytes + 24, std::string("\x0f\xff\xff\xff", 4));
  LogReader reader(path);
  CHECK(times_in(reader).size() == 9);
  CHECK(reader.bytes_skipped() == kRecordBytes);
}

TEST_CASE("logs with flipped bytes neither crash the reader nor keep it for ever") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  std::mt19937 random(9);
  for (int round = 0; round < 200; ++round) {
    { LogWriter writer(path, true); }
    std::filesystem::remove(path);
    write_ten(path);
    for (int i = 0; i < 5; ++i) {
      overwrite_bytes(path, static_cast<long>(4 + random() % (10 * kRecordBytes - 4)),
                      std::string(1, static_cast<char>(random())));
    }
    LogReader reader(path);
    CHECK(times_in(reader).size() <= 10);
  }
}

TEST_CASE("a missing or foreign file is refused by name") {
  const TemporaryFolder folder;
  CHECK(problem_of([&] { LogReader reader(folder / "none"); }) ==
        (folder / "none").string() + ": cannot be read: No such file or directory");
  std::ofstream(folder / "text") << "t,x,y,p\n";
  CHECK(problem_of([&] { LogReader reader(folder / "text"); }) ==
        (folder / "text").string() + ": is not an LCM log: it does not begin with a message");
}

TEST_CASE("an empty log is whole") {
  const TemporaryFolder folder;
  { LogWriter writer(folder / "a.lcm"); }
  LogReader reader(folder / "a.lcm");
  LogRecord record;
  CHECK_FALSE(reader.next(record));
  CHECK_FALSE(reader.damage().has_value());
}

}  // namespace puck
