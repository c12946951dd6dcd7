#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/io/event_reader.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/environment.h"
#include "tests/support/event_digest.h"

namespace puck {

/// Of the 200 events of the simulator (puck-simulate --seed 3, cut out) in tests/data/events. The
/// files were written by faery 0.7 (AEDAT4) and h5py 3 with hdf5plugin (HDF5).
inline constexpr const char* kSimulatedDigest =
    "b9c85c912c4482a0dbbbd1be7633a3f521f60cf3dedfb64e03a874981cc8054c";

/// A file of tests/data/events.
inline std::filesystem::path event_data(const std::string& name) {
  return source_folder() / "tests" / "data" / "events" / name;
}

/// Of all that the reader still returns.
inline std::string digest_of(EventReader& reader, std::size_t max_events = 999) {
  EventDigest digest;
  EventPacket packet;
  while (reader.read(packet, max_events)) digest.add(packet);
  return digest.text();
}

/// `count` events over a sensor of 64 x 48, with times of a µs to some ms apart.
inline std::vector<PlainEvent> scattered_events(int count, std::int64_t start_us = 1000) {
  std::vector<PlainEvent> events;
  std::int64_t t_us = start_us;
  for (int i = 0; i < count; ++i) {
    t_us += i % 3 == 0 ? i * 37 % 1900 : 0;
    events.push_back({t_us, i * 7 % 64, i * 5 % 48, i / 3 % 2});
  }
  return events;
}

}  // namespace puck
