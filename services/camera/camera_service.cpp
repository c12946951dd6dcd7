#include "services/camera/camera_service.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/messages/host_time.h"
#include "common/messaging/conversions.h"
#include "common/recording/event_log_reader.h"
#include "services/camera/live_source.h"
#include "services/camera/stream_source.h"
#include "services/camera/tcp_source.h"
#include "services/camera/truth_messages.h"
#include "services/camera/yarp_source.h"

namespace puck {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

// Period of handling messages: a compromise between the mallet's age and system calls …
constexpr milliseconds kBusPeriod{1};
// … and without a mallet, where only STATUS waits.
constexpr milliseconds kQuietBusPeriod{10};
// Packets that are due more often are published in groups: waking up for each one would cost more
// than publishing it.
constexpr microseconds kShortestSleep{50};
constexpr std::int64_t kLateUs = 20'000;
// An older ARM_STATE, by its own clock, is not current.
constexpr std::int64_t kArmAgeUs = 200'000;
// Rate that receivers can handle when the camera is late. A packet costs them as much as this
// number of events.
constexpr double kCatchUpMevS = 100;
constexpr std::size_t kPacketCostEvents = 500;
// Trouble is over after this time without a late packet.
constexpr std::chrono::seconds kRecovered{1};
// Shorter silence is normal for a camera.
constexpr std::chrono::seconds kSilent{1};

bool is_paced(const CameraSettings& settings, const EventSource& source) {
  if (settings.pace == "auto") return !source.is_live();
  return settings.pace == "sensor";
}

}  // namespace

CameraService::CameraService(const CameraSettings& settings, ServiceContext& context)
    : settings_(settings),
      context_(context),
      source_(make_source()),
      is_paced_(is_paced(settings, *source_)),
      pacer_(settings.speed),
      limit_(is_paced_ ? kCatchUpMevS : settings.arrival_limit_mev_s) {
  // Unpaced streams must be read in time, whatever else happens, hence on their own thread.
  if (!is_paced_ && settings.is_stream())
    source_ = std::make_unique<LiveSource>(std::move(source_));
  if (const auto sensor = source_->sensor_size()) filter_.emplace(settings_.filter, *sensor);
  if (simulated_) listen_to_arm();
}

std::unique_ptr<EventSource> CameraService::make_source() {
  if (settings_.source == "file") return std::make_unique<FileSource>(settings_.file);
  if (settings_.source == "log") {
    return std::make_unique<FileSource>(
        settings_.file,
        open_event_log(settings_.file.file, settings_.log_prefix, EventLog::Sessions::kJoined));
  }
  if (settings_.source == "stdin") return std::make_unique<StdinSource>(settings_.file.options);
  if (settings_.source == "tcp") {
    auto link = settings_.tcp_role == "server"
                    ? listen_for_clients(settings_.tcp_host, settings_.tcp_port)
                    : connect_to_server(settings_.tcp_host, settings_.tcp_port);
    return std::make_unique<TcpSource>(std::move(link), settings_.file.options);
  }
  if (settings_.source == "yarp") {
    return std::make_unique<YarpSource>(settings_.yarp, settings_.file.options);
  }
  auto simulated = std::make_unique<SimulatedSource>(
      settings_.simulation, 1'000'000 / settings_.truth_hz,
      [this](const SimulatedTruth& truth) { publish_truth(truth); });
  simulated_ = simulated.get();
  return simulated;
}

// A stale, foreign or replayed ARM_STATE does not move the mallet.
void CameraService::listen_to_arm() {
  context_.peers.need({"puck-arm"});
  context_.bus.subscribe<ArmState>([this](const ArmState& state, const Receipt& receipt) {
    const HostNow came{receipt.utime, receipt.monotonic_us};
    const SenderClock arm_clock = context_.status.clock_of(state.session);
    if (freshness_of(state.utime, came, arm_clock, kArmAgeUs) != Freshness::kOfNow) return;
    const auto verdict = arm_.hear(state.session, state.seq, receipt.monotonic_us);
    if (verdict == SinglePublisher::Verdict::kLate ||
        verdict == SinglePublisher::Verdict::kOtherPublisher) {
      return;
    }
    simulated_->set_robot_mallet(state.position_m);
  });
}

void CameraService::run(std::stop_token stop) {
  if (!play(stop)) return;
  for (const std::string& warning : source_->warnings()) context_.log.warn(warning);
  context_.log.info(
      fmt::format("the source has ended after {} events",
                  publisher_ ? publisher_->packer().events_packed() : std::int64_t{0}));
  say_left_out();
  if (settings_.at_end == "wait") wait_at_end(stop);
}

void CameraService::say_left_out() {
  if (!filter_) return;
  for (const auto& [count, reason] : filter_->left_out().reasons()) {
    if (count > 0) context_.log.info(fmt::format("{} events {} were left out", count, reason));
  }
}

