#include "tools/evaluate/replay.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/messaging/conversions.h"
#include "tools/evaluate/estimate_log.h"
#include "tools/evaluate/log_recording.h"
#include "tools/evaluate/replay_feed.h"

namespace puck {
namespace {

// The estimate without host times and host name.
std::vector<std::uint8_t> bytes_of(const PuckEstimate& estimate, SensorSize sensor) {
  PublishedEstimate message{{}, estimate, sensor};
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  return bytes;
}

class Comparer {
 public:
  explicit Comparer(SensorSize sensor) : sensor_(sensor) {}

  void add(const PuckEstimate& recorded, PuckEstimate again) {
    // The tracker also reports `resting` when its camera is silent in host time.
    again.resting = again.resting && recorded.resting;
    ++comparison_.estimates;
    if (bytes_of(again, sensor_) == bytes_of(recorded, sensor_)) ++comparison_.equal;
    if (again.state != recorded.state) ++comparison_.state_differs;
    if (!again.position || !recorded.position) return;
    const double difference = std::hypot(again.position->x - recorded.position->x,
                                         again.position->y - recorded.position->y);
    sum_px_ += difference;
    max_px_ = std::max(max_px_, difference);
    ++positions_;
  }

  ReplayComparison comparison() const {
    ReplayComparison result = comparison_;
    if (positions_ > 0) {
      result.mean_difference_px = sum_px_ / static_cast<double>(positions_);
      result.max_difference_px = max_px_;
    }
    return result;
  }

 private:
  SensorSize sensor_;
  ReplayComparison comparison_;
  std::int64_t positions_ = 0;
  double sum_px_ = 0;
  double max_px_ = 0;
};

void add_notes(const EstimateLog& log, const PublishedEstimate& last, std::int64_t out_of_step,
               std::vector<std::string>& notes) {
  const auto note = [&](std::int64_t count, const std::string& what) {
    if (count > 0) notes.push_back(std::to_string(count) + " " + what);
  };
  note(last.packets.lost, "packets were lost on the way to the recorded tracker");
  note(last.packets.events_skipped,
       "events were skipped by the recorded tracker to reduce its delay");
  note(log.missing(), "estimates are missing in the log, so their queries are unknown");
  note(log.malformed(), "estimates in the log are malformed");
  note(log.of_others(), "estimates in the log are of another tracker, or rest on other events");
  note(out_of_step,
       "estimates rest on other events than the log holds up to there: repeated at their sensor "
       "time");
  if (log.began_anew()) notes.emplace_back("the recorded tracker restarted: compared up to there");
}

}  // namespace

ReplayResult run_replay(EventReader& events, const std::filesystem::path& path,
                        const std::string& prefix, const TrackerSetup& setup,
                        const OnTick& on_tick) {
  EstimateLog log(path, prefix, session_of_event_log(path, prefix));
  PublishedEstimate recorded;
  if (!log.next(recorded)) {
    throw LogFileError(path.string() + ": a log without estimates that rest on its events");
  }
  const std::unique_ptr<TrackingAlgorithm> tracker = setup.make(events.sensor_size());
  ReplayFeed feed(events, *tracker);
  Comparer comparer(events.sensor_size());
  const bool has_start = feed.skip_to_start(recorded.events_applied, recorded.newest_event);
  std::int64_t out_of_step = 0;
  PublishedEstimate last;
  do {
    last = recorded;
    if (!feed.feed(recorded.events_applied, recorded.newest_event)) ++out_of_step;
    const PuckEstimate again = tracker->estimate();
    on_tick({recorded.newest_event, again, std::nullopt});
    comparer.add(recorded, again);
  } while (log.next(recorded));

  ReplayResult result{feed.summary(), comparer.comparison()};
  result.comparison.repeated = log.repeated();
  if (!has_start) {
    result.comparison.notes.emplace_back(
        "the log lacks events that the recorded tracker had before its first estimate");
  }
  add_notes(log, last, out_of_step, result.comparison.notes);
  return result;
}

}  // namespace puck
