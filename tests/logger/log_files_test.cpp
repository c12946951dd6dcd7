#include "services/logger/log_files.h"

#include <cstdlib>

#include <doctest/doctest.h>
#include <unistd.h>

#include "services/logger/disk_quota.h"
#include "tests/support/small_disk.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

constexpr std::size_t kRecordBytes = 28 + 11 + 1000 - 39;

/// Messages of 1000 bytes with their headers in a log, a second apart.
std::vector<std::uint8_t> records(int count, int first = 0) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(count) * kRecordBytes);
  const std::vector<std::uint8_t> message(kRecordBytes - 39);
  for (int i = 0; i < count; ++i) {
    put_log_record(
        std::span(bytes).subspan(static_cast<std::size_t>(i) * kRecordBytes, kRecordBytes),
        {0, 1'000'000LL * (first + i), 11, message.size()}, "PUCK_EVENTS", message);
  }
  return bytes;
}

void write_all(LogFiles& files, std::vector<std::uint8_t> bytes) {
  for (std::span<std::uint8_t> left = bytes; !left.empty();) left = left.subspan(files.write(left));
}

/// Of a whole log: the times of its messages, s.
std::vector<std::int64_t> seconds_in(const std::filesystem::path& path) {
  LogReader reader(path);
  std::vector<std::int64_t> seconds;
  for (LogRecord record; reader.next(record);) {
    CHECK(record.number == static_cast<std::int64_t>(seconds.size()));
    seconds.push_back(record.utime / 1'000'000);
  }
  CHECK_FALSE(reader.damage().has_value());
  return seconds;
}

std::vector<std::string> names_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// While it exists, this program may read the folder but not change it; for that, root becomes
/// nobody.
class NobodysRights {
 public:
  explicit NobodysRights(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::permissions(folder_, std::filesystem::perms(0555));
    std::filesystem::permissions(folder_.parent_path(), std::filesystem::perms(0755));
    REQUIRE((!was_root_ || seteuid(kNobody) == 0));
  }
  ~NobodysRights() {
    if (was_root_ && seteuid(0) != 0) std::abort();
    std::filesystem::permissions(folder_, std::filesystem::perms(0755));
  }

 private:
  static constexpr uid_t kNobody = 65534;

  std::filesystem::path folder_;
  bool was_root_ = geteuid() == 0;
};

LoggerParams params_for(const std::filesystem::path& path) {
  return {.path = path, .min_free_bytes = 0};
}

}  // namespace

