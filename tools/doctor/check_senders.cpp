#include <algorithm>

#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kSenders = "senders";

std::string name_of(const Facts& facts, const Source& source) {
  const std::string address = source.address + ":" + std::to_string(source.port);
  const auto known = facts.local_senders.find(source);
  return known == facts.local_senders.end() ? address : to_string(known->second) + " at " + address;
}

/// Whether that host has a sender of valid messages: it must not be blocked.
bool has_good_senders(const Facts& facts, const std::string& address) {
  const auto& senders = facts.traffic.senders();
  return std::any_of(senders.begin(), senders.end(), [&](const auto& entry) {
    return entry.first.address == address && entry.second.ours > 0;
  });
}

/// Blocks a foreign sender, or names its program if its host is needed.
std::string keep_out(const Facts& facts, const Source& source) {
  const std::string who_has_port = "ss -uanp 'sport = :" + std::to_string(source.port) + "'";
  if (facts.is_own_address(source.address)) {
    const auto known = facts.local_senders.find(source);
    return as_root(
        facts, {known == facts.local_senders.end() ? who_has_port
                                                   : "kill " + std::to_string(known->second.pid)});
  }
  if (has_good_senders(facts, source.address)) {
    return "ssh " + source.address + " sudo " + who_has_port;
  }
  return as_root(facts, {"iptables -I INPUT -s " + source.address + " -p udp --dport " +
                         std::to_string(facts.url.port) + " -j DROP"});
}

std::string some_channels(const SenderAccount& sender) {
  constexpr std::size_t kMostShown = 4;
  std::string names;
  std::size_t shown = 0;
  for (const std::string& channel : sender.channels) {
    if (shown++ == kMostShown) return names + ", …";
    names += (names.empty() ? "" : ", ") + channel;
  }
  return names;
}

void add_strangers(const Facts& facts, Findings& findings) {
  for (const auto& [source, sender] : facts.traffic.senders()) {
    const std::string name = name_of(facts, source);
    if (sender.not_lcm > 0) {
      findings.push_back({Verdict::kWrong, kSenders,
                          name + " sent " + std::to_string(sender.not_lcm) +
                              " datagrams to our port that are not LCM",
                          keep_out(facts, source)});
    }
    if (sender.broken > 0) {
      findings.push_back({Verdict::kWrong, kSenders,
                          name + " sent " + std::to_string(sender.broken) +
                              " broken datagrams, which can crash programs that use liblcm; "
                              "the last " +
                              sender.last_broken,
                          keep_out(facts, source)});
    }
    if (sender.malformed > 0) {
      // A sender of valid messages as well is an older service of ours: update it, do not end it.
      const bool is_ours = sender.ours > 0;
      findings.push_back({Verdict::kWrong, kSenders,
                          name + " sent " + std::to_string(sender.malformed) +
                              " messages that are rejected, the last on " + sender.last_malformed +
                              (is_ours ? "; it is of another version than this. On the older host, "
                                         "in its clone"
                                       : "; a program of another version, or an intruder"),
                          is_ours ? kUpdate : keep_out(facts, source)});
    }
    if (sender.fragments > 0) {
      findings.push_back({facts.allow_fragments ? Verdict::kNote : Verdict::kWrong, kSenders,
                          name + " sent " + std::to_string(sender.fragments) +
                              " parts of messages larger than a datagram, which " +
                              (facts.allow_fragments ? "" : "are refused here and ") +
                              "stall liblcm under loss; another port avoids them",
                          other_port_option(facts.url)});
    }
    if (sender.foreign > 0) {
      findings.push_back({Verdict::kNote, kSenders,
                          name + " sent " + std::to_string(sender.foreign) +
                              " messages of other programs (" + some_channels(sender) +
                              "); another port avoids them",
                          other_port_option(facts.url)});
    }
  }
}

}  // namespace

Findings check_senders(const Facts& facts) {
  Findings findings;
  add_strangers(facts, findings);
  const Traffic& traffic = facts.traffic;
  if (traffic.uncounted() > 0) {
    findings.push_back({Verdict::kWrong, kSenders,
                        "more than " + std::to_string(Traffic::kMaxSenders) +
                            " addresses send to the port; " + std::to_string(traffic.uncounted()) +
                            " datagrams are in none of these counts. Move to another port",
                        other_port_option(facts.url)});
  }
  std::int64_t datagrams = 0;
  std::int64_t ours = 0;
  for (const auto& [source, sender] : traffic.senders()) {
    datagrams += sender.datagrams;
    ours += sender.ours;
  }
  findings.insert(findings.begin(), {Verdict::kOk, kSenders,
                                     std::to_string(datagrams) + " datagrams from " +
                                         std::to_string(traffic.senders().size()) + " senders, " +
                                         std::to_string(ours) + " of them good messages of ours"});
  return findings;
}

}  // namespace puck
