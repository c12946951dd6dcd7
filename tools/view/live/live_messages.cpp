#include "tools/view/live/live_messages.h"

#include <algorithm>
#include <string_view>

namespace puck {
namespace {

using Level = ViewMessage::Level;

// Services publish STATUS every 100 ms, and a slow start takes a second.
constexpr std::int64_t kSilence_us = 2'000'000;
constexpr std::int64_t kNoEvents_us = 2'000'000;
constexpr std::string_view kCamera = "puck-camera";

std::string in_words(SensorSize sensor) {
  return std::to_string(sensor.width) + " x " + std::to_string(sensor.height);
}

const ChannelRow* find_row(const BusSnapshot& snapshot, Channel channel) {
  const auto found = std::find_if(snapshot.channels.begin(), snapshot.channels.end(),
                                  [&](const ChannelRow& row) { return row.type == channel; });
  return found == snapshot.channels.end() ? nullptr : &*found;
}

const ServiceRow* find_service(const BusSnapshot& snapshot, std::string_view name) {
  const auto found = std::find_if(snapshot.services.begin(), snapshot.services.end(),
                                  [&](const ServiceRow& row) { return row.service == name; });
  return found == snapshot.services.end() ? nullptr : &*found;
}

std::string place_of(const PublisherRow& publisher) {
  if (publisher.service.empty()) return to_string(publisher.sender);
  return publisher.service + " (pid " + std::to_string(publisher.pid) + " on " + publisher.host +
         ')';
}

void add_several(const BusSnapshot& snapshot, std::vector<ViewMessage>& messages) {
  for (const ChannelRow& row : snapshot.channels) {
    if (!row.several_publishers || !row.type) continue;
    std::string text = row.type == Channel::kEvents ? "several cameras publish on "
                                                    : "several services publish on ";
    text += row.name + ':';
    for (const PublisherRow& publisher : row.publishers) text += ' ' + place_of(publisher) + ',';
    text.back() = '.';
    text += row.type == Channel::kEvents ? " Shown is the one heard first." : "";
    messages.push_back(
        {Level::kError, text + " End all but one, or give each a --prefix of its own"});
  }
}

void add_services(const BusSnapshot& snapshot, std::vector<ViewMessage>& messages) {
  for (const ServiceRow& row : snapshot.services) {
    if (!row.silent && row.state == ServiceState::kRunning) continue;
    const bool is_bad = row.silent || row.state == ServiceState::kDegraded;
    std::string text = row.service + " on " + row.host + ": " + state_of(row);
    if (!row.state_text.empty()) text += ", " + row.state_text;
    messages.push_back({is_bad ? Level::kWarning : Level::kInfo, text});
  }
}

/// Cameras under another prefix, which the page could show.
void add_other_prefixes(const BusSnapshot& snapshot, std::vector<ViewMessage>& messages) {
  for (const ForeignTraffic& foreign : snapshot.network.foreign_traffic) {
    constexpr std::string_view kBegin = "channel \"";
    if (!foreign.what.starts_with(kBegin) || !foreign.what.ends_with('"')) continue;
    const std::string name =
        foreign.what.substr(kBegin.size(), foreign.what.size() - kBegin.size() - 1);
    if (find_channel_of_any_prefix(name) != Channel::kEvents) continue;
    const std::size_t end = name.find(base_name(Channel::kEvents));
    const std::string prefix = name.substr(0, end > 0 ? end - 1 : 0);
    messages.push_back({Level::kInfo, "another camera publishes on " + name +
                                          "; to see it, run puck-view with --prefix " +
                                          (prefix.empty() ? "\"\"" : prefix)});
  }
}

void add_events(const BusSnapshot& snapshot, const LiveFacts& facts,
                std::vector<ViewMessage>& messages) {
  if (facts.events_age_us && *facts.events_age_us < kNoEvents_us) return;
  if (snapshot.listened_us < kNoEvents_us) return;
  const ServiceRow* camera = find_service(snapshot, kCamera);
  if (camera == nullptr || camera->silent || camera->state == ServiceState::kStopping) {
    messages.push_back({Level::kWarning,
                        "no events, as no puck-camera runs on this bus: start puck-camera with the "
                        "same --lcm-url and --prefix"});
  } else if (camera->state == ServiceState::kRunning) {
    messages.push_back({Level::kWarning,
                        "puck-camera runs, but no event has arrived for 2 s: does anything move in "
                        "its picture, is the lens open, is its light on?"});
  }
}

void add_losses(const BusSnapshot& snapshot, std::vector<ViewMessage>& messages) {
  for (const ChannelRow& row : snapshot.channels) {
    if (row.unauthenticated > 0) {
      messages.push_back({Level::kError, row.name + ": " + std::to_string(row.unauthenticated) +
                                             " messages without our key, the last " +
                                             row.last_rejection +
                                             "; give puck-view the services' lcm.key_file"});
    } else if (row.in_trouble && row.malformed + row.oversize > 0) {
      messages.push_back(
          {Level::kWarning, row.name + ": malformed messages, the last " + row.last_rejection});
    } else if (row.in_trouble) {
      messages.push_back(
          {Level::kWarning, row.name + ": " + std::to_string(row.arrivals.lost) +
                                " messages lost on the way to puck-view so far, and " +
                                std::to_string(row.arrivals.late) +
                                " late; the tracker may have received them all (services)"});
    }
  }
}

void add_tracker(const BusSnapshot& snapshot, const LiveFacts& facts,
                 std::vector<ViewMessage>& messages) {
  if (facts.other_sensor) {
    messages.push_back(
        {Level::kError, "the camera's sensor is " + in_words(facts.sensor) +
                            " px, but the tracker works on " + in_words(*facts.other_sensor) +
                            " px: the track is in the wrong place. Restart puck-tracker"});
  }
  const ChannelRow* events = find_row(snapshot, Channel::kEvents);
  const ChannelRow* estimates = find_row(snapshot, Channel::kEstimate);
  const bool has_events = events != nullptr && events->messages_per_s > 0;
  const bool has_estimates = estimates != nullptr && estimates->messages_per_s > 0;
  if (has_events && !has_estimates && snapshot.listened_us > kSilence_us) {
    messages.push_back(
        {Level::kWarning, "events arrive, but no estimates: is puck-tracker running on this bus?"});
  }
}

}  // namespace

bool is_silent(const BusSnapshot& snapshot) {
  if (snapshot.listened_us < kSilence_us) return false;
  return std::none_of(snapshot.channels.begin(), snapshot.channels.end(),
                      [](const ChannelRow& row) {
                        return row.type && row.newest_age_us && *row.newest_age_us < kSilence_us;
                      });
}

std::vector<ViewMessage> live_messages(const BusSnapshot& snapshot, const LiveFacts& facts) {
  std::vector<ViewMessage> messages;
  if (!facts.network_problem.empty()) {
    messages.push_back({Level::kError, "not on the bus yet: " + facts.network_problem});
  } else if (is_silent(snapshot)) {
    messages.push_back(
        {Level::kError, "no message arrives on this bus" +
                            (facts.prefix.empty() ? "" : " under the prefix " + facts.prefix) +
                            (facts.doctor.empty() ? "; asking puck-doctor why" : "")});
    messages.insert(messages.end(), facts.doctor.begin(), facts.doctor.end());
  } else {
    add_events(snapshot, facts, messages);
  }
  add_several(snapshot, messages);
  add_tracker(snapshot, facts, messages);
  add_losses(snapshot, messages);
  add_services(snapshot, messages);
  add_other_prefixes(snapshot, messages);
  std::stable_sort(messages.begin(), messages.end(),
                   [](const ViewMessage& a, const ViewMessage& b) { return a.level > b.level; });
  return messages;
}

}  // namespace puck
