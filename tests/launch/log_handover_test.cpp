#include "services/launch/log_handover.h"

#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <spdlog/logger.h>

namespace puck {
namespace {

// Writes into memory, as long as nobody holds it up.
class HeldSink final : public spdlog::sinks::sink {
 public:
  void log(const spdlog::details::log_msg& line) override {
    const std::lock_guard held(hold);
    lines.emplace_back(line.payload.data(), line.payload.size());
  }
  void flush() override {}
  void set_pattern(const std::string&) override {}
  void set_formatter(std::unique_ptr<spdlog::formatter>) override {}

  std::mutex hold;
  std::vector<std::string> lines;
};

TEST_CASE("A log that hangs keeps nobody waiting, and says afterwards how many lines it lost") {
  const auto sink = std::make_shared<HeldSink>();
  {
    spdlog::logger log("test", std::make_shared<LogHandover>(sink));
    const std::lock_guard held(sink->hold);
    // The sink is held up by this thread, so that whoever waited for it would wait for ever.
    for (int i = 0; i < 1000; ++i) log.info("line {}", i);
  }
  REQUIRE(sink->lines.size() == 257);
  CHECK(sink->lines[0] == "line 0");
  CHECK(sink->lines[1] == "744 lines of the log were lost");
  CHECK(sink->lines[256] == "line 255");
}

TEST_CASE("Lines of several threads all arrive, each thread's in its order, long ones cut off") {
  const auto sink = std::make_shared<HeldSink>();
  {
    spdlog::logger log("test", std::make_shared<LogHandover>(sink));
    const auto speak = [&](char name) {
      for (int i = 0; i < 60; ++i) log.info("{}{}", name, i);
    };
    const std::jthread a(speak, 'a');
    const std::jthread b(speak, 'b');
    const std::jthread c(speak, 'c');
  }
  REQUIRE(sink->lines.size() == 180);
  for (const char name : {'a', 'b', 'c'}) {
    int next = 0;
    for (const std::string& line : sink->lines) {
      if (line[0] == name) CHECK(line.substr(1) == std::to_string(next++));
    }
    CHECK(next == 60);
  }
  {
    spdlog::logger log("test", std::make_shared<LogHandover>(sink));
    log.info("{}", std::string(5000, 'x'));
  }
  CHECK(sink->lines.back() == std::string(1000, 'x'));
}

}  // namespace
}  // namespace puck
