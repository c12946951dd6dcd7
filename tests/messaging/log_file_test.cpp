#include "common/messaging/log_file.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <random>

#include <doctest/doctest.h>
#include <lcm/eventlog.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "common/messaging/message_codec.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

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

/// Records of many lengths: one differs from another by a bit, one is empty, one holds the mark.
std::vector<LogRecord> various_records() {
  std::vector<LogRecord> records;
  const std::vector<std::size_t> lengths{92, 0, 1, 28, 92, 220, 7, 60};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    LogRecord record{.utime = 1'700'000'000'000'000 + static_cast<std::int64_t>(i)};
    record.channel = i % 3 == 0 ? "PUCK_AAAA" : "PUCK_STATUS";
    record.bytes.assign(lengths[i], static_cast<std::uint8_t>(0x40 + i));
    records.push_back(std::move(record));
  }
  std::copy(kLogMark.begin(), kLogMark.end(), records[5].bytes.begin() + 50);
  return records;
}

/// Where each begins, and the end of the last.
std::vector<std::size_t> write_records(const std::filesystem::path& path,
                                       const std::vector<LogRecord>& records) {
  std::vector<std::size_t> offsets{0};
  LogWriter writer(path, true);
  for (const LogRecord& record : records) {
    writer.write(record.channel, record.utime, record.bytes);
    offsets.push_back(static_cast<std::size_t>(writer.bytes()));
  }
  return offsets;
}

std::vector<LogRecord> read_all(const std::filesystem::path& path) {
  LogReader reader(path);
  std::vector<LogRecord> records;
  for (LogRecord record; reader.next(record);) records.push_back(record);
  return records;
}

bool is_same(const LogRecord& a, const LogRecord& b) {
  return a.utime == b.utime && a.channel == b.channel && a.bytes == b.bytes;
}

/// Whether all of `expected` except the one at `hit` were read, in order, with at most a damaged
/// form of `hit` between them.
bool lost_only(std::size_t hit, const std::vector<LogRecord>& read,
               const std::vector<LogRecord>& expected) {
  if (read.size() + 1 < expected.size() || read.size() > expected.size()) return false;
  const std::size_t after = read.size() + 1 - expected.size();  // Of `hit` itself: 0 or 1.
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (i == hit) continue;
    if (!is_same(expected[i], read[i < hit ? i : i - 1 + after])) return false;
  }
  return true;
}

/// Limits the size of this process's files while it exists.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("written messages are read again, by LCM's own reader too") {
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

TEST_CASE("a typed message is written to a log and read again") {
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

TEST_CASE("an existing log is overwritten on request only") {
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

TEST_CASE("a log truncated anywhere gives its whole messages and reports the truncation") {
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

TEST_CASE("damage in the middle of a log costs only the damaged messages") {
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

TEST_CASE("a log with flipped bytes neither crashes the reader nor makes it loop") {
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

TEST_CASE("a flipped bit anywhere in a log costs only its own message") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  const auto expected = various_records();
  const auto offsets = write_records(path, expected);
  const std::string whole = read_text(path);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t byte = offsets[i]; byte < offsets[i + 1]; ++byte) {
      for (int bit = 0; bit < 8; ++bit) {
        std::string flipped = whole;
        flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << bit));
        write_text(path, flipped);
        CAPTURE(byte);
        CAPTURE(bit);
        REQUIRE(lost_only(i, read_all(path), expected));
      }
    }
  }
}

TEST_CASE("a log truncated at any byte gives all whole messages, and reports the truncation") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  const auto expected = various_records();
  const auto offsets = write_records(path, expected);
  const std::string whole = read_text(path);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t end = offsets[i] + (i == 0 ? 4 : 0); end < offsets[i + 1]; ++end) {
      write_text(path, whole.substr(0, end));
      LogReader reader(path);
      std::size_t count = 0;
      for (LogRecord record; reader.next(record); ++count) {
        REQUIRE(is_same(record, expected[count]));
      }
      REQUIRE(count == i);
      REQUIRE(reader.damage().has_value() == (end > offsets[i]));
      REQUIRE(reader.bytes_skipped() == static_cast<std::int64_t>(end - offsets[i]));
    }
  }
}

TEST_CASE("foreign bytes between two messages cost neither of them") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  const auto expected = various_records();
  const auto offsets = write_records(path, expected);
  std::string text = read_text(path);
  // More than the reader's buffer.
  text.replace(offsets[2], offsets[3] - offsets[2], std::string(5'000'000, '\xed'));
  write_text(path, text);
  LogReader reader(path);
  std::vector<LogDamage> damages;
  reader.on_damage([&](const LogDamage& damage) { damages.push_back(damage); });
  std::vector<LogRecord> records;
  for (LogRecord record; reader.next(record);) records.push_back(record);
  CHECK(records.size() == expected.size() - 1);
  CHECK(lost_only(2, records, expected));
  REQUIRE(damages.size() == 1);
  CHECK(damages[0].offset == static_cast<std::int64_t>(offsets[2]));
  CHECK(damages[0].bytes == 5'000'000);
  CHECK(damages[0].why == "no message begins");
}

