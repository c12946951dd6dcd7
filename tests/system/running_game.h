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

/// An arm whose span of positions is below this stands still: what is left is rounding, m.
inline constexpr double kStillM = 1e-6;

/// The simulated game with the real programs, which a test may kill, freeze and start again, and
/// what they say meanwhile. One thread.
class RunningGame {
 public:
  explicit RunningGame(const std::string& url);

  /// Before its start: its CLOCK_REALTIME is off by so much, as libfaketime writes it: +5h, -2d.
  void set_clock(const std::string& name, const std::string& offset) { clocks_[name] = offset; }
  /// A command, to be run with such a clock.
  static std::vector<std::string> with_clock(const std::string& offset,
                                             std::vector<std::string> command);
  /// Starts a service, anew if it was started before. Settings: KEY=VALUE.
  void start(const std::string& name, std::vector<std::string> settings = {});
  void start_all();
  ChildProcess& process(const std::string& name) { return *processes_.at(name); }
  /// SIGKILL, and waits until it is gone.
  void kill(const std::string& name);

  /// Listens until `condition` holds; false after a generous while.
  bool until(const std::function<bool()>& condition);
  void listen(std::chrono::milliseconds time);

  /// Whether the arm takes commands that rest on the events of the camera that runs now.
  bool plays();

  /// Of the newest STATUS of a service: its session, 0 before the first; text; counter, -1: none.
  std::int64_t session(const std::string& name) const;
  std::string state_text(const std::string& name) const;
  /// Its newest STATUS is its last.
  bool is_stopping(const std::string& name) const;
  std::int64_t counter(const std::string& name, const std::string& counter) const;
  /// Its name as others call it: "puck-arm on HOST, pid 12".
  std::string name_and_place(const std::string& name) const;

  const std::optional<arm_state_t>& arm() const { return arm_; }
  const std::optional<puck_estimate_t>& estimate() const { return estimate_; }
  /// The span of all positions of the arm since the last call, m.
  double take_arm_span_m();
  /// ESTIMATEs that tracked since the last call.
  int take_tracked() { return std::exchange(tracked_, 0); }
  /// The log of the logger that was started last.
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
