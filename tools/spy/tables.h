#pragma once

#include <string>
#include <vector>

#include "tools/spy/snapshot.h"

namespace puck {

/// Head and rows of the channels, each `width` characters at most. A row that starts with ! has
/// something that should not be.
std::vector<std::string> channel_table(const std::vector<ChannelRow>& channels, std::size_t width);

/// The same of the services.
std::vector<std::string> service_table(const std::vector<ServiceRow>& services, std::size_t width);

/// Whether a row gets the mark.
bool is_marked(const ChannelRow& channel);
bool is_marked(const ServiceRow& service);

/// Head and rows of what others send at this group and port.
std::vector<std::string> foreign_table(const std::vector<ForeignTraffic>& foreign,
                                       std::size_t width);

/// `puck-camera 4242 host`, or the address where no STATUS says who it is.
std::string describe(const PublisherRow& publisher);

/// `running`, …; `silent` when it should have spoken, `stopped` after its last STATUS.
std::string state_of(const ServiceRow& service);

/// `75/671/24111 packet_to_estimate`.
std::string describe(const StatusLatency& latency);

}  // namespace puck
