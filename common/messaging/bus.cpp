#include "common/messaging/bus.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <random>

#include <lcm/lcm.h>

#include "common/messaging/host_time.h"
#include "common/messaging/multicast_route.h"
#include "common/messaging/queue_bound.h"
#include "common/messaging/receive_filter.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

constexpr milliseconds kRouteRetry{200};
constexpr std::chrono::seconds kWaitingReport{5};
constexpr milliseconds kLongestDrain{50};

// LCM's default of 30 loses messages at 7000 a second; without a limit, a reader that hangs eats
// the memory, and LCM takes up to thrice as much as it holds. So many messages are 0.5 s of EVENTS
// in single frames at 10 Mev/s, and so many bytes 0.8 s in 60 kB packets.
constexpr std::size_t kQueueBytes = std::size_t{32} << 20;
constexpr int kEventQueue = 16384;
constexpr int kQueue = 1024;
// A log shall hold everything, also when the disk is slow for a while.
constexpr std::size_t kLogQueueBytes = std::size_t{256} << 20;
constexpr int kLogQueue = 16384;

struct LcmDeleter {
  void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
};
using LcmHandle = std::unique_ptr<lcm_t, LcmDeleter>;

std::int64_t random_session() {
  // Below 2^53, so that it survives tools that keep numbers in doubles.
  std::random_device random;
  std::uniform_int_distribution<std::int64_t> ids(1, (std::int64_t{1} << 53) - 1);
  return ids(random);
}

Receipt receipt_of(const lcm_recv_buf_t& buffer) {
  // LCM's stamp is older than now by the time in the queue; carried over to the clock that ages are
  // judged by. A step of the real-time clock in between must not turn into an age.
  constexpr std::int64_t kLongestQueue_us = 60'000'000;
  const std::int64_t utime = host_utime();
  const std::int64_t monotonic_us = host_monotonic_us();
  std::int64_t queued_us = utime - buffer.recv_utime;
  if (queued_us < 0 || queued_us > kLongestQueue_us) queued_us = 0;
  return {utime - queued_us, monotonic_us - queued_us, buffer.data_size, Arrival::kNewest};
}

std::span<const std::uint8_t> bytes_of(const lcm_recv_buf_t& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data), buffer.data_size};
}

/// Runs a handler; what it throws, as text.
template <typename Call>
std::optional<std::string> failure_of(const Call& call) {
  try {
    call();
    return std::nullopt;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "unknown exception";
  }
}

}  // namespace

class Bus::Impl {
 public:
  explicit Impl(const BusParams& params) : url_(parse_lcm_url(params.url)), prefix_(params.prefix) {
    check_prefix(prefix_);
    for (const Channel channel : kAllChannels) {
      Line& line = line_of(channel);
      line.owner = this;
      line.channel = channel;
      line.counters.channel = channel_name(channel, prefix_);
      if (channel == Channel::kEvents) line.queue = QueueBound(kQueueBytes, kEventQueue);
    }
  }

  /// Nothing when it worked, else why not.
  std::optional<std::string> open() {
    if (!url_.in_memory) {
      if (auto problem = find_route_problem(url_)) return problem;
    }
    const std::vector<int> others = sockets_at_port();
    LcmHandle lcm(lcm_create(url_.to_string().c_str()));
    // Asking for the file runs LCM's self-test; after a failed one its subscriptions are traps.
    if (!lcm || lcm_get_fileno(lcm.get()) < 0) return "LCM does not start on " + url_.to_string();
    const std::lock_guard lock(publish_mutex_);
    lcm_ = std::move(lcm);
    find_receive_socket(others);
    for (Line& line : lines_) join(line);
    if (raw_handler_) join_all();
    filter_what_comes();
    return std::nullopt;
  }

  void add_handler(Channel channel, CheckedHandler handler) {
    Line& line = line_of(channel);
    line.handlers.push_back(std::move(handler));
    if (!lcm_) return;
    join(line);
    filter_what_comes();
  }

  void add_raw_handler(RawHandler handler) {
    const bool first = !raw_handler_;
    raw_handler_ = std::move(handler);
    if (!lcm_ || !first) return;
    join_all();
    filter_what_comes();
  }

