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

}  // namespace

CameraService::CameraService(const CameraSettings& settings, ServiceContext& context)
    : settings_(settings),
      context_(context),
      source_(make_source()),
      is_paced_(settings.is_paced()),
      replay_(is_paced_ ? std::make_optional<Replay>(settings.replay, *source_) : std::nullopt),
      controls_(replay_ ? &*replay_ : nullptr, context),
      watch_(context.limited_log),
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
  if (settings_.is_recorded() && settings_.file.file != "-") controls_.use_keys();
  do {
    if (!play(stop)) {
      say_end("stopped");
      return;
    }
    for (const std::string& warning : source_->warnings()) context_.log.warn(warning);
    say_end("the source has ended");
  } while (settings_.at_end == "wait" && wait_at_end(stop));
}

void CameraService::say_end(const std::string& what) {
  std::string text =
      fmt::format("{} after {} events", what,
                  publisher_ ? publisher_->packer().events_packed() : std::int64_t{0});
  const LatencySummary late = replay_ ? replay_->lateness() : LatencySummary{};
  if (late.samples > 0) {
    text +=
        fmt::format("; {} packets, behind their schedule by {} µs (p50), {} µs (p99), {} µs (max)",
                    late.samples, late.p50_us, late.p99_us, late.max_us);
  }
  context_.log.info(text);
  if (!filter_) return;
  for (const auto& [count, reason] : filter_->left_out().reasons()) {
    if (count > 0) context_.log.info(fmt::format("{} events {} were left out", count, reason));
  }
}

// Returns true at the end of the source, false after a stop request.
bool CameraService::play(std::stop_token stop) {
  while (!stop.stop_requested()) {
    serve_bus();
    const bool searches = replay_ && replay_->is_searching();
    if (searches || !has_chunk_) {
      const EventSource::Outcome outcome = source_->next(searches ? sought_ : chunk_);
      look_at_source();
      if (outcome == EventSource::Outcome::kEnd) {
        if (searches) {  // Of a pipe, which cannot return; what was read before is played.
          end_search(false);
        } else if (send_rest(stop)) {
          return true;
        }
        continue;
      }
      if (!take(outcome)) continue;
    }
    if (send_chunk(stop)) has_chunk_ = false;
  }
  return false;
}

// Returns whether there is a chunk to be sent.
bool CameraService::take(EventSource::Outcome outcome) {
  if (outcome == EventSource::Outcome::kEvents) {
    if (replay_ && replay_->is_searching()) {
      std::swap(chunk_, sought_);
      end_search(true);
    }
    has_chunk_ = true;
    chunk_used_ = 0;
    if (!publisher_) prepare(*source_->sensor_size());
    filter_->apply(chunk_.packet);
    return true;
  }
  if (outcome == EventSource::Outcome::kNotFound) {
    end_search(false);
    return has_chunk_;
  }
  if (replay_ && (replay_->is_searching() || replay_->is_paused())) return false;
  if (batcher_ && !batcher_->batch().empty() &&
      Clock::now() - batch_began_ >= microseconds(batcher_->age_limit_us())) {
    publish_batch();
  }
  if (Clock::now() - last_events_ >= kSilent) say_waiting(source_->waiting_for());
  return false;
}

void CameraService::end_search(bool is_found) {
  replay_->end_search(is_found, Clock::now());
  controls_.end_search(is_found);
  if (!is_found) return;
  batcher_->clear();
  filter_->forget_times();
}

// Of a source that has ended. Returns false after a stop request or for a search.
bool CameraService::send_rest(std::stop_token stop) {
  if (!batcher_ || batcher_->batch().empty()) return true;
  if (is_paced_ && !wait_until(batcher_->batch().newest(), stop)) return false;
  publish_batch();
  return true;
}

// A search interrupts all waits; what waits goes on if it fails.
bool CameraService::is_interrupted(const std::stop_token& stop) const {
  return stop.stop_requested() || (replay_ && replay_->is_searching());
}

