// Recordings in containers, by others' encoders; digests and counts from MANIFEST.md.
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_reader.h"
#include "tests/support/event_digest.h"
#include "tests/support/recordings.h"

namespace puck {
namespace {

constexpr const char* kWalk = "6cc80126454633c3ad721547446d656a2e563255461ccacad07819ed26a54253";
constexpr const char* kWalkUpsideDown =
    "b405fa97687faac5854ac23b89af15ce2538be7415c92125ef3356830dcb0265";

TEST_CASE("recordings in HDF5 and AEDAT4 have the events of their manifest") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  struct Walk {
    const char* file = nullptr;
    const char* digest = nullptr;
  };
  for (const Walk& walk : std::vector<Walk>{{"walk_ecf.hdf5", kWalk},
                                            {"walk_gzip.hdf5", kWalk},
                                            {"walk_lz4.aedat4", kWalkUpsideDown},
                                            {"walk_none.aedat4", kWalkUpsideDown},
                                            {"walk_zstd.aedat4", kWalkUpsideDown}}) {
    CAPTURE(walk.file);
    const auto reader = open_event_file(*recordings / "formats" / walk.file);
    CHECK(reader->sensor_size() == SensorSize{640, 480});
    for (const std::size_t max_events : {4096, 999}) {
      EventDigest digest;
      EventPacket packet;
      while (reader->read(packet, max_events)) digest.add(packet);
      CHECK(digest.text() == walk.digest);
      CHECK(reader->counters().events == 30810);
      CHECK(reader->warnings().empty());
      reader->rewind();
    }
  }
}

TEST_CASE("a DAVIS's AEDAT4 has its events, and its frames and IMU samples are counted") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const auto reader = open_event_file(*recordings / "lab_lamps_davis346_346x260.aedat4");
  CHECK(reader->sensor_size() == SensorSize{346, 260});
  EventPacket packet;
  std::int64_t first_us = 0;
  std::int64_t last_us = 0;
  while (reader->read(packet, 4096)) {
    if (first_us == 0) first_us = packet.start.us;
    last_us = packet.newest().us;
  }
  CHECK(reader->counters().events == 117667);
  CHECK((last_us - first_us + 500) / 1000 == 130);
  CHECK(reader->counters().other_data > 0);
  CHECK(reader->counters().dropped() == 0);
}

}  // namespace
}  // namespace puck
