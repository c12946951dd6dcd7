#include "common/messaging/bus.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "common/messages/host_time.h"
#include "common/messaging/memory_transport.h"
#include "common/messaging/message_seal.h"
#include "common/messaging/session_id.h"
#include "common/messaging/udp_transport.h"
#include "common/messaging/wire_layout.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

constexpr milliseconds kRouteRetry{200};
constexpr std::chrono::seconds kWaitingReport{5};

/// Runs a handler; returns the text of an exception that it throws.
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
  explicit Impl(const BusParams& params)
      : url_(parse_lcm_url(params.url)),
        prefix_(params.prefix),
        beginning_(channel_beginning(params.prefix)),
        allow_fragments_(params.allow_fragments) {
    check_prefix(prefix_);
    if (!params.key_file.empty()) security_.emplace(params.key_file);
    unknown_channels_.channel = "unknown PUCK channels";
    for (const Channel channel : kAllChannels) {
      Line& line = line_of(channel);
      line.channel = channel;
      line.counters.channel = channel_name(channel, prefix_);
      line.most_bytes = most_message_bytes(channel);
    }
  }

  /// Nothing on success, else the reason.
  std::optional<std::string> open() {
    std::unique_ptr<Transport> transport;
    if (url_.in_memory) {
      transport = std::make_unique<MemoryTransport>();
    } else {
      auto udp = std::make_unique<UdpTransport>(UdpTransportParams{url_, allow_fragments_});
      if (auto problem = udp->open()) return problem;
      transport = std::move(udp);
    }
    const std::lock_guard lock(publish_mutex_);
    transport_ = std::move(transport);
    listen();
    return std::nullopt;
  }

  void add_handler(Channel channel, CheckedHandler handler) {
    line_of(channel).handlers.push_back(std::move(handler));
    listen();
  }

  void add_raw_handler(RawHandler handler) {
    raw_handler_ = std::move(handler);
    listen();
  }

  bool send(Channel channel, const Encoder& encode_with) {
    const std::lock_guard lock(publish_mutex_);
    Line& line = line_of(channel);
    if (!transport_) return count_failure(line, "the bus has not started");
    encode_with({host_utime(), session(), line.next_seq++}, buffer_);
    count_published(line);
    // Rejected here already, where the sender can see the reason.
    if (auto rejection = check_message(channel, buffer_)) return count_failure(line, *rejection);
    if (security_) security_->sealer.seal(line.counters.channel, buffer_);
    if (auto problem = transport_->send(line.counters.channel, buffer_)) {
      return count_failure(line, *problem);
    }
    return true;
  }

  int handle(std::chrono::microseconds timeout, std::chrono::microseconds longest) {
    if (!transport_) return 0;
    const int handled = transport_->receive(
        timeout, longest, [this](const ArrivedMessage& message) { receive(message); });
    keep_network_counters();
    return handled;
  }

  ChannelCounters counters(Channel channel) const {
    const Line& line = lines_[static_cast<std::size_t>(channel)];
    const std::lock_guard lock(counters_mutex_);
    ChannelCounters counters = line.counters;
    counters.arrivals = line.account.counters();
    return counters;
  }

  ChannelCounters unknown_channels() const {
    const std::lock_guard lock(counters_mutex_);
    return unknown_channels_;
  }

  TransportCounters network_counters() const {
    const std::lock_guard lock(counters_mutex_);
    return network_counters_;
  }

  std::int64_t session() const { return session_.load(std::memory_order_relaxed); }

  void begin_session() {
    const std::lock_guard lock(publish_mutex_);
    session_.store(random_session(), std::memory_order_relaxed);
    for (Line& line : lines_) line.next_seq = 0;
  }

  const std::string& prefix() const { return prefix_; }
  const LcmUrl& url() const { return url_; }
  bool is_authenticated() const { return security_.has_value(); }

 private:
  struct Security {
    explicit Security(const std::string& key_file) : key(key_file), sealer(key), opener(key) {}

    SharedKey key;
    MessageSealer sealer;  // Guarded by publish_mutex_.
    SealOpener opener;     // Used by the receiving thread only.
  };

  /// State of one channel.
  struct Line {
    Channel channel{};
    std::size_t most_bytes = 0;
    std::vector<CheckedHandler> handlers;
    std::int64_t next_seq = 0;  // Guarded by publish_mutex_.
    LossAccount account;        // Guarded by counters_mutex_, as are the counters.
    ChannelCounters counters;
  };

  Line& line_of(Channel channel) { return lines_[static_cast<std::size_t>(channel)]; }

  Line* find_line(std::string_view name) {
    const auto found = std::find_if(lines_.begin(), lines_.end(), [name](const Line& line) {
      return line.counters.channel == name;
    });
    return found == lines_.end() ? nullptr : &*found;
  }

  void listen() {
    if (!transport_) return;
    Listening listening{beginning_, static_cast<bool>(raw_handler_), {}};
    for (const Line& line : lines_) {
      if (!line.handlers.empty()) listening.channels.push_back(line.counters.channel);
    }
    transport_->listen(listening);
  }

  void receive(const ArrivedMessage& message) {
    Line* line = find_line(message.channel);
    const auto opened = open_seal(line, message);
    if (!opened) return;
    const std::span<const std::uint8_t> bytes = *opened;
    Receipt receipt{message.utime,  message.monotonic_us, bytes.size(),
                    message.sender, Arrival::kNewest,     message.more_waiting};
    if (raw_handler_) {
      const auto failure = failure_of([&] { raw_handler_(message.channel, bytes, receipt); });
      if (failure && line != nullptr) count_handler_failure(*line, *failure);
    }
    if (line == nullptr || line->handlers.empty() || !take(*line, bytes, receipt)) return;
    for (const CheckedHandler& handler : line->handlers) {
      const auto failure = failure_of([&] { handler(bytes, receipt); });
      if (failure) count_handler_failure(*line, *failure);
    }
  }

  /// The message without its seal; nothing, and counted, if it is not sealed with our key.
  std::optional<std::span<const std::uint8_t>> open_seal(Line* line,
                                                         const ArrivedMessage& message) {
    if (!security_) return message.payload;
    std::string problem;
    const auto opened = security_->opener.open(message.channel, message.payload, problem);
    if (opened) return opened;
    const std::lock_guard lock(counters_mutex_);
    ChannelCounters& counters = line != nullptr ? line->counters : unknown_channels_;
    ++counters.unauthenticated;
    counters.last_rejection = problem + ", from " + to_string(message.sender);
    return std::nullopt;
  }

  /// Counts a message; returns whether it is valid.
  bool take(Line& line, std::span<const std::uint8_t> bytes, Receipt& receipt) {
    const bool is_oversize = bytes.size() > line.most_bytes + (security_ ? 0 : kSealBytes);
    std::optional<std::string> rejection;
    if (is_oversize) {
      rejection = "has " + std::to_string(bytes.size()) + " bytes, more than the " +
                  std::to_string(line.most_bytes) + " that its type can have";
    } else {
      rejection = check_message(line.channel, bytes);
      if (rejection && !security_ && looks_sealed(bytes)) {
        rejection = "is sealed, but this service has no key (lcm.key_file)";
      }
    }
    const std::lock_guard lock(counters_mutex_);
    line.counters.received_bytes += static_cast<std::int64_t>(bytes.size());
    if (rejection) {
      ++(is_oversize ? line.counters.oversize : line.counters.rejected);
      line.counters.last_rejection = *rejection + ", from " + to_string(receipt.sender);
      return false;
    }
    receipt.arrival = account(line, bytes);
    return true;
  }

  static Arrival account(Line& line, std::span<const std::uint8_t> bytes) {
    const MessageHeader header = read_header(bytes);
    if (line.channel != Channel::kEvents) return line.account.add(header.session, header.seq);
    const EventNumbering numbering = read_event_numbering(bytes);
    return line.account.add(header.session, header.seq, numbering.events_before, numbering.events);
  }

  /// Only the receiving thread may read the transport's counters; copied after a change.
  void keep_network_counters() {
    const TransportCounters& now = transport_->counters();
    if (now.malformed == network_counters_.malformed && now.foreign == network_counters_.foreign &&
        now.rejoined == network_counters_.rejoined) {
      return;
    }
    const std::lock_guard lock(counters_mutex_);
    network_counters_ = now;
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
  const std::string beginning_;  // Common beginning of all channel names under the prefix.
  const bool allow_fragments_;
  std::atomic<std::int64_t> session_{random_session()};  // Written under publish_mutex_.

  std::mutex publish_mutex_;
  std::vector<std::uint8_t> buffer_;  // Guarded by publish_mutex_.
  mutable std::mutex counters_mutex_;

  std::array<Line, kAllChannels.size()> lines_;
  ChannelCounters unknown_channels_;  // Guarded by counters_mutex_.
  RawHandler raw_handler_;
  std::optional<Security> security_;  // Empty without a key.
  std::unique_ptr<Transport> transport_;
  TransportCounters network_counters_;  // Written by the handling thread, under counters_mutex_.
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

int Bus::handle(std::chrono::microseconds timeout, std::chrono::microseconds longest) {
  return impl_->handle(timeout, longest);
}

std::int64_t Bus::session() const { return impl_->session(); }
void Bus::begin_session() { impl_->begin_session(); }
const std::string& Bus::prefix() const { return impl_->prefix(); }
const LcmUrl& Bus::url() const { return impl_->url(); }
bool Bus::is_authenticated() const { return impl_->is_authenticated(); }
std::size_t Bus::overhead_bytes() const { return impl_->is_authenticated() ? kSealBytes : 0; }

ChannelCounters Bus::counters(Channel channel) const { return impl_->counters(channel); }
ChannelCounters Bus::unknown_channels() const { return impl_->unknown_channels(); }

TransportCounters Bus::network_counters() const { return impl_->network_counters(); }

void Bus::add_handler(Channel channel, CheckedHandler handler) {
  impl_->add_handler(channel, std::move(handler));
}

bool Bus::send(Channel channel, const Encoder& encode_with) {
  return impl_->send(channel, encode_with);
}

}  // namespace puck