  bool send(Channel channel, const Encoder& encode_with) {
    const std::lock_guard lock(publish_mutex_);
    Line& line = line_of(channel);
    if (!lcm_) return count_failure(line, "the bus has not started");
    encode_with({host_utime(), session_, line.next_seq++}, buffer_);
    count_published(line);
    // What every receiver would reject is better refused here, where it can be seen.
    if (auto rejection = check_message(channel, buffer_)) return count_failure(line, *rejection);
    const int status = lcm_publish(lcm_.get(), line.counters.channel.c_str(), buffer_.data(),
                                   static_cast<unsigned>(buffer_.size()));
    if (status < 0) return count_failure(line, std::strerror(errno));
    return true;
  }

  int handle(milliseconds timeout) {
    if (!lcm_) return 0;
    if (lcm_handle_timeout(lcm_.get(), static_cast<int>(timeout.count())) <= 0) return 0;
    int handled = 1;
    const auto end = SteadyClock::now() + kLongestDrain;
    while (SteadyClock::now() < end && lcm_handle_timeout(lcm_.get(), 0) > 0) ++handled;
    return handled;
  }

  ChannelCounters counters(Channel channel) const {
    const Line& line = lines_[static_cast<std::size_t>(channel)];
    const std::lock_guard lock(counters_mutex_);
    ChannelCounters counters = line.counters;
    counters.arrivals = line.account.counters();
    return counters;
  }

  std::int64_t session() const { return session_; }
  const std::string& prefix() const { return prefix_; }
  const LcmUrl& url() const { return url_; }

 private:
  /// All that belongs to one channel. LCM holds its address.
  struct Line {
    Impl* owner = nullptr;
    Channel channel{};
    std::vector<CheckedHandler> handlers;
    lcm_subscription_t* subscription = nullptr;  // nullptr: none
    QueueBound queue{kQueueBytes, kQueue};
    std::int64_t next_seq = 0;  // Guarded by publish_mutex_.
    LossAccount account;        // Guarded by counters_mutex_, as are the counters.
    ChannelCounters counters;
  };

  Line& line_of(Channel channel) { return lines_[static_cast<std::size_t>(channel)]; }

  void join(Line& line) {
    if (line.subscription != nullptr || line.handlers.empty()) return;
    line.subscription =
        lcm_subscribe(lcm_.get(), line.counters.channel.c_str(), &Impl::on_message, &line);
    lcm_subscription_set_queue_capacity(line.subscription, line.queue.messages());
  }

  void join_all() {
    const std::string pattern = (prefix_.empty() ? "" : prefix_ + "_") + "PUCK_.*";
    raw_subscription_ = lcm_subscribe(lcm_.get(), pattern.c_str(), &Impl::on_raw_message, this);
    lcm_subscription_set_queue_capacity(raw_subscription_, raw_queue_.messages());
  }

  std::vector<int> sockets_at_port() const {
    if (url_.in_memory) return {};
    return udp_sockets_at(static_cast<std::uint16_t>(url_.port));
  }

  // LCM does not tell its socket. It is the one that was not there before; when somebody else in
  // this process has made one meanwhile, it cannot be told which is whose.
  void find_receive_socket(const std::vector<int>& others) {
    std::vector<int> ours = sockets_at_port();
    std::erase_if(ours, [&](int socket) {
      return std::find(others.begin(), others.end(), socket) != others.end();
    });
    if (ours.size() == 1) receive_socket_ = ours.front();
  }

  void filter_what_comes() {
    if (!receive_socket_) return;
    if (raw_handler_) {
      remove_filter(*receive_socket_);
      return;
    }
    std::vector<std::string> channels;
    for (const Line& line : lines_) {
      if (line.subscription != nullptr) channels.push_back(line.counters.channel);
    }
    // Without a filter the same is heard, at a greater cost.
    filter_channels(*receive_socket_, channels);
  }

  static void adapt(QueueBound& queue, std::size_t bytes, lcm_subscription_t* subscription) {
    if (queue.add(bytes)) lcm_subscription_set_queue_capacity(subscription, queue.messages());
  }

  static void on_message(const lcm_recv_buf_t* buffer, const char*, void* line) noexcept {
    auto& its_line = *static_cast<Line*>(line);
    its_line.owner->receive(its_line, *buffer);
  }

