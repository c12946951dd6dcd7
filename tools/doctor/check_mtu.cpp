#include <algorithm>

#include "common/messaging/event_packing.h"
#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kMtu = "mtu";
constexpr int kIpAndUdpHeaderBytes = 28;

std::string set_packet_bytes(int bytes) {
  return "puck-camera --set camera.packet_bytes=" + std::to_string(bytes);
}

/// Datagrams of a camera on this host.
Finding own_packets(const Facts& facts, const NetworkInterface& interface) {
  const int fits_bytes = interface.mtu_bytes - kIpAndUdpHeaderBytes;
  const std::string sizes = "camera.packet_bytes of " + std::to_string(facts.packet_bytes);
  const std::string frame =
      interface.name + ", which carries " + std::to_string(interface.mtu_bytes) + " bytes a frame";
  if (facts.packet_bytes <= fits_bytes) {
    return {Verdict::kOk, kMtu, sizes + " fits " + frame};
  }
  if (facts.url.ttl == 0) {
    return {Verdict::kNote, kMtu,
            sizes + " is fragmented by the kernel for " + frame +
                "; harmless, as ttl=0 keeps the packets on this host"};
  }
  return {Verdict::kWrong, kMtu,
          sizes + " is fragmented by the kernel for " + frame +
              ": one lost frame loses the whole packet",
          fits_bytes >= EventPackerParams::kMinBytes
              ? set_packet_bytes(fits_bytes)
              : as_root(facts, {"ip link set " + interface.name + " mtu 1500"})};
}

}  // namespace

Findings check_mtu(const Facts& facts) {
  const NetworkInterface* interface = facts.group_interface();
  if (interface == nullptr) {
    return {{Verdict::kNote, kMtu, "not checked: the group has no interface"}};
  }
  Findings findings{own_packets(facts, *interface)};
  const int fits_bytes = interface->mtu_bytes - kIpAndUdpHeaderBytes;
  for (const auto& [source, sender] : facts.traffic.senders()) {
    const bool came_in_parts = !facts.is_own_address(source.address) && fits_bytes > 0 &&
                               sender.largest_bytes > static_cast<std::size_t>(fits_bytes);
    if (!came_in_parts) continue;
    findings.push_back({Verdict::kWrong, kMtu,
                        source.address + " sends datagrams of " +
                            std::to_string(sender.largest_bytes) + " bytes, which cross " +
                            interface->name + " in fragments; on that host",
                        set_packet_bytes(std::max(fits_bytes, EventPackerParams::kMinBytes))});
  }
  return findings;
}

}  // namespace puck
