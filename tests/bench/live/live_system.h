#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "tests/bench/live/live_listener.h"
#include "tests/bench/live/two_machines.h"
#include "tests/support/child_process.h"
#include "tests/support/process_usage.h"
#include "tests/support/temporary_folder.h"

namespace puck {

struct LiveSetup {
  std::filesystem::path bin;     ///< Folder of the services.
  std::filesystem::path source;  ///< Root of the project, for paths in the settings.
  std::string key_file{};        ///< Their lcm.key_file; empty: none.
  std::stop_token stop;
  /// The machines: the camera runs on the second, all others on the first, to which the calling
  /// thread belongs. Nothing: all run on this one.
  const TwoMachines* machines = nullptr;
};

/// Percentages of a core by service.
using CpuLoad = std::map<std::string, double>;

/// The five services as processes, on a bus of their own, as long as this object lives. They run
/// with their shipped settings and those given, KEY=VALUE. One thread.
class LiveSystem {
 public:
  /// Starts all but the camera and waits for their first STATUS. Throws std::runtime_error, with a
  /// service's last output, when one does not start; Interrupted.
  explicit LiveSystem(const LiveSetup& setup, const std::vector<std::string>& tracker = {});
  ~LiveSystem();

  /// The same for the camera.
  void start_camera(const std::vector<std::string>& settings);

  const std::string& url() const { return url_; }
  pid_t pid(const std::string& service) const { return services_.at(service)->pid(); }

  /// Joins the bus. Before that the services have no additional receiver.
  LiveListener& listener();
  void stop_listening() { listener_.reset(); }

  /// Lets them run and measures their load. Throws when one ends.
  CpuLoad watch(std::chrono::milliseconds time);
  /// Wake-ups a second of a service's threads, during the last watch.
  double wake_ups_hz(const std::string& service) const { return wake_ups_hz_.at(service); }

  /// Ends the camera and waits for its last STATUS, and for the tracker to receive the rest.
  void stop_camera();

 private:
  struct Watch {
    std::chrono::steady_clock::time_point began;
    std::map<std::string, ProcessUsage> usage;
  };

  void start(const std::string& name, const std::vector<std::string>& settings);
  void start_here(const std::string& name, const std::vector<std::string>& settings);
  void await(const std::vector<std::string>& names);
  void check_alive();
  Watch begin_watch();
  CpuLoad end_watch(const Watch& watch);

  LiveSetup setup_;
  TemporaryFolder folder_;
  std::string url_;
  std::map<std::string, double> wake_ups_hz_;
  std::map<std::string, std::unique_ptr<ChildProcess>> services_;
  std::optional<LiveListener> listener_;
};

}  // namespace puck
