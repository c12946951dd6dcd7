#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "common/runtime/latency_histogram.h"
#include "services/camera/control_verdict.h"
#include "services/camera/event_source.h"
#include "services/camera/pacer.h"
#include "services/camera/replay_request.h"

namespace puck {

struct ReplayParams {
  double speed = 1;               ///< Key camera.speed.
  bool paused = false;            ///< Key camera.paused.
  std::int64_t step_us = 0;       ///< Key camera.step_us; 0: one packet.
  std::int64_t skip_gaps_us = 0;  ///< Key camera.skip_gaps_s; 0: none is skipped.
};

/// The playing of a paced source: when its events are due, and the pauses, steps, speeds and places
/// that people ask for. One thread.
class Replay {
 public:
  using Clock = Pacer::Clock;

  /// `source` must outlive it.
  Replay(const ReplayParams& params, EventSource& source)
      : params_(params), source_(source), pacer_(params.speed), is_paused_(params.paused) {}

  /// The source plays on from `time`, which is now.
  void begin(Timestamp time, Clock::time_point now);
  /// Whether the source is a recording; another one obeys nothing.
  bool is_controllable() const { return source_.is_recording(); }
  bool is_begun() const { return pacer_.is_started(); }

  ControlVerdict obey(const ReplayRequest& request, Clock::time_point now);

  /// When to publish what is due at `time`; nothing while the source is paused. In the order of the
  /// times.
  std::optional<Clock::time_point> due(Timestamp time, Clock::time_point now);
  /// What is due at `time` is handled now. Returns true if the plan slipped.
  bool note(Timestamp time, Clock::time_point now);
  /// A packet was published, after note() of its time.
  void note_sent(Clock::time_point now);
  /// The next events come at `first`. Where that is behind a gap to be skipped, they are due now;
  /// returns the gap's length, µs, else 0.
  std::int64_t skip_gap(Timestamp first, Clock::time_point now);

  bool is_paused() const { return is_paused_; }
  /// Whether a step that was asked for is not done yet.
  bool is_stepping() const { return step_end_ || packets_allowed_ > 0; }
  double speed() const { return params_.speed; }

  /// Whether next() of the source searches for a place.
  bool is_searching() const { return sought_us_.has_value(); }
  /// If it failed, the source plays on where it was.
  void end_search(bool is_found, Clock::time_point now);

  /// Where the source is, or is sought, µs since the recording's first event.
  std::int64_t position_us(Clock::time_point now) const;

  /// Host CLOCK_REALTIME at sensor time 0, µs; 0 at another speed than 1, where it is not fixed.
  std::int64_t sensor_zero_utime() const { return params_.speed == 1 ? zero_utime_ : 0; }
  std::int64_t lateness_us() const { return pacer_.lateness_us(); }
  std::int64_t slipped_us() const { return pacer_.slipped_us(); }
  /// Of the packets that were not stepped: publication after the time when they were due.
  LatencySummary lateness() const { return lateness_.summary(); }

 private:
  void pause(Clock::time_point now);
  void resume(Clock::time_point now);
  void step(std::int64_t us, Clock::time_point now);
  ControlVerdict seek(std::int64_t position_us, Clock::time_point now);
  void set_speed(double speed, Clock::time_point now);
  void hold(Timestamp time);
  void anchor(Timestamp time, Clock::time_point now);
  Timestamp time_at(Clock::time_point now) const;

  ReplayParams params_;
  EventSource& source_;
  Pacer pacer_;
  LatencyHistogram lateness_;
  std::int64_t zero_utime_ = 0;
  Timestamp newest_;     // That was handled.
  Timestamp waits_for_;  // The next one to be handled.
  Clock::time_point noted_at_;
  std::int64_t noted_late_us_ = 0;

  bool is_paused_;
  Timestamp held_at_;                  // While paused; else of the last pause.
  int packets_allowed_ = 0;            // While paused.
  std::optional<Timestamp> step_end_;  // Pauses there.
  std::optional<std::int64_t> sought_us_;
  Timestamp sought_from_;                 // While searching: where the source was.
  std::optional<std::int64_t> found_us_;  // Until the source plays on there.
};

/// A position or duration, as "12.345 s"; "12.345678 s" where it is no whole number of ms.
std::string seconds_text(std::int64_t us);

}  // namespace puck
