#include "tools/play/closed_loop.h"

namespace puck {

ClosedLoop::ClosedLoop(const PlaySetup& setup, std::int64_t seed)
    : setup_(setup),
      court_(make_court(setup, seed)),
      link_(setup.link, seed),
      bridge_(setup.bridge, setup.table.table_from_image, setup.table.geometry, setup.table.camera),
      arm_(setup.arm) {
  if (setup.source == EstimateSource::kFrames) {
    frames_.emplace(setup.frames, setup.world.sensor_size, seed);
  }
}

void ClosedLoop::step() {
  court_->advance();
  look();
  deliver();
  const HostNow now = host_time_of(this->now());
  if (setup_.world.moving_camera) hear_head();
  if (const auto state = arm_.next_state(this->now())) bridge_.hear(*state, now, kSameClock);
  if (auto command = bridge_.next_command(now)) {
    command->utime = now.utime;
    command->session = kBridgeSession;
    command->seq = commands_++;
    target_m_ = command->target_m;
    arm_.controller().hear(*command, now, kSameClock);
  }
  if (on_trajectory_) {
    if (const auto trajectory = bridge_.next_trajectory(now)) on_trajectory_(*trajectory);
  }
  arm_.step_until(this->now());
  court_->set_robot_mallet(arm_.controller().position_m());
}

void ClosedLoop::look() {
  if (frames_) {
    if (const auto estimate = frames_->watch(truth())) send(*estimate, frames_->delay_us());
  } else if (link_.is_due(now().us)) {
    send(court_->estimate(), 0);
  }
}

void ClosedLoop::send(const PuckEstimate& estimate, std::int64_t extra_us) {
  if (on_estimate_) on_estimate_(estimate);
  PublishedEstimate sent{{host_time_of(now()).utime, kTrackerSession, estimates_++}, estimate};
  sent.sensor = setup_.world.sensor_size;
  sent.events_session = kCameraSession;
  sent.event_utime = host_time_of(estimate.newest_event).utime;
  sent.is_live = true;
  link_.send(sent, now().us, extra_us);
}

void ClosedLoop::deliver() {
  const HostNow now = host_time_of(this->now());
  while (const auto estimate = link_.receive(this->now().us)) {
    is_tracked_ = estimate->state == TrackState::kTracking;
    bridge_.hear(*estimate, now, kSameClock);
    arm_.controller().hear(*estimate, now, kSameClock);
  }
}

void ClosedLoop::hear_head() {
  const HostNow host = host_time_of(now());
  bridge_.hear({{host.utime, kCameraSession, heads_++}, truth().head, now()}, host);
}

}  // namespace puck
