#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// One line for the user.
struct ViewMessage {
  enum class Level : std::uint8_t { kInfo, kWarning, kError };

  Level level = Level::kInfo;
  std::string text;  ///< What happened, what was expected, what to do.
};

/// Values of the charts at one time.
struct ChartSample {
  struct Track {
    std::optional<Pixel> position;
    std::optional<double> error_px;  ///< Against truth.
    double score = 0;
    TrackState state = TrackState::kSearching;
    bool is_doubtful = true;  ///< Not `tracking`, or coasting.
  };

  /// Sensor time between two samples.
  static constexpr std::int64_t kPeriod_us = 10'000;
  /// Sensor time that a source keeps.
  static constexpr std::int64_t kKept_us = 10'000'000;

  Timestamp time;
  double events_per_s = 0;  ///< Over the last period.
  std::array<Track, kViewSides> tracks;
  std::optional<Pixel> truth;
};

/// Latency or cost of a step.
struct ViewLatency {
  std::string name;  ///< "packet to estimate", "tracker, CPU per ms of recording", …
  std::optional<std::int64_t> p50_us;
  std::optional<std::int64_t> p99_us;
  std::optional<std::int64_t> max_us;
};

/// A service of the live bus.
struct ViewService {
  std::string name;
  std::string host;
  std::int32_t pid = 0;
  std::string state;       ///< "running", "degraded", …
  std::string state_text;  ///< What it waits for, or its problem.
  bool is_healthy = true;
  double age_s = 0;  ///< Of its last STATUS.
  double uptime_s = 0;
  std::vector<std::pair<std::string, std::int64_t>> counters;
  std::vector<ViewLatency> latencies;
};

/// A channel of the live bus, or of a log.
struct ViewChannel {
  std::string name;
  double messages_per_s = 0;
  double bytes_per_s = 0;
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t late = 0;
  std::int64_t malformed = 0;
  std::optional<double> age_s;  ///< Of the newest message.
  bool is_in_trouble = false;
};

/// Playing of a recording.
struct ViewPlayback {
  enum class Activity : std::uint8_t {
    kPlaying,
    kPaused,
    kSeeking,    ///< Runs the trackers up to the wanted time.
    kSearching,  ///< Runs them up to the next loss.
    kEnded,
  };

  Activity activity = Activity::kPaused;
  double speed = 1;          ///< Wanted: 1 is the recording's own pace.
  double reached_speed = 0;  ///< Over the last second or so, while playing.
};

/// The figures beside the pictures.
struct ViewState {
  std::string source;  ///< "game.raw", or "live: udpm://…"
  bool is_live = false;
  SensorSize sensor;
  Timestamp time;
  double seconds = 0;  ///< The same, since the first event.
  /// Increases whenever time may have gone back (seek, another camera run): then older samples are
  /// of another run.
  std::int64_t run = 0;

  std::optional<ViewPlayback> playback;  ///< Recordings only.
  std::vector<std::string> trackers;     ///< What a side can show; "off" is always possible.
  std::array<std::string, kViewSides> chosen;

  double events_per_s = 0;  ///< Of the newest sample's last second.
  std::array<std::optional<PuckEstimate>, kViewSides> estimates;
  std::array<std::optional<double>, kViewSides> errors_px;
  std::vector<ChartSample> samples;  ///< Newer than the asked time, oldest first.

  std::vector<ViewLatency> latencies;
  std::vector<ViewService> services;
  std::vector<ViewChannel> channels;
  std::vector<ViewMessage> messages;  ///< Those that hold now, the worst first.
};

/// The whole recording at a glance.
struct ViewTimeline {
  struct Span {
    Timestamp begin;
    Timestamp end;
  };

  Timestamp first;
  Timestamp last;                    ///< So far, unless complete.
  bool is_complete = false;          ///< The whole recording has been counted.
  std::int64_t bin_us = 0;           ///< Width of a bin; 0: no events yet.
  std::vector<std::int64_t> events;  ///< In each bin from `first` on; at most 2000.
  /// Parts that the trackers have run over since the choice of the tracker, in which the puck was
  /// lost.
  std::array<std::vector<Span>, kViewSides> losses;
  std::array<std::vector<Span>, kViewSides> examined;
};

}  // namespace puck
