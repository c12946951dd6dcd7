#include "services/bridge/bridge_service.h"

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "common/messaging/conversions.h"
#include "services/launch/real_time.h"

namespace puck {
namespace {

constexpr std::chrono::milliseconds kHandle{2};
// In a flood this real-time loop leaves 5 % of the processor to other processes.
constexpr std::chrono::microseconds kLongestDrain{5000};
constexpr std::chrono::microseconds kPause{250};
constexpr std::int64_t kSilentUs = 500'000;
constexpr std::int64_t kWorthALineUs = 200'000;

// Rejections that are worth a warning; a puck out of view is not.
constexpr std::array kSuspicious{EstimateVerdict::kStale,       EstimateVerdict::kOffTable,
                                 EstimateVerdict::kImplausible, EstimateVerdict::kWrongSize,
                                 EstimateVerdict::kBlind,       EstimateVerdict::kMalformed,
                                 EstimateVerdict::kLate,        EstimateVerdict::kOtherPublisher,
                                 EstimateVerdict::kClock,       EstimateVerdict::kClockUnknown};

std::int64_t read_ms(Config& config, const char* key, std::int64_t value_us, std::int64_t lowest_ms,
                     std::int64_t highest_ms) {
  std::int64_t value_ms = value_us / 1000;
  config.read(key, value_ms, lowest_ms, highest_ms);
  return value_ms * 1000;
}

void read_motion(Config& config, PlayBridgeParams& params) {
  config.read("motion.damping_per_s", params.motion.damping_per_s, 0, 100);
  config.read("motion.rail_restitution", params.motion.rail_restitution, 0, 1);
  config.read("motion.rail_grip", params.motion.rail_grip, 0, 1);
  config.read("motion.velocity_noise_m_s", params.motion.velocity_noise_m_s, 0, 100);
  config.read("motion.bounce_spread", params.motion.bounce_spread, 0, 1);

  config.read("filter.position_sigma_m", params.filter.position_sigma_m, 1e-6, 1);
  config.read("filter.error_memory_us", params.filter.error_memory_us, 0, 1'000'000);
  config.read("filter.initial_speed_sigma_m_s", params.filter.initial_speed_sigma_m_s, 0.001, 100);
  config.read("filter.gate_sigmas", params.filter.gate_sigmas, 1, 100);
  config.read("filter.hit_after_us", params.filter.hit_after_us, 0, 1'000'000);
  config.read("filter.jump_after_us", params.filter.jump_after_us, 0, 1'000'000);
  config.read("filter.fastest_m_s", params.filter.fastest_m_s, 0.1, 100);
  params.filter.max_coast_us =
      read_ms(config, "filter.max_coast_ms", params.filter.max_coast_us, 1, 100);

  config.read("intercept.horizon_s", params.intercept.horizon_s, 0.01, 60);
  config.read("intercept.min_approach_m_s", params.intercept.min_approach_m_s, 0.001, 10);
  config.read("intercept.max_bounces", params.intercept.max_bounces, 0, 64);
  config.read("intercept.opponent_after_s", params.intercept.opponent_after_s, 0, 60);

  config.read("strategy.crossing_prior_m", params.strategy.crossing_prior_m, 0.001, 10);
  config.read("strategy.shadow_gain", params.strategy.shadow_gain, 0, 1);
}

}  // namespace

BridgeServiceParams BridgeService::read_params(Config& config) {
  std::string table_file = "config/calibration/simulated_table.toml";
  config.read("bridge.table", table_file);
  BridgeServiceParams params{read_table_file(table_file), {}};
  PlayBridgeParams& play = params.play;
  if (params.table.motion) play.motion = with_constants(play.motion, *params.table.motion);
  config.read("bridge.command_hz", play.command_hz, 20, 1000);
  play.valid_for_us = read_ms(config, "bridge.valid_for_ms", play.valid_for_us, 1, 100);
  config.read("bridge.max_trajectory_hz", play.max_trajectory_hz, 1, 10'000);
  play.probation_us = read_ms(config, "bridge.probation_ms", play.probation_us, 0, 1000);
  config.read("bridge.max_head_deg", play.max_head_deg, 0, 180);
  config.read("bridge.needs_head", play.needs_head);
  play.head.max_ahead_us = read_ms(config, "head.max_ahead_ms", play.head.max_ahead_us, 0, 100);
  play.head.max_gap_us = read_ms(config, "head.max_gap_ms", play.head.max_gap_us, 1, 100);
  EstimateGateParams& gate = play.gate;
  gate.max_age_us = read_ms(config, "bridge.max_age_ms", gate.max_age_us, 1, 100);
  gate.max_clock_error_us =
      read_ms(config, "bridge.max_clock_error_ms", gate.max_clock_error_us, 1, 200);
  config.read("bridge.margin_m", gate.margin_m, 0, 1);
  config.read("bridge.max_speed_m_s", gate.max_speed_m_s, 0.1, 100);
  config.read("bridge.default_sigma_px", gate.default_sigma_px, 0.01, 100);
  config.read("bridge.real_time_priority", params.real_time_priority, 0, 49);
  config.read("bridge.size_tolerance", gate.size_tolerance, 1.1, 100);
  read_motion(config, play);
  return params;
}

BridgeService::BridgeService(const BridgeServiceParams& params, ServiceContext& context)
    : context_(context),
      bridge_(params.play, params.table.table_from_image, params.table.geometry,
              params.table.camera),
      real_time_priority_(params.real_time_priority) {
  context_.peers.need({"puck-tracker", "puck-arm"});
  context_.bus.subscribe<PublishedEstimate>([this](const PublishedEstimate& estimate,
                                                   const Receipt& at) {
    estimate_wait_.record(host_monotonic_us() - at.monotonic_us);
    bridge_.hear(estimate, {at.utime, at.monotonic_us}, context_.status.clock_of(estimate.session));
    last_estimate_us_ = at.monotonic_us;
    // At once, before other messages: the arm waits for it.
    if (command()) estimate_to_command_.record(host_monotonic_us() - at.monotonic_us);
  });
  context_.bus.subscribe<ArmState>([this](const ArmState& state, const Receipt& at) {
    bridge_.hear(state, {at.utime, at.monotonic_us}, context_.status.clock_of(state.session));
  });
  context_.bus.subscribe<HeadState>([this](const HeadState& head, const Receipt& at) {
    bridge_.hear(head, {at.utime, at.monotonic_us});
  });
}

void BridgeService::run(std::stop_token stop) {
  run_in_real_time_and_tell(real_time_priority_, context_.log);
  while (!stop.stop_requested()) {
    handle_messages();
    publish_what_is_due();
    follow_state();
    warn_of_estimates();
    poll_status(context_, *this);
  }
}

void BridgeService::handle_messages() {
  if (context_.bus.handle({}, kLongestDrain) == 0) {
    context_.bus.handle(kHandle, kLongestDrain);
    idle_us_ = host_monotonic_us();
  } else if (host_monotonic_us() - idle_us_ >= kLongestDrain.count()) {
    std::this_thread::sleep_for(kPause);
    idle_us_ = host_monotonic_us();
  }
}

bool BridgeService::command() {
  auto command = bridge_.next_command(host_now());
  if (!command) return false;
  context_.bus.publish(*command);
  return true;
}

void BridgeService::publish_what_is_due() {
  command();
  const HostNow now = host_now();
  if (auto trajectory = bridge_.next_trajectory(now)) context_.bus.publish(*trajectory);
  if (auto game = bridge_.next_game(now)) context_.bus.publish(*game);
}

BridgeService::Standing BridgeService::standing() const {
  const HostNow now = host_now();
  if (last_estimate_us_ == 0 || now.monotonic_us - last_estimate_us_ > kSilentUs) {
    return {ServiceState::kWaiting, "no ESTIMATE"};
  }
  if (bridge_.is_blind_to_head()) {
    return {ServiceState::kDegraded,
            "the head pose is unknown, so the place of the table in the image is unknown"};
  }
  if (!bridge_.hears_arm(now)) return {ServiceState::kWaiting, "no current ARM_STATE"};
  if (const std::int64_t other = bridge_.other_commander(context_.bus.session(), now)) {
    return {ServiceState::kDegraded,
            "the arm obeys another bridge, session " + std::to_string(other)};
  }
  switch (bridge_.probation().doubt()) {
    case TrackProbation::Doubt::kContradicts:
      return {ServiceState::kDegraded,
              "the track is not trusted: its velocity does not match its positions"};
    case TrackProbation::Doubt::kScattered:
      return {ServiceState::kDegraded,
              "the track is not trusted: its position jumps back and forth"};
    case TrackProbation::Doubt::kNew:
    case TrackProbation::Doubt::kNone:
      break;
  }
  return {ServiceState::kRunning, {}};
}

void BridgeService::follow_state() {
  const Standing now = standing();
  context_.status.set_state(now.state, now.text);
  const std::int64_t now_us = host_monotonic_us();
  if (now.text != text_) {
    text_ = now.text;
    text_since_us_ = now_us;
  }
  // Short-lived texts are not logged.
  if (text_ == logged_text_ || now_us - text_since_us_ < kWorthALineUs) return;
  logged_text_ = text_;
  if (text_.empty()) {
    context_.log.info("follows the puck");
  } else {
    context_.log.warn("does not move the arm: " + text_);
  }
}

void BridgeService::warn_of_estimates() {
  std::int64_t suspicious = 0;
  for (const EstimateVerdict verdict : kSuspicious) suspicious += bridge_.gate().count(verdict);
  if (suspicious == warned_of_) return;
  warned_of_ = suspicious;
  std::string text = "estimates not used so far:";
  for (const EstimateVerdict verdict : kSuspicious) {
    const std::int64_t count = bridge_.gate().count(verdict);
    if (count > 0) text += std::string(" ") + to_string(verdict) + " " + std::to_string(count);
  }
  context_.limited_log.warn("estimates", text);
}

void BridgeService::report(StatusReport& report) const {
  report.counters = {
      {"estimates_good", bridge_.gate().count(EstimateVerdict::kGood)},
      {"estimates_not_tracking", bridge_.gate().count(EstimateVerdict::kNotTracking)},
      {"estimates_belated", bridge_.gate().count(EstimateVerdict::kBelated)},
      {"estimates_outliers", bridge_.outliers()},
      {"track_hits", bridge_.hits()},
      {"track_jumps", bridge_.jumps()},
      {"estimates_untrusted", bridge_.untrusted()},
      {"commands_sent", bridge_.commands()},
      {"shots", bridge_.game().shots},
      {"saves", bridge_.game().saves},
      {"goals_against", bridge_.game().goals_against},
  };
  report.add_unless_zero("estimates_frozen", bridge_.frozen());
  report.add_unless_zero("track_leaps", bridge_.probation().leaps());
  report.add_unless_zero("track_contradictions", bridge_.probation().contradictions());
  for (const EstimateVerdict verdict : kSuspicious) {
    report.add_unless_zero(std::string("estimates_") + to_string(verdict),
                           bridge_.gate().count(verdict));
  }
  const LatencySummary latency = estimate_to_command_.summary();
  const LatencySummary wait = estimate_wait_.summary();
  report.latencies = {
      {"estimate_to_command", latency.p50_us, latency.p99_us, latency.max_us, latency.samples},
      {"estimate_wait", wait.p50_us, wait.p99_us, wait.max_us, wait.samples}};
}

}  // namespace puck
