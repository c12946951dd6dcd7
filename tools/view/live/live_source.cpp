#include "tools/view/live/live_source.h"

#include <span>
#include <string_view>
#include <utility>

#include "common/messaging/event_packet_view.h"
#include "common/messages/host_time.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

// Long enough for a page that is loaded again.
constexpr std::int64_t kStayAfterViewer_us = 10'000'000;
constexpr std::int64_t kCountersPeriod_us = 100'000;
constexpr milliseconds kStep{20};
// Estimates come up to 5000 times a second: taken in batches, unless so much arrives that the
// socket's buffer, of 200 kB at least, could fill meanwhile.
constexpr milliseconds kRest{2};
constexpr std::size_t kMostBeforeRest_bytes = 50'000;
// So that a viewer never waits long for the mutex.
constexpr milliseconds kLongestStep{10};

template <typename Message>
void decode_and_take(std::span<const std::uint8_t> bytes, std::int64_t now_us, LiveView& view) {
  Message message;
  decode_checked(bytes, message);
  view.take(message, now_us);
}

/// `bytes` have passed all checks.
void take(Channel channel, std::span<const std::uint8_t> bytes, std::int64_t now_us,
          LiveView& view) {
  switch (channel) {
    case Channel::kEvents:
      return decode_and_take<EventPacketView>(bytes, now_us, view);
    case Channel::kEstimate:
      return decode_and_take<puck_estimate_t>(bytes, now_us, view);
    case Channel::kTrajectory:
      return decode_and_take<puck_trajectory_t>(bytes, now_us, view);
    case Channel::kArmState:
      return decode_and_take<arm_state_t>(bytes, now_us, view);
    case Channel::kGame:
      return decode_and_take<game_state_t>(bytes, now_us, view);
    case Channel::kTruth:
      return decode_and_take<ground_truth_t>(bytes, now_us, view);
    default:
      return;
  }
}

}  // namespace

LiveSource::LiveSource(LiveOptions options) : options_(std::move(options)), doctor_(options_.bus) {
  const Bus checked(options_.bus);  // Opens nothing.
  if (options_.size_model) heat_map_.emplace(*options_.size_model);
  thread_ = std::jthread([this](const std::stop_token& stop) { listen(stop); });
}

bool LiveSource::fill(const PictureWishes& wishes, ViewScene& scene) {
  note_viewer();
  {
    const std::lock_guard lock(mutex_);
    if (!stay_ || !stay_->view.fill(wishes, host_monotonic_us(), scene)) return false;
  }
  if (wishes.view != PictureWishes::View::kCamera ||
      wishes.backdrop != PictureWishes::Backdrop::kHeatMap) {
    return true;
  }
  const std::lock_guard lock(heat_mutex_);
  if (heat_map_) {
    heat_map_->fill(scene.surface, scene.heat);
  } else {
    scene.no_backdrop = "no heat map: " + options_.no_size_model;
  }
  return true;
}

ViewState LiveSource::state(Timestamp since, std::int64_t run) {
  note_viewer();
  const std::int64_t now_us = host_monotonic_us();
  ViewState state;
  state.source = "live: " + options_.bus.url +
                 (options_.bus.prefix.empty() ? "" : ", prefix " + options_.bus.prefix);
  state.is_live = true;
  const std::lock_guard lock(mutex_);
  LiveFacts facts{.network_problem = network_problem_, .prefix = options_.bus.prefix};
  BusSnapshot snapshot;
  if (stay_) {
    snapshot = this->snapshot(now_us);
    stay_->view.add_to(state, since, run, now_us);
    facts.sensor = stay_->view.sensor();
    facts.other_sensor = stay_->view.other_sensor();
    if (const auto heard = stay_->view.events_heard_us()) facts.events_age_us = now_us - *heard;
    if (is_silent(snapshot)) {
      doctor_.ask(now_us);
      facts.doctor = doctor_.answer();
    }
  }
  for (const ChannelRow& row : snapshot.channels) {
    if (row.type == Channel::kEvents) state.events_per_s = row.events_per_s;
  }
  state.services = view_services(snapshot);
  state.channels = view_channels(snapshot);
  state.messages = live_messages(snapshot, facts);
  return state;
}

