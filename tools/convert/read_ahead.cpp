#include "tools/convert/read_ahead.h"

#include <utility>

namespace puck {

ReadAhead::ReadAhead(EventReader& events, Interruption& interruption)
    : events_(events),
      interruption_(interruption),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

bool ReadAhead::next(EventPacket& packet) {
  std::unique_lock lock(mutex_);
  used_.push_back(std::move(packet));
  packet = {};
  changed_.wait(lock, [this] { return !full_.empty() || is_at_end_; });
  if (full_.empty()) {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return false;
  }
  packet = std::move(full_.front());
  full_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return true;
}

std::optional<double> ReadAhead::share_read() {
  const std::lock_guard lock(mutex_);
  return share_read_;
}

void ReadAhead::stop() {
  thread_.request_stop();
  interruption_.request();
  thread_.join();
}

void ReadAhead::run(const std::stop_token& stop) {
  std::exception_ptr error;
  try {
    while (!stop.stop_requested()) {
      EventPacket packet;
      {
        std::unique_lock lock(mutex_);
        const bool has_room =
            changed_.wait(lock, stop, [this] { return full_.size() < kMostPackets; });
        if (!has_room) break;
        if (!used_.empty()) {
          packet = std::move(used_.front());
          used_.pop_front();
        }
      }
      if (!events_.read(packet, kPacketEvents)) break;
      const auto share_read = events_.share_read();
      const std::lock_guard lock(mutex_);
      full_.push_back(std::move(packet));
      share_read_ = share_read;
      changed_.notify_all();
    }
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  error_ = error;
  is_at_end_ = true;
  changed_.notify_all();
}

}  // namespace puck
