#include "tests/doctor/other_machine.h"

#include <chrono>
#include <future>
#include <stdexcept>
#include <string_view>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/messaging/status_reporter.h"
#include "common/posix/file_descriptor.h"
#include "tests/support/network_namespace.h"

namespace puck {
namespace {

constexpr std::chrono::milliseconds kPause{10};

void send_to_group(const LcmUrl& url, std::string_view bytes) {
  const FileDescriptor sender(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(static_cast<std::uint16_t>(url.port));
  inet_pton(AF_INET, url.group.c_str(), &group.sin_addr);
  const auto hops = static_cast<unsigned char>(url.ttl);
  setsockopt(sender.number(), IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof hops);
  sendto(sender.number(), bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group),
         sizeof group);
}

bool set_up(const std::string& interface) {
  return ip("link set lo up") && ip("addr add 10.9.8.2/24 dev " + interface) &&
         ip("link set " + interface + " up") && ip("route add 224.0.0.0/4 dev " + interface);
}

}  // namespace

Work service(const std::string& name, const std::string& url,
             std::function<void(const Bus&)> at_the_end) {
  return [=](std::stop_token stop, const std::function<void()>& ready) {
    Bus bus({.url = url});
    StatusReporter status(bus, name);
    status.set_state(ServiceState::kRunning);
    if (!bus.start(stop, [](const std::string&) {})) return;
    ready();
    while (!stop.stop_requested()) {
      bus.handle(kPause);
      status.poll([](StatusReport&) {});
    }
    if (at_the_end) at_the_end(bus);
  };
}

Work intruder(const std::string& url) {
  return [url = parse_lcm_url(url)](std::stop_token stop, const std::function<void()>& ready) {
    using namespace std::string_view_literals;
    ready();
    while (!stop.stop_requested()) {
      send_to_group(url, "junk"sv);
      send_to_group(url,
                    "LC03\0\0\0\1\0\0\1\0\xff\xff\xff\xf0\0\1\0\2\1\2\3\4\5\6\7\xff\1\2\3\4"sv);
      send_to_group(url, "LC03\0\0\0\1\0\0\1\0\0\0\0\0\0\0\0\2PUCK_EVENTS\0abc"sv);
      send_to_group(url, "LC02\0\0\0\1PUCK_ESTIMATE\0abc"sv);
      std::this_thread::sleep_for(kPause);
    }
  };
}

BackgroundWork::BackgroundWork(Work work)
    : thread_([this, work = std::move(work)](std::stop_token stop) {
        const auto ready = [this] {
          const std::lock_guard lock(mutex_);
          is_ready_ = true;
          changed_.notify_all();
        };
        work(stop, ready);
        ready();  // Also where it gave up.
      }) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return is_ready_; });
}

void BackgroundWork::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

Work on_other_machine(const std::string& interface, Work work) {
  return [=](std::stop_token stop, const std::function<void()>& ready) {
    // Moved by a thread that is still in the cable's network.
    std::promise<pid_t> own_network;
    bool is_moved = false;
    std::jthread mover([&] {
      const std::string thread = std::to_string(own_network.get_future().get());
      is_moved = ip("link set " + interface + " netns " + thread);
    });
    const bool is_alone = unshare(CLONE_NEWNET) == 0;
    own_network.set_value(gettid());
    mover.join();
    if (!is_alone || !is_moved || !set_up(interface)) {
      throw std::runtime_error("no other machine could be made");
    }
    work(stop, ready);
  };
}

}  // namespace puck
