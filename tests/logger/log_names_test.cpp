#include "services/logger/log_names.h"

#include <ctime>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"

namespace puck {

TEST_CASE("the conversions in the path become the time, and must leave a path") {
  std::tm time{};
  time.tm_year = 126;
  time.tm_mon = 10;
  time.tm_mday = 21;
  time.tm_hour = 19;
  time.tm_isdst = -1;
  CHECK(expand_log_path("a/%Y-%m-%d.lcm", std::mktime(&time)) == "a/2026-11-21.lcm");
  CHECK(expand_log_path("plain.lcm", 0) == "plain.lcm");
  CHECK_THROWS_AS(expand_log_path("", 0), std::invalid_argument);
}

TEST_CASE("numbers of rotated files sort by name") {
  const LogNames names("log/%Y.lcm", "log/2026.lcm");
  CHECK(names.at(0) == "log/2026.000000.lcm");
  CHECK(names.at(12) == "log/2026.000012.lcm");
  CHECK(names.at(9) < names.at(10));
  CHECK(LogNames("a", "a").at(3) == "./a.000003");
}

TEST_CASE("numbers continue after existing ones, with or without gaps") {
  const TemporaryFolder folder;
  const LogNames names("%Y.lcm", folder / "2026.lcm");
  CHECK(names.first_free() == 0);
  write_text(folder / "2026.000000.lcm", "");
  write_text(folder / "2026.000041.lcm", "");
  write_text(folder / "2027.000099.lcm", "");
  write_text(folder / "2026.000050.txt", "");
  write_text(folder / "2026.50.lcm", "");
  write_text(folder / "2026.2147483647.lcm", "");
  CHECK(names.first_free() == 42);
}

TEST_CASE("only names that the pattern produces for some time are logs of ours") {
  const LogNames names("x/puck-%Y-%m-%d-%H-%M-%S.lcm", "x/puck-2026-11-21-19-30-00.lcm");
  CHECK(names.is_ours("puck-2026-11-21-19-30-00.000000.lcm"));
  CHECK(names.is_ours("puck-2025-01-02-03-04-05.123456.lcm"));
  for (const char* other :
       {"puck-2026-11-21-19-30-00.lcm", "puck-2026-11-21-19-30-00.1.lcm",
        "puck-2026-11-21-19-30-00.-00001.lcm", "puck-2026-11-21-19-30-00.00000x.lcm",
        "puck-2026-13-21-19-30-00.000000.lcm", "puck-2026-11-21.000000.lcm",
        "puck-2026-11-21-19-30-00 copy.000000.lcm", "my-puck-2026-11-21-19-30-00.000000.lcm",
        "puck-2026-11-21-19-30-00.000000.lcm.bak", "puck-2026-1-2-3-4-5.000000.lcm", ".lcm", ""}) {
    CAPTURE(other);
    CHECK_FALSE(names.is_ours(other));
  }
  const LogNames fixed("log.lcm", "log.lcm");
  CHECK(fixed.is_ours("log.000007.lcm"));
  CHECK(fixed.is_ours("log.1000000.lcm"));
  for (const char* other : {"log2.000007.lcm", "log.0000007.lcm", "log.20261121.lcm",
                            "log.2147483647.lcm", "log.20261121193000.lcm"}) {
    CAPTURE(other);
    CHECK_FALSE(fixed.is_ours(other));
  }
}

}  // namespace puck
