#include "tools/doctor/gather.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include "tools/doctor/listen.h"
#include "tools/doctor/programs.h"
#include "tools/doctor/udp_listener.h"

namespace puck {
namespace {

std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::optional<std::int64_t> read_number(const std::string& path) {
  std::ifstream file(path);
  std::int64_t number = 0;
  if (!(file >> number)) return std::nullopt;
  return number;
}

std::optional<KernelCounters> read_counters() {
  const std::string snmp = read_text("/proc/self/net/snmp");
  const std::string netstat = read_text("/proc/self/net/netstat");
  if (snmp.empty()) return std::nullopt;
  // Without UDP's InErrors: it also counts datagrams rejected by a receiver's own filter.
  return KernelCounters{
      .reassembly_failures = find_counter(snmp, "Ip", "ReasmFails").value_or(0),
      .buffer_overflows = find_counter(snmp, "Udp", "RcvbufErrors").value_or(0),
      .checksum_errors = find_counter(snmp, "Udp", "InCsumErrors").value_or(0),
      .reverse_path_drops = find_counter(netstat, "TcpExt", "IPReversePathFilter").value_or(0)};
}

std::map<std::string, int> read_reverse_path_filter() {
  std::map<std::string, int> settings;
  std::error_code error;
  for (const auto& folder : std::filesystem::directory_iterator("/proc/sys/net/ipv4/conf", error)) {
    const auto setting = read_number((folder.path() / "rp_filter").string());
    if (setting) settings[folder.path().filename()] = static_cast<int>(*setting);
  }
  return settings;
}

/// A program's output; empty if it is missing or fails.
std::optional<std::string> output_of(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> part{};
  for (std::size_t size = 0; (size = std::fread(part.data(), 1, part.size(), pipe)) > 0;) {
    text.append(part.data(), size);
  }
  if (pclose(pipe) != 0) return std::nullopt;
  return text;
}

std::optional<std::vector<FirewallDrop>> read_firewall(int port) {
  // Administration tools are often not on a user's PATH.
  const std::string path = "PATH=$PATH:/usr/sbin:/sbin ";
  if (const auto ruleset = output_of(path + "nft -j list ruleset")) {
    return find_nft_drops(*ruleset, port);
  }
  if (const auto rules = output_of(path + "iptables -S")) return find_iptables_drops(*rules, port);
  return std::nullopt;
}

void read_port_users(Facts& facts) {
  std::set<std::uint64_t> inodes;
  for (const UdpSocket& socket : parse_udp_sockets(read_text("/proc/self/net/udp"))) {
    const bool hears_the_group = socket.address == "0.0.0.0" || socket.address == facts.url.group;
    if (socket.port == facts.url.port && hears_the_group) inodes.insert(socket.inode);
  }
  facts.sockets_at_port = static_cast<int>(inodes.size());
  for (const auto& found : find_programs(inodes)) {
    const auto& program = found.second;
    const auto known = std::find_if(facts.port_users.begin(), facts.port_users.end(),
                                    [&](const auto& user) { return user.program == program; });
    if (known != facts.port_users.end()) {
      ++known->sockets;
    } else {
      facts.port_users.push_back({program, 1});
    }
  }
}

void name_local_senders(Facts& facts) {
  std::map<int, std::uint64_t> inode_of_port;
  std::set<std::uint64_t> inodes;
  for (const UdpSocket& socket : parse_udp_sockets(read_text("/proc/self/net/udp"))) {
    inode_of_port[socket.port] = socket.inode;
    inodes.insert(socket.inode);
  }
  const auto programs = find_programs(inodes);
  for (const auto& [source, sender] : facts.traffic.senders()) {
    const auto inode = inode_of_port.find(source.port);
    if (inode == inode_of_port.end() || !facts.is_own_address(source.address)) continue;
    const auto program = programs.find(inode->second);
    if (program != programs.end()) facts.local_senders[source] = program->second;
  }
}

}  // namespace

Facts gather(const DoctorSettings& settings) {
  Facts facts;
  facts.url = settings.url;
  facts.prefix = settings.prefix;
  facts.allow_fragments = settings.allow_fragments;
  facts.key_file = settings.key_file;
  facts.packet_bytes = settings.packet_bytes;
  facts.seconds = settings.seconds;
  facts.version = PUCK_VERSION;

  facts.is_root = geteuid() == 0;
  facts.interfaces = list_network_interfaces();
  facts.route = find_kernel_route(settings.url.group);
  facts.rmem_max_bytes = read_number("/proc/sys/net/core/rmem_max");
  facts.buffer_bytes = granted_buffer_bytes(settings.url);
  facts.reverse_path_filter = read_reverse_path_filter();
  facts.firewall = read_firewall(settings.url.port);
  facts.memberships = parse_memberships(read_text("/proc/self/net/igmp"));
  read_port_users(facts);

  facts.before = read_counters();
  listen(facts);
  facts.after = read_counters();
  name_local_senders(facts);
  return facts;
}

}  // namespace puck
