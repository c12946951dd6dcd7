#include "common/monitor/channel_account.h"

#include <algorithm>

#include "common/messaging/message_check.h"
#include "common/messaging/message_seal.h"
#include "common/messaging/wire_layout.h"

namespace puck {

ChannelAccount::ChannelAccount(std::string name, std::optional<Channel> type,
                               const MonitorParams& params, std::int64_t from_us)
    : name_(std::move(name)),
      type_(type),
      params_(params),
      rates_(params.rate_window_us, from_us) {}

bool ChannelAccount::hear(std::span<const std::uint8_t> bytes, const Receipt& receipt) {
  ++sums_.messages;
  sums_.bytes += static_cast<std::int64_t>(bytes.size());
  newest_us_ = receipt.monotonic_us;
  if (!type_) return false;
  if (const auto rejection = reject(bytes)) {
    last_rejection_ = *rejection + ", from " + to_string(receipt.sender);
    return false;
  }
  hear_valid(bytes, receipt);
  return true;
}

std::optional<std::string> ChannelAccount::reject(std::span<const std::uint8_t> bytes) {
  const bool sealed = looks_sealed(bytes);
  const std::size_t most_bytes = most_message_bytes(*type_) + (sealed ? kSealBytes : 0);
  if (bytes.size() > most_bytes) {
    ++oversize_;
    return "has " + std::to_string(bytes.size()) + " bytes, more than the " +
           std::to_string(most_bytes) + " that its type can have";
  }
  auto rejection = check_message(*type_, bytes);
  if (!rejection) return std::nullopt;
  ++malformed_;
  // With a key, the bus would have opened the seal.
  if (sealed) return "is sealed, but this program has no key (lcm.key_file of --config)";
  return rejection;
}

void ChannelAccount::set_unauthenticated(std::int64_t messages, std::string why) {
  unauthenticated_ = messages;
  last_rejection_ = std::move(why);
}

void ChannelAccount::hear_valid(std::span<const std::uint8_t> bytes, const Receipt& receipt) {
  const MessageHeader header = read_header(bytes);
  EventNumbering numbering;
  if (type_ == Channel::kEvents) numbering = read_event_numbering(bytes);
  account_.add(header.session, header.seq, numbering.events_before, numbering.events);
  sums_.events += numbering.events;
  publishers_.hear(header.session, receipt.sender, receipt.monotonic_us);
  newest_.assign(bytes.begin(), bytes.end());
}

ChannelRow ChannelAccount::row(std::int64_t now_us) {
  ChannelRow row{.name = name_, .type = type_};
  row.arrivals = account_.counters();
  if (!type_) row.arrivals.received = sums_.messages;
  sums_.troubles = row.arrivals.lost + row.arrivals.late + row.arrivals.duplicates + malformed_ +
                   oversize_ + unauthenticated_;
  rates_.add(now_us, sums_);
  row.messages_per_s = rates_.per_second(&Traffic::messages);
  row.bytes_per_s = rates_.per_second(&Traffic::bytes);
  row.events_per_s = rates_.per_second(&Traffic::events);
  row.in_trouble = rates_.increase(&Traffic::troubles) > 0;
  row.received_bytes = sums_.bytes;
  row.malformed = malformed_;
  row.oversize = oversize_;
  row.unauthenticated = unauthenticated_;
  row.last_rejection = last_rejection_;
  if (newest_us_) row.newest_age_us = std::max<std::int64_t>(now_us - *newest_us_, 0);
  row.newest = newest_;
  fill_publishers(row, now_us);
  return row;
}

void ChannelAccount::fill_publishers(ChannelRow& row, std::int64_t now_us) const {
  const auto present = publishers_.present(now_us, params_.publisher_life_us);
  for (const HeardPublisher& publisher : present) {
    row.publishers.push_back({.session = publisher.session,
                              .sender = publisher.sender,
                              .messages = publisher.messages,
                              .age_us = std::max<std::int64_t>(now_us - publisher.last_us, 0)});
    // Every service publishes STATUS.
    row.several_publishers =
        row.several_publishers ||
        (type_ != Channel::kStatus &&
         std::any_of(present.begin(), present.end(), [&](const HeardPublisher& other) {
           return other.session != publisher.session && at_once(publisher, other);
         }));
  }
}

}  // namespace puck