  static void on_raw_message(const lcm_recv_buf_t* buffer, const char* channel,
                             void* impl) noexcept {
    auto& self = *static_cast<Impl*>(impl);
    adapt(self.raw_queue_, buffer->data_size, self.raw_subscription_);
    const auto failure =
        failure_of([&] { self.raw_handler_(channel, bytes_of(*buffer), receipt_of(*buffer)); });
    if (!failure) return;
    if (const auto known = find_channel(channel, self.prefix_)) {
      self.count_handler_failure(self.line_of(*known), *failure);
    }
  }

  void receive(Line& line, const lcm_recv_buf_t& buffer) {
    const auto bytes = bytes_of(buffer);
    adapt(line.queue, bytes.size(), line.subscription);
    Receipt receipt = receipt_of(buffer);
    const auto rejection = check_message(line.channel, bytes);
    {
      const std::lock_guard lock(counters_mutex_);
      line.counters.received_bytes += static_cast<std::int64_t>(bytes.size());
      if (rejection) {
        ++line.counters.rejected;
        line.counters.last_rejection = *rejection;
        return;
      }
      receipt.arrival = account(line, bytes);
    }
    for (const CheckedHandler& handler : line.handlers) {
      const auto failure = failure_of([&] { handler(bytes, receipt); });
      if (failure) count_handler_failure(line, *failure);
    }
  }

  static Arrival account(Line& line, std::span<const std::uint8_t> bytes) {
    const MessageHeader header = read_header(bytes);
    if (line.channel != Channel::kEvents) return line.account.add(header.session, header.seq);
    const EventNumbering numbering = read_event_numbering(bytes);
    return line.account.add(header.session, header.seq, numbering.events_before, numbering.events);
  }

  void count_handler_failure(Line& line, const std::string& what) {
    const std::lock_guard lock(counters_mutex_);
    ++line.counters.handler_failures;
    line.counters.last_handler_failure = what;
  }

  void count_published(Line& line) {
    const std::lock_guard lock(counters_mutex_);
    ++line.counters.published;
  }

  bool count_failure(Line& line, const std::string& what) {
    const std::lock_guard lock(counters_mutex_);
    ++line.counters.publish_failures;
    line.counters.last_publish_failure = what;
    return false;
  }

  const LcmUrl url_;
  const std::string prefix_;
  const std::int64_t session_ = random_session();

  std::mutex publish_mutex_;
  std::vector<std::uint8_t> buffer_;  // Guarded by publish_mutex_.
  mutable std::mutex counters_mutex_;

  std::array<Line, kAllChannels.size()> lines_;
  RawHandler raw_handler_;
  lcm_subscription_t* raw_subscription_ = nullptr;
  QueueBound raw_queue_{kLogQueueBytes, kLogQueue};
  std::optional<int> receive_socket_;  // LCM's
  LcmHandle lcm_;                      // Last, so that it stops before what its callbacks use.
};

Bus::Bus(const BusParams& params) : impl_(std::make_unique<Impl>(params)) {}

Bus::~Bus() = default;

bool Bus::start(std::stop_token stop, const std::function<void(const std::string&)>& on_waiting) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::optional<SteadyClock::time_point> next_report;
  while (!stop.stop_requested()) {
    const auto problem = impl_->open();
    if (!problem) return true;
    const auto now = SteadyClock::now();
    if (!next_report || now >= *next_report) {
      on_waiting(*problem);
      next_report = now + kWaitingReport;
    }
    std::unique_lock lock(mutex);
    stopped.wait_for(lock, stop, kRouteRetry, [] { return false; });
  }
  return false;
}

void Bus::subscribe_all(RawHandler handler) { impl_->add_raw_handler(std::move(handler)); }

int Bus::handle(milliseconds timeout) { return impl_->handle(timeout); }

std::int64_t Bus::session() const { return impl_->session(); }
const std::string& Bus::prefix() const { return impl_->prefix(); }
const LcmUrl& Bus::url() const { return impl_->url(); }

ChannelCounters Bus::counters(Channel channel) const { return impl_->counters(channel); }

void Bus::add_handler(Channel channel, CheckedHandler handler) {
  impl_->add_handler(channel, std::move(handler));
}

bool Bus::send(Channel channel, const Encoder& encode_with) {
  return impl_->send(channel, encode_with);
}

}  // namespace puck
