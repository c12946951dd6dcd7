#include "tools/doctor/settings.h"

#include "common/io/config.h"
#include "common/messaging/bus_error.h"
#include "common/messaging/bus_settings.h"
#include "common/messaging/channels.h"
#include "common/messaging/event_packing.h"

namespace puck {
namespace {

/// The file's settings, overridden by the assignments.
Config merged(const DoctorOptions& options) {
  Config config = options.config_file.empty() ? Config{} : Config::from_file(options.config_file);
  for (const std::string& setting : options.settings) config.override_with(setting);
  return config;
}

int read_packet_bytes(Config& config) {
  int packet_bytes = 0;  // 0: chosen from the URL.
  config.read("camera.packet_bytes", packet_bytes, 0, EventPackerParams::kMaxBytes);
  return packet_bytes;
}

/// Separate from the file, so that an unknown key is reported.
void check_assignments(const DoctorOptions& options) {
  Config assignments;
  for (const std::string& setting : options.settings) assignments.override_with(setting);
  read_bus_params(assignments);
  read_packet_bytes(assignments);
  assignments.reject_unknown();
}

/// The same choice as in puck-camera.
int packet_bytes_for(const LcmUrl& url) {
  return url.ttl == 0 ? EventPackerParams::kMaxBytes : EventPackerParams::kOneFrame;
}

}  // namespace

DoctorSettings read_doctor_settings(const DoctorOptions& options) {
  check_assignments(options);
  Config config = merged(options);
  BusParams bus = read_bus_params(config);
  const int packet_bytes = read_packet_bytes(config);
  if (options.lcm_url) bus.url = *options.lcm_url;
  if (options.prefix) bus.prefix = *options.prefix;

  DoctorSettings settings;
  settings.url = parse_lcm_url(bus.url);
  if (settings.url.in_memory) {
    throw BusError("lcm.url \"" + bus.url + "\" reaches its own process only");
  }
  check_prefix(bus.prefix);
  settings.prefix = bus.prefix;
  settings.allow_fragments = bus.allow_fragments;
  settings.key_file = bus.key_file;
  settings.packet_bytes = packet_bytes != 0 ? packet_bytes : packet_bytes_for(settings.url);
  settings.seconds = options.seconds;
  return settings;
}

}  // namespace puck
