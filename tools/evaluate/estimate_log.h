#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/messages/published_estimate.h"
#include "common/messaging/log_file.h"
#include "common/messaging/loss_accounting.h"

namespace puck {

/// The estimates with new events on PUCK_ESTIMATE of an LCM log: those of the first tracker that
/// received a camera's run, without repetitions. One thread.
class EstimateLog {
 public:
  /// `events_session`: the camera's run. Throws LogFileError.
  EstimateLog(const std::filesystem::path& path, const std::string& prefix,
              std::int64_t events_session);

  /// False at the end of the log and where the tracker restarted with other events.
  bool next(PublishedEstimate& estimate);

  std::int64_t repeated() const { return repeated_; }  ///< Without new events.
  /// Lost on the way to the log.
  std::int64_t missing() const { return losses_.counters().lost; }
  std::int64_t malformed() const { return malformed_; }
  /// Of other trackers, or resting on other events.
  std::int64_t of_others() const { return of_others_; }
  bool began_anew() const { return began_anew_; }

 private:
  LogReader log_;
  LogRecord record_;
  std::string channel_;
  std::int64_t events_session_;
  std::int64_t session_ = 0;  // The tracker's; 0: not found yet.
  std::int64_t newest_ = 0;   // Events applied in the last returned estimate.
  LossAccount losses_;
  std::int64_t repeated_ = 0;
  std::int64_t malformed_ = 0;
  std::int64_t of_others_ = 0;
  bool began_anew_ = false;
};

}  // namespace puck
