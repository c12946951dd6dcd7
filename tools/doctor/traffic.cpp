#include "tools/doctor/traffic.h"

#include <algorithm>
#include <memory>

#include "common/messaging/bus_error.h"
#include "common/messaging/message_check.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/message_seal.h"
#include "common/messaging/shared_key.h"

namespace puck {
namespace {

/// A PUCK channel under any prefix.
struct PrefixedChannel {
  Channel channel{};
  std::string prefix;
};

std::optional<PrefixedChannel> find_under_any_prefix(std::string_view name) {
  for (const Channel channel : kAllChannels) {
    if (!name.ends_with(base_name(channel))) continue;
    std::string_view prefix = name.substr(0, name.size() - base_name(channel).size());
    if (prefix.empty()) return PrefixedChannel{channel, ""};
    if (!prefix.ends_with('_')) continue;
    prefix.remove_suffix(1);
    try {
      check_prefix(prefix);
    } catch (const BusError&) {
      continue;
    }
    if (!prefix.empty()) return PrefixedChannel{channel, std::string(prefix)};
  }
  return std::nullopt;
}

}  // namespace

OpenSeal open_seals_with(const std::string& key_file) {
  struct Opener {
    explicit Opener(const std::string& file) : key(file), opener(key) {}
    SharedKey key;
    SealOpener opener;  // Refers to the key.
  };
  const auto opener = std::make_shared<Opener>(key_file);
  return [opener](std::string_view channel, std::span<const std::uint8_t> message,
                  std::string& problem) { return opener->opener.open(channel, message, problem); };
}

const HeardService* Traffic::add(const ReceivedDatagram& datagram) {
  auto known = senders_.find(datagram.source);
  if (known == senders_.end()) {
    if (senders_.size() == kMaxSenders) {
      ++uncounted_;
      return nullptr;
    }
    known = senders_.emplace(datagram.source, SenderAccount{}).first;
  }
  SenderAccount& sender = known->second;
  ++sender.datagrams;
  sender.largest_bytes = std::max(sender.largest_bytes, datagram.bytes.size());
  sender.ttl = datagram.ttl;

  const Datagram parsed = parse_datagram(datagram.bytes);
  if (const auto* message = std::get_if<WholeMessage>(&parsed)) {
    return add_message(datagram, *message, sender);
  }
  if (std::holds_alternative<MessageFragment>(parsed)) {
    ++sender.fragments;
  } else if (const auto& bad = std::get<BadDatagram>(parsed); bad.has_magic) {
    ++sender.broken;
    sender.last_broken = bad.why;
  } else {
    ++sender.not_lcm;
  }
  return nullptr;
}

const HeardService* Traffic::add_message(const ReceivedDatagram& datagram,
                                         const WholeMessage& message, SenderAccount& sender) {
  if (sender.channels.size() < kMaxChannels) sender.channels.insert(printable(message.channel));
  const auto channel = find_under_any_prefix(message.channel);
  if (!channel) {
    ++sender.foreign;
    return nullptr;
  }
  if (channel->prefix != prefix_) {
    ++sender.other_prefix;
    if (other_prefixes_.size() < kMaxPrefixes) other_prefixes_.insert(channel->prefix);
    return nullptr;
  }
  const auto payload = take(channel->channel, message, sender);
  if (!payload) return nullptr;
  ++sender.ours;
  return channel->channel == Channel::kStatus ? add_status(datagram, *payload) : nullptr;
}

std::optional<std::span<const std::uint8_t>> Traffic::take(Channel channel,
                                                           const WholeMessage& message,
                                                           SenderAccount& sender) {
  std::span<const std::uint8_t> payload = message.payload;
  if (open_seal_) {
    std::string problem;
    const auto opened = open_seal_(message.channel, payload, problem);
    if (!opened) {
      ++sender.unauthenticated;
      sender.last_unauthenticated = printable(message.channel) + ": " + problem;
      return std::nullopt;
    }
    payload = *opened;
  }
  auto rejection = check_message(channel, payload);
  if (rejection && !open_seal_ && looks_sealed(payload)) {
    // Unverified without the key; used only to name the senders that have one.
    ++sender.sealed;
    is_sealed_ = true;
    payload = payload.first(payload.size() - kSealBytes);
    rejection = check_message(channel, payload);
  }
  if (!rejection) return payload;
  ++sender.malformed;
  sender.last_malformed = printable(message.channel) + ": " + *rejection;
  return std::nullopt;
}

const HeardService* Traffic::add_status(const ReceivedDatagram& datagram,
                                        std::span<const std::uint8_t> payload) {
  service_status_t status{};
  decode_checked(payload, status);
  const std::int64_t age_us = datagram.utime - status.utime;
  const auto known = services_.find(status.session);
  if (known == services_.end()) {
    if (services_.size() == kMaxServices) return nullptr;
    const std::int64_t session = status.session;
    return &services_
                .emplace(session,
                         HeardService{datagram.source, std::move(status), datagram.utime, age_us})
                .first->second;
  }
  HeardService& service = known->second;
  service.source = datagram.source;
  service.status = std::move(status);
  service.heard_utime = datagram.utime;
  service.least_age_us = std::min(service.least_age_us, age_us);
  return &service;
}

}  // namespace puck
