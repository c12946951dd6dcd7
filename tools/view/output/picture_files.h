#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"
#include "tools/view/recording/opened_recording.h"

namespace puck {

/// Pictures of a recording that go into files.
struct PictureFiles {
  static constexpr double kVideo_fps = 30;

  std::filesystem::path png_folder;  ///< One of the two: made if it does not exist …
  std::filesystem::path video;       ///< … or a file that ends in .mp4.
  std::int64_t every_us = 100'000;   ///< Sensor time between two pictures.
  std::int64_t from_us = 0;          ///< Since the first event.
  std::optional<std::int64_t> length_us;
  std::vector<PictureWishes> pictures;  ///< At least one, side by side.
  int width_px = 1280;
  int height_px = 720;
};

/// Runs the trackers over the recording, which they see from its first event on, and writes a
/// picture every so often. A bar on a terminal shows the progress. Returns the number of pictures.
/// Throws std::runtime_error with one line when a file cannot be written, std::invalid_argument
/// when the part holds no picture.
int write_pictures(const OpenedRecording& recording,
                   const std::array<std::string, kViewSides>& trackers, const PictureFiles& files);

}  // namespace puck