// Returns true at the end of the source, false after a stop request.
bool CameraService::play(std::stop_token stop) {
  while (!stop.stop_requested()) {
    serve_bus();
    const EventSource::Outcome outcome = source_->next(chunk_);
    warn_of_drops();
    warn_of_lost_messages();
    watch_overflow();
    switch (outcome) {
      case EventSource::Outcome::kEvents:
        if (!send_chunk(stop)) return false;
        break;
      case EventSource::Outcome::kNothingYet:
        if (batcher_ && !batcher_->batch().empty() &&
            Clock::now() - batch_began_ >= microseconds(batcher_->age_limit_us())) {
          publish_batch();
        }
        if (Clock::now() - last_events_ >= kSilent) say_waiting(source_->waiting_for());
        break;
      case EventSource::Outcome::kEnd:
        if (batcher_ && !batcher_->batch().empty()) {
          if (is_paced_ && !wait_until(batcher_->batch().newest(), stop)) return false;
          publish_batch();
        }
        return true;
    }
  }
  return false;
}

// Returns false after a stop request.
bool CameraService::send_chunk(std::stop_token stop) {
  if (!publisher_) prepare(*source_->sensor_size());
  filter_->apply(chunk_.packet);
  if (context_.status.state() == ServiceState::kStarting ||
      context_.status.state() == ServiceState::kWaiting) {
    context_.status.set_state(ServiceState::kRunning);
  }
  last_events_ = Clock::now();
  if (is_paced_ && !pacer_.is_started()) {
    const Timestamp first = chunk_.packet.empty() ? chunk_.until : chunk_.packet.start;
    pacer_.start(first, Clock::now());
    pacer_zero_utime_ = host_utime() - first.us;
  }
  if (chunk_.new_clock) live_zero_ = {};
  if (!is_paced_ && !chunk_.packet.empty()) {
    live_zero_.add(chunk_.until, chunk_.came_utime != 0 ? chunk_.came_utime : host_utime());
  }

  std::size_t next = 0;
  while (true) {
    const bool was_empty = batcher_->batch().empty();
    batcher_->take(chunk_.packet, next);
    if (was_empty && !batcher_->batch().empty()) batch_began_ = Clock::now();
    if (!batcher_->is_complete(chunk_.until)) break;
    if (is_paced_ && !wait_until(batcher_->due(), stop)) return false;
    if (!wait_for_turn(stop)) return false;
    publish_batch();
  }
  return !is_paced_ || wait_until(chunk_.until, stop);
}

void CameraService::prepare(SensorSize source_sensor) {
  if (!filter_) filter_.emplace(settings_.filter, source_sensor);
  const SensorSize sensor = filter_->sensor();
  const LcmUrl& url = context_.bus.url();
  const bool is_local = url.in_memory || url.ttl == 0;
  const int packet_bytes = settings_.packet_bytes != 0 ? settings_.packet_bytes
                           : is_local                  ? EventPackerParams::kMaxBytes
                                                       : EventPackerParams::kOneFrame;
  const auto overhead = static_cast<int>(context_.bus.overhead_bytes());
  publisher_.emplace(
      context_.bus,
      EventPackerParams{sensor, std::max(packet_bytes - overhead, EventPackerParams::kMinBytes)});
  const double speed = is_paced_ ? settings_.speed : 1;
  const auto window_us = [&](int host_us) {
    return std::max<std::int64_t>(1, std::llround(host_us * speed));
  };
  batcher_.emplace(static_cast<std::size_t>(publisher_->packer().max_events()),
                   window_us(settings_.flush_us), window_us(settings_.quiet_flush_us));
  context_.log.info(fmt::format("sensor {}x{}, packets of up to {} bytes", sensor.width,
                                sensor.height, packet_bytes));
}

// Handles messages meanwhile. Returns false after a stop request.
bool CameraService::wait_until(Timestamp time, std::stop_token stop) {
  while (true) {
    if (stop.stop_requested()) return false;
    serve_bus();
    const Clock::time_point due = pacer_.due(time);
    const Clock::time_point now = Clock::now();
    if (now >= due) break;
    if (due - now > kSilent) say_waiting("the end of a gap in the recording's time stamps");
    std::this_thread::sleep_until(std::min(std::max(due, now + kShortestSleep), bus_due_));
  }
  note_pace(time);
  return true;
}

// Handles messages meanwhile. Returns false after a stop request.
bool CameraService::wait_for_turn(std::stop_token stop) {
  while (!stop.stop_requested()) {
    serve_bus();
    const Clock::time_point now = Clock::now();
    if (now >= limit_.due()) {
      limit_.count(batcher_->batch().events.size() + (is_paced_ ? kPacketCostEvents : 0), now);
      return true;
    }
    std::this_thread::sleep_until(std::min(limit_.due(), now + kBusPeriod));
  }
  return false;
}

void CameraService::serve_bus() {
  const auto now = Clock::now();
  if (now < bus_due_) return;
  bus_due_ = now + (simulated_ != nullptr ? kBusPeriod : kQuietBusPeriod);
  context_.bus.handle(milliseconds(0));
  poll_status(context_, *this);
}

void CameraService::say_waiting(const std::string& for_what) {
  if (for_what.empty()) return;
  const std::string text = "for " + for_what;
  if (context_.status.state() == ServiceState::kWaiting && context_.status.state_text() == text) {
    return;
  }
  context_.limited_log.warn("waiting", text);
  context_.status.set_state(ServiceState::kWaiting, text);
}

