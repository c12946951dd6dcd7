#include "tools/evaluate/picture_taker.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace puck {
namespace {

// Enough ticks for a smooth trail.
constexpr std::int64_t kTrailStepUs = 1000;

double speed_of(const PuckEstimate& estimate) {
  return std::hypot(estimate.velocity.x, estimate.velocity.y);
}

// Before the run, so that an unwritable path costs no result.
void require_writable(const std::filesystem::path& path) {
  if (path.extension() != ".png") {
    throw std::runtime_error(path.string() + ": a picture is a PNG: give a name that ends in .png");
  }
  std::error_code error;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, error)) {
    throw std::runtime_error(path.string() + ": cannot be written, as there is no folder " +
                             folder.string());
  }
  const bool exists = std::filesystem::exists(path, error);
  if (std::filesystem::is_directory(path, error) ||
      access(exists ? path.c_str() : folder.c_str(), W_OK) != 0) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
}

Timestamp first_event_of(EventReader& events) {
  EventPacket packet;
  const bool any = events.read(packet, 1);
  events.rewind();
  return any ? packet.newest() : Timestamp{};
}

EventPacket events_until(EventReader& events, Timestamp time) {
  EventPacket packet;
  EventPacket result;
  result.start = time - TrackedMoment::kEventsUs;
  events.rewind();
  while (events.read(packet, EventReader::kUsualEvents)) {
    for (Event event : packet.events) {
      const Timestamp at = packet.time_of(event);
      if (at > time) return result;
      if (at <= result.start) continue;
      event.offset_us = static_cast<std::uint32_t>(at - result.start);
      result.events.push_back(event);
    }
  }
  return result;
}

}  // namespace

PictureTaker::PictureTaker(std::filesystem::path path, std::optional<double> at_s,
                           EventReader& events)
    : path_(std::move(path)), first_(first_event_of(events)) {
  require_writable(path_);
  if (at_s) at_ = first_ + std::llround(*at_s * 1e6);
}

bool PictureTaker::is_wanted(const EvaluatedTick& tick) const {
  if (at_) return true;
  return tick.estimate.state == TrackState::kTracking && !tick.estimate.coasting &&
         (!moment_ || speed_of(tick.estimate) > speed_of(moment_->estimate));
}

void PictureTaker::add(const EvaluatedTick& tick) {
  if (at_ && tick.tick > *at_) return;
  if (trail_.empty() || tick.tick - trail_.back().time >= kTrailStepUs) {
    std::erase_if(trail_, [&](const TrackedMoment::TrailPoint& point) {
      return tick.tick - point.time > TrackedMoment::kTrailUs;
    });
    trail_.push_back({tick.tick, tick.estimate.position});
  }
  if (!is_wanted(tick)) return;
  if (!moment_) moment_.emplace();
  moment_->time = tick.tick;
  moment_->estimate = tick.estimate;
  moment_->trail = trail_;
}

TrackedMoment PictureTaker::moment(EventReader& events, const RunSummary& run,
                                   const TruthTrack* truth) const {
  // The end in the message is rounded to ms.
  if (at_ && *at_ - run.last > 1000) {
    char end[32];
    std::snprintf(end, sizeof end, "%.3f", run.duration_s);
    throw std::invalid_argument(std::string("--picture-at: the recording ends before, after ") +
                                end + " s: give a time within it");
  }
  if (!moment_) {
    throw std::invalid_argument(
        at_ ? "--picture-at: there is no estimate yet at that time: give a later one"
            : "--picture: the puck was never tracked: choose a time with --picture-at");
  }
  TrackedMoment moment = *moment_;
  moment.sensor = events.sensor_size();
  moment.seconds = static_cast<double>(moment.time - first_) * 1e-6;
  moment.events = events_until(events, moment.time);
  if (truth != nullptr) moment.truth = truth->at(moment.time);
  return moment;
}

}  // namespace puck