TEST_CASE("a log that rotates by size has whole files that together contain everything") {
  const TemporaryFolder folder;
  LogSync sync;
  LoggerParams params = params_for(folder / "a.lcm");
  params.rotate_bytes = 100'500;
  LogFiles files(params, "", sync);
  write_all(files, records(250));
  CHECK(names_in(folder) ==
        std::vector<std::string>{"a.000000.lcm", "a.000001.lcm", "a.000002.lcm"});
  std::int64_t expected = 0;
  for (const std::string& name : names_in(folder)) {
    CHECK(std::filesystem::file_size(folder / name) <= 100'500);
    for (const std::int64_t second : seconds_in(folder / name)) CHECK(second == expected++);
  }
  CHECK(expected == 250);
  CHECK(files.progress().messages == 250);
  CHECK(files.progress().bytes == 250'000);
  CHECK(files.progress().files == 3);
  CHECK(files.progress().path == (folder / "a.000002.lcm").string());
}

TEST_CASE("a log that rotates by time begins a new file at the end of each period") {
  const TemporaryFolder folder;
  LogSync sync;
  LoggerParams params = params_for(folder / "a.lcm");
  params.rotate_s = 60;
  LogFiles files(params, "", sync);
  write_all(files, records(150));
  CHECK(seconds_in(folder / "a.000000.lcm").back() == 59);
  CHECK(seconds_in(folder / "a.000001.lcm").front() == 60);
  CHECK(seconds_in(folder / "a.000002.lcm").size() == 30);
}

TEST_CASE("a clock that is set back does not stop rotation by time") {
  const TemporaryFolder folder;
  LogSync sync;
  LoggerParams params = params_for(folder / "a.lcm");
  params.rotate_s = 60;
  LogFiles files(params, "", sync);
  write_all(files, records(10, 1'000'000));
  write_all(files, records(70));
  CHECK(seconds_in(folder / "a.000000.lcm").size() == 10);
  CHECK(seconds_in(folder / "a.000001.lcm").size() == 60);
  CHECK(seconds_in(folder / "a.000002.lcm").size() == 10);
}

TEST_CASE("a restarted rotated log continues with the next number") {
  const TemporaryFolder folder;
  LogSync sync;
  LoggerParams params = params_for(folder / "a.lcm");
  params.rotate_bytes = 100'000;
  for (int run = 0; run < 3; ++run) {
    LogFiles files(params, "", sync);
    write_all(files, records(1, run));
  }
  for (int run = 0; run < 3; ++run) {
    CHECK(seconds_in(folder / ("a.00000" + std::to_string(run) + ".lcm")) ==
          std::vector<std::int64_t>{run});
  }
}

TEST_CASE("the quota removes only the oldest files of this log") {
  const TemporaryFolder folder;
  write_text(folder / "a.lcm", std::string(500'000, 'x'));
  write_text(folder / "a.000000.lcm", std::string(500'000, 'x'));  // By its name only.
  write_text(folder / "b.000000.lcm", "\xed\xa1\xda\x01");
  std::filesystem::create_directory(folder / "a.000001.lcm");
  std::filesystem::create_symlink(folder / "b.000000.lcm", folder / "a.000002.lcm");
  const auto foreign = names_in(folder);

  LogSync sync;
  LoggerParams params = params_for(folder / "a.lcm");
  params.rotate_bytes = 100'000;
  params.quota_bytes = 350'000;
  LogFiles files(params, "", sync);
  for (int i = 0; i < 10; ++i) {
    write_all(files, records(100, 100 * i));
    std::int64_t bytes = 0;
    for (const std::string& name : names_in(folder)) {
      if (std::find(foreign.begin(), foreign.end(), name) == foreign.end()) {
        bytes += static_cast<std::int64_t>(std::filesystem::file_size(folder / name));
      }
    }
    CHECK(bytes <= 350'000);
  }
  auto expected = foreign;
  // Two whole files stay beside the newest: a third would leave no room for the newest.
  expected.insert(expected.end(), {"a.000010.lcm", "a.000011.lcm", "a.000012.lcm"});
  std::sort(expected.begin(), expected.end());
  CHECK(names_in(folder) == expected);
  CHECK(seconds_in(folder / "a.000012.lcm").back() == 999);
  CHECK(files.progress().files_removed == 7);
}

TEST_CASE("the quota spares a file that another logger writes") {
  const TemporaryFolder folder;
  const LogNames names("a.lcm", folder / "a.lcm");
  auto other = std::make_unique<LogWriter>(folder / "a.000000.lcm");
  other->write("PUCK_A", 1, std::vector<std::uint8_t>(1000));
  other->flush();
  CHECK(remove_oldest_logs(names, 0).files_removed == 0);
  other.reset();
  CHECK(remove_oldest_logs(names, 0).files_removed == 1);
  CHECK(names_in(folder).empty());
}

TEST_CASE("the quota reports files that it cannot remove, and folders that it cannot read") {
  const TemporaryFolder folder;
  const std::filesystem::path logs = folder / "logs";
  std::filesystem::create_directory(logs);
  const LogNames names("a.lcm", logs / "a.lcm");
  LogWriter(logs / "a.000000.lcm").write("PUCK_A", 1, std::vector<std::uint8_t>(1000));
  {
    const NobodysRights rights(logs);
    const QuotaResult result = remove_oldest_logs(names, 0);
    CHECK(result.files_removed == 0);
    CHECK(result.bytes_left > 1000);
    CHECK(result.problem ==
          "cannot remove " + (logs / "a.000000.lcm").string() + ": Permission denied");
  }
  CHECK(remove_oldest_logs(names, 0).problem.empty());
  std::filesystem::remove_all(logs);
  CHECK(remove_oldest_logs(names, 0).problem ==
        "cannot read " + logs.string() + ": No such file or directory");
}

TEST_CASE("the log stops permanently at its largest size over all files, and counts the rest") {
  const TemporaryFolder folder;
  LogSync sync;
  LoggerParams params = params_for(folder / "a.lcm");
  params.rotate_bytes = 100'000;
  params.max_bytes = 150'999;
  LogFiles files(params, "", sync);
  write_all(files, records(200));
  CHECK(files.progress().messages == 150);
  CHECK(files.progress().problem == "logger.max_bytes = 150999 is reached");
  CHECK(files.not_written().total() == 50);
  StatusReport report;
  files.not_written().report("messages_not_written", report);
  CHECK(report.counters ==
        std::vector<std::pair<std::string, std::int64_t>>{
            {"messages_not_written", 50}, {"messages_not_written.PUCK_EVENTS", 50}});
}

TEST_CASE("a disk is never filled: the log stops before, and continues when there is space") {
  const SmallDisk disk(4 << 20);
  if (!disk.is_mounted()) {
    MESSAGE("skipped: only root can mount a small disk");
    return;
  }
  for (const std::int64_t min_free : {1'000'000, 0}) {
    CAPTURE(min_free);
    write_text(disk / "other", std::string(1'000'000, 'x'));
    LogSync sync;
    LoggerParams params = params_for(disk / "a.lcm");
    params.overwrite = true;
    params.min_free_bytes = min_free;
    LogFiles files(params, "", sync);
    for (int i = 0; i < 50; ++i) write_all(files, records(100, 100 * i));
    REQUIRE(files.progress().problem.has_value());
    CHECK(files.progress().problem->find(min_free > 0
                                             ? "logger.min_free_bytes = 1000000"
                                             : "No space left on device") != std::string::npos);
    CHECK(disk.free_bytes() >= min_free);
    const std::int64_t written = files.progress().messages;
    CHECK(written > 1000);
    CHECK(written + files.not_written().total() == 5000);
    CHECK(seconds_in(disk / "a.lcm").size() == static_cast<std::size_t>(written));

    std::filesystem::remove(disk / "other");
    int tries = 0;
    CHECK(wait_until([&] {
      if (files.progress().problem) write_all(files, records(1, 9000 + tries++));
      return !files.progress().problem;
    }));
    const auto seconds = seconds_in(disk / "a.lcm");
    CHECK(seconds.size() == static_cast<std::size_t>(written) + 1);
    CHECK(seconds.back() == 9000 + tries - 1);
  }
}

}  // namespace puck
