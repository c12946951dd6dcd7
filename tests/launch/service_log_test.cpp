#include "services/launch/service_log.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <spdlog/sinks/sink.h>

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

TEST_CASE("The log of a real-time loop that hangs keeps nobody waiting, and counts what it lost") {
  const auto sink = std::make_shared<HeldSink>();
  std::size_t lost = 0;
  {
    ServiceLog log("test", sink, true);
    const std::lock_guard held(sink->hold);
    // The sink is held up by this thread, so that whoever waited for it would wait for ever.
    for (int i = 0; i < 1000; ++i) log.logger().info("line {}", i);
    lost = log.lost_lines();
  }
  // The writer may hold one line already.
  CHECK(lost >= 743);
  CHECK(lost <= 744);
  REQUIRE(sink->lines.size() == 1000 - lost);
  CHECK(sink->lines.back() == "line 999");
}

TEST_CASE("Any other log is written by whoever logs, at once") {
  const auto sink = std::make_shared<HeldSink>();
  ServiceLog log("test", sink, false);
  log.logger().info("one");
  CHECK(sink->lines == std::vector<std::string>{"one"});
  CHECK(log.lost_lines() == 0);
}

}  // namespace
}  // namespace puck
