#include "tools/spy/listen.h"

#include <chrono>
#include <mutex>
#include <thread>

#include "common/messages/host_time.h"
#include "tools/spy/spy_model.h"
#include "tools/spy/spy_view.h"
#include "tools/spy/terminal.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kStep{20};

/// A model fed from a bus that may still wait for its network.
class Listener {
 public:
  Listener(const BusParams& params, const SpyParams& spy)
      : bus_(params), model_(params.prefix, spy, host_monotonic_us()) {
    bus_.subscribe_all([this](std::string_view channel, std::span<const std::uint8_t> bytes,
                              const Receipt& receipt) { model_.hear(channel, bytes, receipt); });
    starter_ = std::jthread([this](const std::stop_token& stop) { start(stop); });
  }

  /// Takes the messages of a short time.
  void step() {
    if (started()) {
      bus_.handle(kStep);
    } else {
      std::this_thread::sleep_for(kStep);
    }
  }

  /// Takes all waiting messages, for a second at most: on a busy machine there may be many, and
  /// unread messages would look like silence.
  void catch_up() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (started() && bus_.handle(milliseconds(0)) > 0 &&
           std::chrono::steady_clock::now() < end) {
      continue;
    }
  }

  Snapshot snapshot() {
    const std::int64_t now_us = host_monotonic_us();
    for (const Channel channel : kAllChannels) {
      const ChannelCounters dropped = bus_.counters(channel);
      model_.set_unauthenticated(channel, dropped.unauthenticated, dropped.last_rejection, now_us);
    }
    Snapshot snapshot = model_.snapshot(now_us);
    snapshot.network = bus_.network_counters();
    snapshot.unknown_unauthenticated = bus_.unknown_channels().unauthenticated;
    return snapshot;
  }
  const LcmUrl& url() const { return bus_.url(); }

  /// Why it does not listen yet; empty: it listens.
  std::string problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
  }

 private:
  void start(const std::stop_token& stop) {
    const auto say = [this](const std::string& reason) {
      const std::lock_guard lock(mutex_);
      problem_ = reason;
    };
    const bool started = bus_.start(stop, say);
    const std::lock_guard lock(mutex_);
    started_ = started;
    if (started) problem_.clear();
  }
  bool started() const {
    const std::lock_guard lock(mutex_);
    return started_;
  }

  Bus bus_;
  SpyModel model_;
  mutable std::mutex mutex_;
  bool started_ = false;  // Guarded by mutex_; once true, the bus belongs to the caller's thread.
  std::string problem_;   // Guarded by mutex_.
  std::jthread starter_;
};

std::string describe(const LcmUrl& url, const std::string& prefix) {
  std::string text = url.in_memory ? "memq://"
                                   : url.group + ':' + std::to_string(url.port) + " ttl " +
                                         std::to_string(url.ttl);
  if (!prefix.empty()) text += "  prefix " + prefix;
  return text;
}

}  // namespace

Heard listen(const BusParams& params, double seconds, StopSignal& stop) {
  Listener listener(params, SpyParams::whole_time());
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < end && !stop.requested()) listener.step();
  listener.catch_up();
  return {listener.snapshot(), listener.problem()};
}

void watch(const BusParams& params, StopSignal& stop) {
  constexpr milliseconds kRefresh{250};
  Terminal terminal;
  Listener listener(params, {});
  SpyView view(describe(listener.url(), params.prefix));
  std::chrono::steady_clock::time_point due;
  while (!stop.requested() && !view.wants_to_quit()) {
    bool draw = false;
    while (const auto key = terminal.read_key()) {
      view.press(*key);
      draw = true;
    }
    draw = terminal.was_resized() || draw;
    if (const auto now = std::chrono::steady_clock::now(); now >= due) {
      due = now + kRefresh;
      view.set_notice(listener.problem());
      view.show(listener.snapshot());
      draw = true;
    }
    if (draw) terminal.show(view.draw(terminal.size()));
    listener.step();
  }
}

}  // namespace puck
