#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "common/messages/single_publisher.h"
#include "common/messaging/bus.h"
#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"

namespace puck {

inline const std::vector<std::string> kServices{"puck-camera", "puck-tracker", "puck-bridge",
                                                "puck-arm", "puck-logger"};

/// Path of one of our programs.
std::string program(const std::string& name);
/// Runs one of them in a folder.
Finished call_tool(const std::string& name, const TemporaryFolder& folder,
                   const std::vector<std::string>& arguments);
/// … and requires its success.
void run_tool(const std::string& name, const TemporaryFolder& folder,
              const std::vector<std::string>& arguments);
/// The figures of puck-evaluate on the simulated recording game in a folder, with its truth.
nlohmann::json evaluate_game(const TemporaryFolder& folder,
                             const std::vector<std::string>& options = {});
/// A bus on this host, on another port at every call.
std::string new_lcm_url();

/// Command line of a service with its shipped settings, then those given: KEY=VALUE.
std::vector<std::string> service_command(const std::string& name, const std::string& url,
                                         const std::vector<std::string>& settings = {});
/// Starts it without output, except for warnings.
ChildProcess start_service(const std::string& name, const std::string& url,
                           const std::vector<std::string>& settings = {});
/// Exit code of its --check.
int check_service_program(const std::string& name, const std::string& url);

/// Does `step` until `condition` holds; false after `timeout`.
bool poll_until(const std::function<bool()>& condition, const std::function<void()>& step,
                std::chrono::milliseconds timeout = std::chrono::seconds(20));

/// Receives the services' messages on a bus. One thread.
class BusListener {
 public:
  explicit BusListener(const std::string& url, const std::string& key_file = {});

  /// Listens until `condition` holds; false after `timeout`.
  bool until(const std::function<bool()>& condition,
             std::chrono::milliseconds timeout = std::chrono::seconds(20));
  /// Waits until each has published a STATUS.
  bool hears(const std::vector<std::string>& services);

  /// The newest STATUS of a service; nothing before its first.
  std::optional<service_status_t> status(const std::string& service) const;
  /// From its newest STATUS; -1 if that lacks it.
  std::int64_t counter(const std::string& service, const std::string& name) const;
  /// ESTIMATEs of one tracker with newer events than all before them.
  std::int64_t fresh_estimates() const { return fresh_estimates_; }
  /// Sensor time of the newest event in any ESTIMATE, µs; -1 before the first.
  std::int64_t newest_event_us() const { return newest_event_us_; }

 private:
  Bus bus_;
  std::map<std::string, service_status_t> statuses_;
  SinglePublisher tracker_;
  std::int64_t fresh_estimates_ = 0;
  std::int64_t newest_event_us_ = -1;
};

}  // namespace puck
