#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/io/event_reader.h"
#include "tests/io/digest.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/environment.h"

namespace puck {

/// Of 200 events of the simulator (puck-simulate --seed 3, cut out), as the files simulated_* hold
/// them, which faery 0.7.1 (AEDAT4), and h5py 3.16.0 with hdf5plugin (HDF5) wrote.
inline const EventDigest kSimulatedDigest{
    200, "b9c85c912c4482a0dbbbd1be7633a3f521f60cf3dedfb64e03a874981cc8054c"};

/// A file of tests/io/data.
inline std::filesystem::path event_data(const std::string& name) {
  return source_folder() / "tests" / "io" / "data" / name;
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
