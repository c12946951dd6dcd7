#include "services/tracker/track.h"

#include <utility>

#include "common/runtime/live_tracker.h"
#include "common/runtime/stepped_tracker.h"

namespace puck {
namespace {

class LiveTrack final : public Track {
 public:
  LiveTrack(SensorSize sensor, const PipelineParams& pipeline, const TrackerServiceParams& params,
            TrackingThread::Publish publish)
      : tracker_(sensor, pipeline, params.size_model, params.thread, std::move(publish)) {}

  void update(const EventPacket& packet, const PacketOrigin& origin, bool more_waiting) override {
    tracker_.update(packet, origin, more_waiting);
  }
  void poll() override {}  // The second thread does it.
  std::int64_t events_thinned() const override { return tracker_.surface.events_thinned(); }

 private:
  LiveTracker tracker_;
};

class SteppedTrack final : public Track {
 public:
  SteppedTrack(SensorSize sensor, const PipelineParams& pipeline,
               const TrackerServiceParams& params, TrackingThread::Publish publish)
      : tracker_(sensor, pipeline, params.size_model, params.thread, std::move(publish)) {}

  void update(const EventPacket& packet, const PacketOrigin& origin,
              bool /*more_waiting*/) override {
    tracker_.update(packet, origin);
  }
  void poll() override { tracker_.poll(); }
  std::int64_t events_thinned() const override { return 0; }

 private:
  SteppedTracker tracker_;
};

}  // namespace

std::unique_ptr<Track> make_track(SensorSize sensor, const PipelineParams& pipeline,
                                  const TrackerServiceParams& params,
                                  TrackingThread::Publish publish) {
  if (params.reproducible) {
    return std::make_unique<SteppedTrack>(sensor, pipeline, params, std::move(publish));
  }
  return std::make_unique<LiveTrack>(sensor, pipeline, params, std::move(publish));
}

}  // namespace puck
