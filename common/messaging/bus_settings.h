#pragma once

#include "common/messaging/bus.h"

namespace puck {

/// The settings under [lcm], which every service and every tool on the bus has. `Settings` has
/// read(key, value), as Config has.
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
