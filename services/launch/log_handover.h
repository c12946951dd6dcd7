#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <spdlog/sinks/sink.h>

namespace puck {

/// Takes lines of a log without waiting, and has them written by a thread of its own: for a loop
/// that must keep its pace whatever becomes of its standard error. Keeps up to 256 lines of up to
/// 1000 characters; longer ones are cut off, further ones lost, and how many is said. Writes what
/// it has when it ends.
class LogHandover final : public spdlog::sinks::sink {
 public:
  explicit LogHandover(std::shared_ptr<spdlog::sinks::sink> writes);
  ~LogHandover() override = default;

  /// Safe from any thread.
  void log(const spdlog::details::log_msg& line) override;
  void flush() override {}
  // Before the first line.
  void set_pattern(const std::string& pattern) override { writes_->set_pattern(pattern); }
  void set_formatter(std::unique_ptr<spdlog::formatter> formatter) override {
    writes_->set_formatter(std::move(formatter));
  }

 private:
  static constexpr std::size_t kLines = 256;
  static constexpr std::size_t kLongest = 1000;

  // A place of the ring. `turn` says whose it is: n when it may be filled with line n, n + 1 when
  // that may be read. Released by whoever is done with it, acquired by the next.
  struct Line {
    std::atomic<std::uint64_t> turn{0};
    spdlog::log_clock::time_point time;
    spdlog::level::level_enum level = spdlog::level::info;
    std::string_view logger;  // whose name lives as long as it logs
    std::size_t length = 0;
    std::array<char, kLongest> text{};
  };

  void run(const std::stop_token& stop);
  void write_all();

  std::shared_ptr<spdlog::sinks::sink> writes_;
  std::vector<Line> lines_;
  // Relaxed: the lines' turns order what is written into them.
  std::atomic<std::uint64_t> next_{0};
  std::atomic<std::int64_t> lost_{0};
  std::uint64_t next_to_write_ = 0;
  std::int64_t told_lost_ = 0;
  std::jthread thread_;
};

}  // namespace puck
