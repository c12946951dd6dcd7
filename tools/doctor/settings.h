#pragma once

#include <string>

#include "common/messaging/lcm_url.h"
#include "tools/command_line/bus_options.h"

namespace puck {

/// From the command line.
struct DoctorOptions : BusOptions {
  double seconds = 2;
  bool json = false;
};

/// What the doctor looks at.
struct DoctorSettings {
  LcmUrl url;
  std::string prefix;
  bool allow_fragments = false;
  std::string key_file;  ///< Empty: the bus has no key.
  int packet_bytes = 0;  ///< Largest datagram of a camera with these settings.
  double seconds = 0;
};

/// Reads a service's file, of which only [lcm] and camera.packet_bytes count. `settings` may hold
/// these keys only. Throws ConfigError or BusError.
DoctorSettings read_doctor_settings(const DoctorOptions& options);

}  // namespace puck
