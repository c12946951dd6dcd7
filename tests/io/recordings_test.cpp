// Real recordings by others.
#include "tests/support/recordings.h"

#include <cstdint>
#include <filesystem>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_reader.h"
#include "common/io/truth_file.h"
#include "tests/io/digest.h"

namespace puck {
namespace {

struct Expected {
  const char* file = nullptr;
  SensorSize sensor;
  std::int64_t events = 0;
  const char* sha256 = nullptr;  ///< As EventDigest.
  /// Independent decoder that gave the digest: a library of PyPI and its version, or numpy with the
  /// format's specification.
  const char* library = nullptr;
  bool is_sized = true;  ///< States its sensor's size.
};

constexpr const char* kWalk = "6cc80126454633c3ad721547446d656a2e563255461ccacad07819ed26a54253";
constexpr const char* kTurnedWalk =
    "b405fa97687faac5854ac23b89af15ce2538be7415c92125ef3356830dcb0265";

const std::vector<Expected> kRecordings{
    {"sparklers_gen31_640x480_evt2.raw",
     {640, 480},
     521252,
     "b9f7d6670c2fa9b06dba52a6b7b8056badb024251acad2a55cf6cc4debbe5168",
     "expelliarmus 1.1.12, faery 0.7.1"},
    {"driving_gen41_1280x720_evt3.raw",
     {1280, 720},
     219596,
     "65c47c10eb9c27e7dfb9457311f0ef4c63ee949280007081461ade2aaa70c070",
     "evlib 0.13.2"},
    {"walking_640x480_evt3.extracted.raw",
     {640, 480},
     343474,
     "21afa3ab97d0287775496b3ab61538fbd9fee608932b155f8077f295f3bde87d",
     "faery 0.7.1",
     false},
    {"plane_320x240.es",
     {320, 240},
     473225,
     "b4d80a38a1b62beea05baeadb8f17efcafef039fde6a4bbce7d0fc4e04c9f2e8",
     "faery 0.7.1"},
    {"ncars_td.dat",
     {128, 128},
     2009,
     "c33bef8709d547e9f263468b88d0107536075997e5db3c4cbfe1229fc36674f2",
     "expelliarmus 1.1.12",
     false},
    {"shapes_rotation_davis240c_240x180.txt",
     {240, 180},
     30000,
     "894ee4eb42e3984c1fda7e058ac76add8064a0ac703ce1746d481a978cbb4216",
     "evlib 0.13.2",
     false},
    {"dynamic_translation_davis240c_240x180.txt",
     {240, 180},
     30000,
     "b9e85b35d7fd3ebd90e36e68d43216cf5a9eebdecfc4810a30e198033ef3d0ca",
     "evlib 0.13.2",
     false},
    {"second_simulator/still_faint_6_m_s.raw",
     {640, 480},
     1068200,
     "9cebafaebb955da1991bd68157a56cdb3b977f6a954879f51710d47350b1310b",
     "evlib 0.13.2, faery 0.7.1"},
    {"second_simulator/still_shots_15_m_s.raw",
     {640, 480},
     1979675,
     "eb9b33889fea8cc062bfc82716a6f1d03559280a16508d9a86b2ec56f96ba3ec",
     "faery 0.7.1"},
    {"second_simulator/moving_round_logos.raw",
     {640, 480},
     3474349,
     "44963a659bdc69cd1b26303102314881d4a89db66bcd992df28980d04a005e4a",
     "faery 0.7.1"},
    {"second_simulator/moving_faint_5_m_s.raw",
     {640, 480},
     2467790,
     "6653fccf2126a112d1db415912687683dc2b8a17ad998ed162acac0eebf1517d",
     "faery 0.7.1"},
    {"formats/walk_evt2.raw", {640, 480}, 30810, kWalk, "expelliarmus 1.1.12, faery 0.7.1"},
    {"formats/walk_evt21_little.raw", {640, 480}, 30810, kWalk, "the manifest's encoder"},
    {"formats/walk_evt21_legacy.raw", {640, 480}, 30810, kWalk, "the manifest's encoder"},
    {"formats/walk_evt3.raw", {640, 480}, 30810, kWalk, "evlib 0.13.2, faery 0.7.1"},
    {"formats/walk_dat2.dat", {640, 480}, 30810, kWalk, "expelliarmus 1.1.12, faery 0.7.1"},
    {"formats/walk.es", {640, 480}, 30810, kWalk, "faery 0.7.1"},
    {"formats/walk.csv", {640, 480}, 30810, kTurnedWalk, "faery 0.7.1"},
    {"formats/walk_ecf.hdf5", {640, 480}, 30810, kWalk, "the manifest's decoder"},
    {"formats/walk_gzip.hdf5", {640, 480}, 30810, kWalk, "h5py 3.16.0"},
    {"formats/walk_none.aedat4", {640, 480}, 30810, kTurnedWalk, "faery 0.7.1"},
    {"formats/walk_lz4.aedat4", {640, 480}, 30810, kTurnedWalk, "faery 0.7.1"},
    {"formats/walk_zstd.aedat4", {640, 480}, 30810, kTurnedWalk, "faery 0.7.1"},
    {"formats/dart_dvs128.aedat2.aedat",
     {128, 128},
     9692,
     "9585233b4543bb2907bb7e9109d0ade828600e0b9a3510692e30dee3fbcc5220",
     "numpy 2.4.6, as jAER reads it"},
};

TEST_CASE("real recordings have the events that independent decoders find") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  for (const Expected& expected : kRecordings) {
    CAPTURE(expected.file);
    CAPTURE(expected.library);
    const auto reader = open_event_file(*recordings / expected.file);
    CHECK(reader->sensor_size() == expected.sensor);
    CHECK(digest_of(*reader) == EventDigest{expected.events, expected.sha256});
    CHECK(reader->counters().reordered == 0);
    CHECK(reader->warnings().size() == (expected.is_sized ? 0 : 1));
    reader->rewind();
    CHECK(digest_of(*reader, 77777) == EventDigest{expected.events, expected.sha256});
  }
}

TEST_CASE("a DAVIS's AEDAT4 has its events, and its frames and IMU samples are counted") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const auto reader = open_event_file(*recordings / "lab_lamps_davis346_346x260.aedat4");
  CHECK(reader->sensor_size() == SensorSize{346, 260});
  // By aedat 2.3.0 and dv-processing 2.0.4.
  CHECK(digest_of(*reader) ==
        EventDigest{117667, "c8990772e8fb37e78987592b0354dd707c773c47f490169ec4de3514764c3a96"});
  CHECK(reader->counters().other_data == 27);
  CHECK(reader->counters().dropped() == 0);
}

TEST_CASE("the truth of a real recording is readable, and lies within the recording") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const std::filesystem::path& folder = *recordings;
  const auto rows = read_truth_file(folder / "shapes_rotation_davis240c_240x180.truth.csv");
  REQUIRE(rows.size() == 26);
  CHECK(rows[0].time.us == 43506029);
  CHECK(rows[0].centre == Pixel{66.6, 40.1});
  CHECK(rows[0].size.width == 33.1);
  CHECK(rows[0].size.height == 22.4);
  CHECK(rows[0].visible == 1);
}

}  // namespace
}  // namespace puck