// Returns false after a stop request or for a search; called again, it goes on.
bool CameraService::send_chunk(std::stop_token stop) {
  if (chunk_.session_from && !begin_session(stop)) return false;
  waits_for_.clear();
  last_events_ = Clock::now();
  if (is_paced_ && !replay_->is_begun()) {
    replay_->begin(chunk_.packet.empty() ? chunk_.until : chunk_.packet.start, Clock::now());
  }
  if (std::exchange(chunk_.new_clock, false)) live_zero_ = {};
  if (!is_paced_ && !chunk_.packet.empty()) {
    live_zero_.add(chunk_.until, chunk_.came_utime != 0 ? chunk_.came_utime : host_utime());
  }

  while (true) {
    const bool was_empty = batcher_->batch().empty();
    batcher_->take(chunk_.packet, chunk_used_);
    if (was_empty && !batcher_->batch().empty()) {
      batch_began_ = Clock::now();
      skip_gap();
    }
    if (!batcher_->is_complete(chunk_.until)) break;
    if (is_paced_ && !wait_until(batcher_->due(), stop)) return false;
    if (!wait_for_turn(stop)) return false;
    publish_batch();
  }
  return !is_paced_ || wait_until(chunk_.until, stop);
}

// Receivers follow a new session only behind a silence. Returns as send_chunk().
bool CameraService::begin_session(std::stop_token stop) {
  if (!send_rest(stop)) return false;
  constexpr microseconds kSilence{SinglePublisher::kSilentAfterUs + 100'000};
  while (publisher_->packets_sent() > 0 && Clock::now() - sent_at_ < kSilence) {
    if (is_interrupted(stop)) return false;
    serve_bus();
    std::this_thread::sleep_until(bus_due_);
  }
  context_.bus.begin_session();
  publisher_->begin_session();
  dropped_before_session_ = events_dropped();
  context_.log.info(fmt::format("session {} begins at {}", context_.bus.session(),
                                seconds_text(source_->position_us(*chunk_.session_from))));
  if (replay_) replay_->begin(*chunk_.session_from, Clock::now());
  live_zero_ = {};
  chunk_.session_from.reset();
  return true;
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
  batcher_.emplace(static_cast<std::size_t>(publisher_->packer().max_events()), settings_.flush_us,
                   settings_.quiet_flush_us);
  set_ages();
  context_.log.info(fmt::format("sensor {}x{}, packets of up to {} bytes", sensor.width,
                                sensor.height, packet_bytes));
}

// Of packets, in sensor time.
void CameraService::set_ages() {
  ages_speed_ = replay_ ? replay_->speed() : 1;
  const auto age_us = [&](int host_us) {
    return std::max<std::int64_t>(1, std::llround(host_us * ages_speed_));
  };
  batcher_->set_ages(age_us(settings_.flush_us), age_us(settings_.quiet_flush_us));
}

// Handles messages meanwhile. Returns false after a stop request or for a search.
bool CameraService::wait_until(Timestamp time, std::stop_token stop) {
  serve_bus();
  while (!is_interrupted(stop)) {
    const Clock::time_point now = Clock::now();
    const auto due = replay_->due(time, now);
    if (due && now >= *due) {
      gap_end_.reset();
      note_pace(time);
      return true;
    }
    if (!due) {
      gap_end_.reset();
    } else if (gap_end_ || *due - now > kSilent) {
      wait_through_gap(time, *due);
    }
    std::this_thread::sleep_until(due ? std::min(std::max(*due, now + kShortestSleep), bus_due_)
                                      : bus_due_);
    serve_bus();
  }
  gap_end_.reset();
  return false;
}

void CameraService::skip_gap() {
  if (!replay_) return;
  const std::int64_t gap_us = replay_->skip_gap(batcher_->batch().start, Clock::now());
  if (gap_us > 0) context_.log.info("skipped a gap of " + seconds_text(gap_us));
}

void CameraService::wait_through_gap(Timestamp until, Clock::time_point due) {
  gap_end_ = due;
  if (std::exchange(gap_told_, until) == until) return;
  context_.log.info("waiting " + gap_text() + "; camera.skip_gaps_s skips gaps");
}

std::string CameraService::gap_text() const {
  const std::chrono::duration<double> left = *gap_end_ - Clock::now();
  return fmt::format("for the next events in {:.0f} s", std::max(0.0, left.count()));
}

// Handles messages meanwhile. Returns false after a stop request or for a search.
bool CameraService::wait_for_turn(std::stop_token stop) {
  while (!is_interrupted(stop)) {
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
  controls_.poll(has_ended_);
  if (batcher_ && replay_ && replay_->speed() != ages_speed_) set_ages();
  show_state();
  poll_status(context_, *this);
}

void CameraService::look_at_source() {
  watch_.look(*source_);
  if (is_paced_) return;
  if (watch_.overflows()) note_trouble("drops events: more arrive than can be published");
}

void CameraService::say_waiting(const std::string& for_what) {
  if (for_what.empty() || for_what == waits_for_) return;
  waits_for_ = for_what;
  context_.limited_log.warn("waiting", "for " + for_what);
}

void CameraService::note_pace(Timestamp time) {
  const bool has_slipped = replay_->note(time, Clock::now());
  if (!has_slipped && replay_->lateness_us() <= kLateUs) return;
  context_.limited_log.warn(
      "pace", "cannot keep up: " + std::to_string(replay_->lateness_us() / 1000) + " ms late; " +
                  std::to_string(replay_->slipped_us() / 1000) +
                  " ms of delay accepted so far (the time mapping has moved)");
  note_trouble("cannot keep up with the sensor's clock");
}

void CameraService::note_trouble(const std::string& what) {
  trouble_ = what;
  last_trouble_ = Clock::now();
}

// The only place that decides what STATUS tells.
void CameraService::show_state() {
  const std::string place = controls_.place();
  const bool is_searching = replay_ && replay_->is_searching();
  const bool is_paused = replay_ && replay_->is_paused() && !place.empty();
  ServiceState state = ServiceState::kWaiting;
  std::string text = place;
  if (has_ended_ && !is_searching) {
    text = "the source has ended";
  } else if (!is_searching && !is_paused) {
    if (gap_end_) {
      text = gap_text();
    } else if (!waits_for_.empty()) {
      text = "for " + waits_for_;
    } else {
      state = publisher_ ? ServiceState::kRunning : ServiceState::kStarting;
    }
  }
  if (!trouble_.empty() && Clock::now() - last_trouble_ <= kRecovered) {
    state = ServiceState::kDegraded;
    text = trouble_ + (text.empty() ? "" : "; " + text);
  }
  context_.status.set_state(state, text);
}

void CameraService::publish_batch() {
  publisher_->publish(
      batcher_->batch(),
      {sensor_zero_utime(), events_dropped() - dropped_before_session_, settings_.is_recorded()});
  batcher_->clear();
  sent_at_ = Clock::now();
  if (replay_) replay_->note_sent(sent_at_);
}

// Unusable ones; what the filter leaves out by its settings counts on its own.
std::int64_t CameraService::events_dropped() const {
  return source_->events_dropped() + (publisher_ ? publisher_->packer().events_outside() : 0) +
         (filter_ ? filter_->left_out().outside_sensor : 0);
}

std::int64_t CameraService::sensor_zero_utime() const {
  // Times before 1970 are not valid on the wire.
  return std::max<std::int64_t>(0, replay_ ? replay_->sensor_zero_utime() : live_zero_.utime());
}

void CameraService::publish_truth(const SimulatedTruth& truth) {
  const PictureTurn& turn = settings_.filter.turn;
  GroundTruth message = to_truth_message(truth, settings_.simulation.sensor_size, turn);
  context_.bus.publish(message);
  HeadState head = to_head_message(truth, turn);
  context_.bus.publish(head);
}

// Returns true for a search, false after a stop request.
bool CameraService::wait_at_end(std::stop_token stop) {
  has_ended_ = true;
  while (!is_interrupted(stop)) {
    serve_bus();
    std::this_thread::sleep_until(bus_due_);
  }
  has_ended_ = false;
  return !stop.stop_requested();
}

void CameraService::report(StatusReport& report) const {
  const FilteredEvents left_out = filter_ ? filter_->left_out() : FilteredEvents{};
  report.counters = {
      {"events_sent", publisher_ ? publisher_->packer().events_packed() : 0},
      {"packets_sent", publisher_ ? publisher_->packets_sent() : 0},
      {"events_dropped", events_dropped()},
      {"events_masked", left_out.masked},
      {"malformed_words", source_->malformed_words()},
      {"late_us", replay_ ? replay_->slipped_us() + replay_->lateness_us() : 0},
  };
  controls_.report(report);
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
