#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/messaging/bus.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {

/// An arm with a span of positions below this, rounding's size, is at rest, m.
inline constexpr double kStillM = 1e-6;

/// The simulated game with the real programs, which a test may kill, freeze and restart, and their
/// messages. One thread.
class RunningGame {
 public:
  explicit RunningGame(const std::string& url);

  /// Before its start: offset of its CLOCK_REALTIME, in libfaketime's form: +5h, -2d.
  void set_clock(const std::string& name, const std::string& offset) { clocks_[name] = offset; }
  /// A command that runs with such a clock.
  static std::vector<std::string> with_clock(const std::string& offset,
                                             std::vector<std::string> command);
  /// Starts a service, anew if it was started before. Settings: KEY=VALUE.
  void start(const std::string& name, std::vector<std::string> settings = {});
  void start_all();
  ChildProcess& process(const std::string& name) { return *processes_.at(name); }
  /// Sends SIGKILL, and waits for the end.
  void kill(const std::string& name);

  /// Listens until `condition` holds; false after a long time.
  bool until(const std::function<bool()>& condition);
  void listen(std::chrono::milliseconds time);

  /// Whether the arm accepts commands based on events of the present camera.
  bool plays();

  /// Of the newest STATUS of a service: its session, 0 before the first; text; counter, -1: none.
  std::int64_t session(const std::string& name) const;
  std::string state_text(const std::string& name) const;
  /// Whether its newest STATUS is its last.
  bool is_stopping(const std::string& name) const;
  std::int64_t counter(const std::string& name, const std::string& counter) const;
  /// Its name in other services' messages: "puck-arm on HOST, pid 12".
  std::string name_and_place(const std::string& name) const;

  const std::optional<arm_state_t>& arm() const { return arm_; }
  const std::optional<puck_estimate_t>& estimate() const { return estimate_; }
  /// The span of all positions of the arm since the last call, m.
  double take_arm_span_m();
  /// ESTIMATEs with a tracked puck since the last call.
  int take_tracked() { return std::exchange(tracked_, 0); }
  /// The log of the logger started last.
  std::filesystem::path log_path() const;
  const std::string& url() const { return url_; }

 private:
  bool is_of_now(std::int64_t utime, const Receipt& at) const;

  std::string url_;
  TemporaryFolder folder_;
  Bus bus_;
  std::map<std::string, std::string> clocks_;  // by service
  std::map<std::string, std::unique_ptr<ChildProcess>> processes_;
  std::map<std::string, service_status_t> statuses_;
  std::optional<arm_state_t> arm_;
  std::optional<puck_estimate_t> estimate_;
  std::optional<double> lowest_m_;
  std::optional<double> highest_m_;
  int tracked_ = 0;
  int logs_ = 0;
};

}  // namespace puck
