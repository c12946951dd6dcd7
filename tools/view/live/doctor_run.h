#pragma once

#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "common/messaging/bus.h"
#include "tools/view/interface/view_state.h"

namespace puck {

/// The program, and the service that it calls itself on the bus.
inline constexpr const char* kDoctorProgram = "puck-doctor";

/// What puck-doctor's JSON report says is wrong, with its remedy; or that the report is unreadable.
std::vector<ViewMessage> doctor_messages(const std::string& report);

/// Runs the program puck-doctor, which lies beside this one, in the background. Safe from any
/// thread.
class DoctorRun {
 public:
  explicit DoctorRun(const BusParams& bus) : bus_(bus) {}

  /// Starts a run, unless one goes on or the last one began within 20 s.
  void ask(std::int64_t now_us);

  /// Of the last run; empty before its end.
  std::vector<ViewMessage> answer() const;

 private:
  void run(const std::stop_token& stop);

  BusParams bus_;
  mutable std::mutex mutex_;
  std::int64_t begun_us_ = 0;  // Guarded by mutex_, as all below.
  bool is_running_ = false;
  std::vector<ViewMessage> answer_;
  std::jthread thread_;
};

}  // namespace puck