void CameraService::note_pace(Timestamp time) {
  const std::int64_t slipped_before_us = pacer_.slipped_us();
  const bool has_slipped = pacer_.note(time, Clock::now());
  pacer_zero_utime_ += pacer_.slipped_us() - slipped_before_us;
  if (has_slipped || pacer_.lateness_us() > kLateUs) {
    context_.limited_log.warn(
        "pace", "cannot keep up: " + std::to_string(pacer_.lateness_us() / 1000) + " ms late; " +
                    std::to_string(pacer_.slipped_us() / 1000) +
                    " ms of delay accepted so far (the time mapping has moved)");
    note_trouble("cannot keep up with the sensor's clock");
  } else {
    note_recovery();
  }
}

void CameraService::note_trouble(const std::string& what) {
  last_trouble_ = Clock::now();
  if (context_.status.state() != ServiceState::kDegraded) {
    context_.status.set_state(ServiceState::kDegraded, what);
  }
}

void CameraService::note_recovery() {
  if (context_.status.state() == ServiceState::kDegraded &&
      Clock::now() - last_trouble_ > kRecovered) {
    context_.status.set_state(ServiceState::kRunning);
  }
}

void CameraService::publish_batch() {
  publisher_->publish(batcher_->batch(),
                      {sensor_zero_utime(), events_dropped(), settings_.is_recorded()});
  batcher_->clear();
}

// Unusable ones; what the filter leaves out by its settings counts on its own.
std::int64_t CameraService::events_dropped() const {
  return source_->events_dropped() + (publisher_ ? publisher_->packer().events_outside() : 0) +
         (filter_ ? filter_->left_out().outside_sensor : 0);
}

std::int64_t CameraService::sensor_zero_utime() const {
  // At another speed, sensor time has no fixed zero on the host's clock.
  if (is_paced_ && settings_.speed != 1) return 0;
  // Times before 1970 are not valid on the wire.
  return std::max<std::int64_t>(0, is_paced_ ? pacer_zero_utime_ : live_zero_.utime());
}

void CameraService::publish_truth(const SimulatedTruth& truth) {
  const PictureTurn& turn = settings_.filter.turn;
  GroundTruth message = to_truth_message(truth, settings_.simulation.sensor_size, turn);
  context_.bus.publish(message);
  HeadState head = to_head_message(truth, turn);
  context_.bus.publish(head);
}

void CameraService::warn_of_drops() {
  const std::int64_t drops = source_->events_dropped() + source_->malformed_words();
  if (drops == drops_told_) return;
  drops_told_ = drops;
  context_.limited_log.warn(
      "input", std::to_string(source_->events_dropped()) + " events dropped, " +
                   std::to_string(source_->malformed_words()) + " malformed words so far");
}

void CameraService::warn_of_lost_messages() {
  const auto port = source_->port_counts();
  if (!port || port->lost + port->malformed == messages_told_) return;
  messages_told_ = port->lost + port->malformed;
  context_.limited_log.warn("port", std::to_string(port->lost) + " messages of " +
                                        std::to_string(port->messages) + " were lost, " +
                                        std::to_string(port->malformed) + " held no events");
}

void CameraService::watch_overflow() {
  if (is_paced_) return;
  const std::int64_t overflowed = source_->events_overflowed();
  if (std::exchange(overflow_seen_, overflowed) != overflowed) {
    note_trouble("drops events: more arrive than can be published");
  } else {
    note_recovery();
  }
}

void CameraService::wait_at_end(std::stop_token stop) {
  context_.status.set_state(ServiceState::kWaiting, "the source has ended");
  while (!stop.stop_requested()) {
    context_.bus.handle(milliseconds(10));
    poll_status(context_, *this);
  }
}

void CameraService::report(StatusReport& report) const {
  const FilteredEvents left_out = filter_ ? filter_->left_out() : FilteredEvents{};
  report.counters = {
      {"events_sent", publisher_ ? publisher_->packer().events_packed() : 0},
      {"packets_sent", publisher_ ? publisher_->packets_sent() : 0},
      {"events_dropped", events_dropped()},
      {"events_masked", left_out.masked},
      {"malformed_words", source_->malformed_words()},
      {"late_us", pacer_.slipped_us() + pacer_.lateness_us()},
  };
  report.add_unless_zero("events_outside_crop", left_out.outside_crop);
  report.add_unless_zero("events_other_polarity", left_out.other_polarity);
  report.add_unless_zero("events_refractory", left_out.refractory);
  report.add_unless_zero("events_background", left_out.background);
  report.add_unless_zero("events_outside_picture", left_out.outside_picture);
  if (const auto port = source_->port_counts()) {
    report.counters.insert(report.counters.end(), {{"port_connections", port->connections},
                                                   {"port_failures", port->failures},
                                                   {"port_messages", port->messages},
                                                   {"port_messages_lost", port->lost},
                                                   {"port_messages_malformed", port->malformed}});
  }
}

}  // namespace puck
