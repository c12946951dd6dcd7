#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/io/event_writer.h"
#include "common/io/truth_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/moving_contour.h"

namespace puck::test {

inline constexpr SensorSize kDiscSensor{160, 120};
inline constexpr PuckSize kDiscSize{20, 16};
inline constexpr std::int64_t kDiscBegin_us = 1'000'000;
inline constexpr std::int64_t kDiscEnd_us = 1'900'000;
/// Between these times the disc makes no events, as if it rested, though by truth it moves on.
inline constexpr std::int64_t kGapBegin_us = 1'400'000;
inline constexpr std::int64_t kGapEnd_us = 1'700'000;

/// Where the disc is, by truth.
inline Pixel disc_at(std::int64_t time_us) {
  return {30 + 100 * static_cast<double>(time_us - kDiscBegin_us) * 1e-6, 60};
}

/// disc.raw with a disc that moves to the right, its truth and size model beside it.
class DiscRecording {
 public:
  DiscRecording() {
    PuckSizeModel model;
    model.width_0 = kDiscSize.width;
    model.height_0 = kDiscSize.height;
    const PuckContour contour(kDiscSensor, model, {});
    const Pixel origin = disc_at(0);
    MovingContour disc(contour, origin, {100, 0});
    const auto writer = make_event_writer(path(), "", kDiscSensor);
    for (const auto& [from_us, to_us] :
         {std::pair(kDiscBegin_us, kGapBegin_us), std::pair(kGapEnd_us, kDiscEnd_us)}) {
      writer->write(packet_of(disc.events(from_us, to_us), kDiscSensor, from_us, from_us));
    }
    writer->close();
    std::vector<TruthRow> truth;
    for (std::int64_t t = kDiscBegin_us; t <= kDiscEnd_us; t += 1000) {
      truth.push_back({{t}, disc_at(t), kDiscSize});
    }
    write_truth_file(folder_ / "disc.truth.csv", truth);
    folder_.write("disc.toml",
                  "[size_model]\nwidth_0 = 20.0\nwidth_x = 0.0\nwidth_y = 0.0\n"
                  "height_0 = 16.0\nheight_x = 0.0\nheight_y = 0.0\n");
  }

  std::filesystem::path path() const { return folder_ / "disc.raw"; }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

}  // namespace puck::test
