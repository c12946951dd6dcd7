#pragma once

#include <optional>
#include <string>

#include "common/messaging/receipt.h"
#include "services/camera/control_guard.h"
#include "services/camera/replay.h"
#include "services/camera/terminal_keys.h"
#include "services/launch/service.h"

namespace puck {

/// Lets people control a replay, by keys on the terminal and by messages on the bus, and reports it
/// in the log and in STATUS. A camera without a replay refuses all. One thread.
class ReplayControls {
 public:
  /// Subscribes, so make it before the bus starts. `replay`: null for a source at its own pace;
  /// else it must outlive this.
  ReplayControls(Replay* replay, ServiceContext& context);

  /// Reads keys from now on, if stdin is a terminal.
  void use_keys();
  /// Obeys the keys typed since the last call, and logs what became of them: of a step, when it
  /// is done, or the source has ended before.
  void poll(bool has_ended);

  /// The search has ended.
  void end_search(bool is_found);

  /// Where the recording is, and whether it is paused or searched; empty without a recording.
  std::string place() const;
  void report(StatusReport& report) const;

 private:
  void hear(const CameraControl& control, const Receipt& receipt);
  ControlVerdict obey(const std::optional<ReplayRequest>& request, std::int64_t sender);
  std::string outcome(ControlVerdict verdict) const;

  static constexpr std::int64_t kKey = 0;  // Instead of a sender's session: a key.

  Replay* replay_;
  ServiceContext& context_;
  ControlGuard guard_;
  std::optional<TerminalKeys> keys_;
  bool tells_step_ = false;             // A key's step is not logged yet.
  std::int64_t search_session_ = kKey;  // The sender who began the search.
};

}  // namespace puck