TEST_CASE("every record has the position of its beginning") {
  const TemporaryFolder folder;
  const auto offsets = write_records(folder / "a.lcm", various_records());
  const auto records = read_all(folder / "a.lcm");
  for (std::size_t i = 0; i < records.size(); ++i) {
    CHECK(records[i].offset == static_cast<std::int64_t>(offsets[i]));
  }
}

TEST_CASE("on a full disk the log ends with a whole message, and continues later") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  LogWriter writer(path);
  const std::vector<std::uint8_t> message(100);
  {
    const FileSizeLimit limit(50'000);
    writer.write("PUCK_A", 1, message);
    writer.flush();
    for (int i = 0; i < 450; ++i) writer.write("PUCK_A", 2, message);
    CHECK(problem_of([&] { writer.flush(); }) ==
          path.string() + ": cannot be written: File too large");
    CHECK(writer.messages() == 1);
    CHECK(writer.bytes() == kRecordBytes);
    CHECK(std::filesystem::file_size(path) == kRecordBytes);
  }
  writer.write("PUCK_A", 3, message);
  writer.flush();
  LogReader reader(path);
  CHECK(times_in(reader) == std::vector<std::int64_t>{1, 3});
  CHECK_FALSE(reader.damage().has_value());
}

TEST_CASE("records made elsewhere get consecutive numbers") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  std::vector<std::uint8_t> records(2 * kRecordBytes);
  for (const std::size_t at : {0, kRecordBytes}) {
    put_log_record(std::span(records).subspan(at, kRecordBytes), {77, 5, 6, 100}, "PUCK_A",
                   std::vector<std::uint8_t>(100));
  }
  {
    LogWriter writer(path);
    writer.write("PUCK_B", 4, {});
    writer.write_records(records);
    CHECK(writer.messages() == 3);
    CHECK(writer.bytes() == static_cast<std::int64_t>(std::filesystem::file_size(path)));
    CHECK_THROWS_AS(writer.write_records(std::span(records).first(50)), std::invalid_argument);
  }
  const auto read = read_all(path);
  REQUIRE(read.size() == 3);
  for (std::int64_t i = 0; i < 3; ++i) CHECK(read[static_cast<std::size_t>(i)].number == i);
  CHECK(read[2].channel == "PUCK_A");
}

TEST_CASE("two loggers cannot write the same log") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  auto first = std::make_unique<LogWriter>(path);
  CHECK(problem_of([&] { LogWriter second(path, true); }) ==
        path.string() + ": cannot be written: another logger writes it");
  first.reset();
  CHECK_NOTHROW(LogWriter(path, true));
}

TEST_CASE("a missing or foreign file is refused by name") {
  const TemporaryFolder folder;
  CHECK(problem_of([&] { LogReader reader(folder / "none"); }) ==
        (folder / "none").string() + ": cannot be read: No such file or directory");
  std::ofstream(folder / "text") << "t,x,y,p\n";
  CHECK(problem_of([&] { LogReader reader(folder.path()); }) ==
        folder.path().string() + ": cannot be read: is not a file");
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(problem_of([&] { LogReader reader(folder / "pipe"); }) ==
        (folder / "pipe").string() + ": cannot be read: is not a file");
  CHECK(problem_of([&] { LogReader reader(folder / "text"); }) ==
        (folder / "text").string() + ": is not an LCM log: it does not begin with a message");
  // Shorter than the mark that is searched for.
  std::ofstream(folder / "short") << 'x';
  CHECK(problem_of([&] { LogReader reader(folder / "short"); }) ==
        (folder / "short").string() + ": is not an LCM log: it does not begin with a message");
}

TEST_CASE("an empty log is intact") {
  const TemporaryFolder folder;
  { LogWriter writer(folder / "a.lcm"); }
  LogReader reader(folder / "a.lcm");
  LogRecord record;
  CHECK_FALSE(reader.next(record));
  CHECK_FALSE(reader.damage().has_value());
}

TEST_CASE("lengths that all point to before one distant message cost one search, not one each") {
  constexpr std::size_t kHeads = kIsSanitized ? 10'000 : 100'000;
  constexpr std::size_t kHeadBytes = 29;
  constexpr std::size_t kGap = kIsSanitized ? 1'000'000 : 20'000'000;
  std::vector<std::uint8_t> bytes(kHeads * kHeadBytes + kGap + kHeadBytes);
  for (std::size_t at = 0; at < kHeads * kHeadBytes; at += kHeadBytes) {
    const LogHeader header{5, 0, 1, kHeads * kHeadBytes + 1 - at - kHeadBytes};
    put_log_header(std::span(bytes).subspan(at), header);
    bytes[at + kHeadBytes - 1] = 'A';
  }
  put_log_record(std::span(bytes).last(kHeadBytes), {6, 0, 1, 0}, "A", {});
  const TemporaryFolder folder;
  write_text(folder / "a.lcm", {bytes.begin(), bytes.end()});

  // A search of 20 MB for each would take many minutes.
  const auto began = std::chrono::steady_clock::now();
  LogReader reader(folder / "a.lcm");
  LogRecord record;
  REQUIRE(reader.next(record));
  CHECK(record.number == 6);
  CHECK_FALSE(reader.next(record));
  CHECK(std::chrono::steady_clock::now() - began < std::chrono::seconds(60));
}

}  // namespace puck
