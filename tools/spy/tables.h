#pragma once

#include <string>
#include <vector>

#include "common/monitor/bus_snapshot.h"

namespace puck {

/// Head and rows of the channels, each `width` characters at most. A ! at the start marks a fault.
std::vector<std::string> channel_table(const std::vector<ChannelRow>& channels, std::size_t width);

/// The same for the services.
std::vector<std::string> service_table(const std::vector<ServiceRow>& services, std::size_t width);

/// Whether a row is marked with !.
bool is_marked(const ChannelRow& channel);
bool is_marked(const ServiceRow& service);

/// Head and rows of foreign traffic on this group and port.
std::vector<std::string> foreign_table(const std::vector<ForeignTraffic>& foreign,
                                       std::size_t width);

/// `puck-camera 4242 host`, or the address if no STATUS was heard.
std::string describe(const PublisherRow& publisher);

/// `75/671/24111 packet_to_estimate`.
std::string describe(const StatusLatency& latency);

}  // namespace puck
