#pragma once

#include "common/messaging/bus.h"

namespace puck {

/// Reads the keys of [lcm], common to all services and tools on the bus. `Settings` has a read(key,
/// value) like Config's.
template <typename Settings>
BusParams read_bus_params(Settings& settings) {
  BusParams params;
  settings.read("lcm.url", params.url);
  settings.read("lcm.prefix", params.prefix);
  settings.read("lcm.allow_fragments", params.allow_fragments);
  settings.read("lcm.key_file", params.key_file);
  return params;
}

}  // namespace puck
