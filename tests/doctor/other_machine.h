#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "common/messaging/bus.h"

namespace puck {

/// A machine's activity until it is stopped; calls `ready` when it is noticeable.
using Work = std::function<void(std::stop_token, const std::function<void()>& ready)>;

/// Publishes the STATUS of a service, and returns its bus at the end.
Work service(const std::string& name, const std::string& url,
             std::function<void(const Bus&)> at_the_end = {});

/// Sends invalid data: no LCM, broken LCM, a part of a message, a truncated message.
Work intruder(const std::string& url);

/// Work on a thread in the network of the thread that makes it.
class BackgroundWork {
 public:
  /// Returns when it is ready.
  explicit BackgroundWork(Work work);
  void stop();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_ready_ = false;
  std::jthread thread_;
};

/// Work on a machine at the other end of a cable, with the address 10.9.8.2: a thread with a
/// network of its own, to which this end of the cable is moved.
Work on_other_machine(const std::string& interface, Work work);

}  // namespace puck