std::string LiveSource::control(const ViewControl&) {
  return "a live camera cannot be paused; open the recording or log instead: puck-view FILE";
}

void LiveSource::wait_for_change(std::uint64_t seen, milliseconds timeout) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, timeout, [&] { return version() != seen; });
}

void LiveSource::note_viewer() {
  const bool was_away = !somebody_looks();
  looked_us_.store(host_monotonic_us(), std::memory_order_relaxed);
  if (!was_away) return;
  // Locked, so that the thread does not miss it between its look and its sleep.
  const std::lock_guard lock(mutex_);
  news_.notify_all();
}

bool LiveSource::somebody_looks() const {
  const std::int64_t looked_us = looked_us_.load(std::memory_order_relaxed);
  return looked_us != 0 && host_monotonic_us() - looked_us < kStayAfterViewer_us;
}

void LiveSource::listen(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex_);
      if (!news_.wait(lock, stop, [this] { return somebody_looks(); })) return;
    }
    stay_on_bus(stop);
  }
}

void LiveSource::stay_on_bus(const std::stop_token& stop) {
  Bus bus(options_.bus);
  bus.subscribe_all([this](std::string_view channel, std::span<const std::uint8_t> bytes,
                           const Receipt& receipt) { hear(channel, bytes, receipt); });
  const auto say = [this](const std::string& reason) {
    const std::lock_guard lock(mutex_);
    network_problem_ = reason;
  };
  if (!bus.start(stop, say)) return;
  {
    const std::lock_guard lock(mutex_);
    network_problem_.clear();
    stay_.emplace(options_.bus.prefix, host_monotonic_us());
  }
  std::int64_t counted_us = 0;
  while (!stop.stop_requested() && somebody_looks()) {
    received_bytes_ = 0;
    if (bus.handle(kStep, kLongestStep) > 0) changed();
    if (received_bytes_ < kMostBeforeRest_bytes) std::this_thread::sleep_for(kRest);
    if (host_monotonic_us() - counted_us < kCountersPeriod_us) continue;
    counted_us = host_monotonic_us();
    keep_counters(bus);
  }
  const std::lock_guard lock(mutex_);
  stay_.reset();
}

void LiveSource::hear(std::string_view channel, std::span<const std::uint8_t> bytes,
                      const Receipt& receipt) {
  received_bytes_ += bytes.size();
  if (is_of_doctor(channel, bytes)) return;
  const std::lock_guard lock(mutex_);
  const auto type = stay_->monitor.hear(channel, bytes, receipt);
  if (type) take(*type, bytes, receipt.monotonic_us, stay_->view);
}

bool LiveSource::is_of_doctor(std::string_view channel, std::span<const std::uint8_t> bytes) const {
  if (find_channel(channel, options_.bus.prefix) != Channel::kStatus) return false;
  service_status_t status;
  return !decode(bytes, status) && status.service == kDoctorProgram;
}

void LiveSource::keep_counters(const Bus& bus) {
  const std::int64_t now_us = host_monotonic_us();
  const std::lock_guard lock(mutex_);
  for (const Channel channel : kAllChannels) {
    const ChannelCounters dropped = bus.counters(channel);
    stay_->monitor.set_unauthenticated(channel, dropped.unauthenticated, dropped.last_rejection,
                                       now_us);
  }
  stay_->network = bus.network_counters();
  stay_->unknown_unauthenticated = bus.unknown_channels().unauthenticated;
}

BusSnapshot LiveSource::snapshot(std::int64_t now_us) {
  BusSnapshot snapshot = stay_->monitor.snapshot(now_us);
  snapshot.network = stay_->network;
  snapshot.unknown_unauthenticated = stay_->unknown_unauthenticated;
  return snapshot;
}

void LiveSource::changed() {
  {
    const std::lock_guard lock(mutex_);
    version_.fetch_add(1, std::memory_order_relaxed);
  }
  news_.notify_all();
}

}  // namespace puck
