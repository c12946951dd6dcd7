#pragma once

#include <cstdint>

namespace puck {

/// Content of a picture, as its viewer asks for it. Plain data; every value is valid or clamped.
struct PictureWishes {
  enum class View : std::uint8_t {
    kCamera,  ///< The sensor's picture.
    kTable,   ///< The table from above.
  };
  enum class Backdrop : std::uint8_t {
    kEvents,   ///< Events of the window, by polarity.
    kSurface,  ///< The surface that the tracker sees.
    kHeatMap,  ///< Similarity of each place to a puck of the size expected there.
  };
  enum class Theme : std::uint8_t { kDark, kLight };

  /// Parts of the camera's picture on top of the backdrop; hidden ones cost nothing.
  struct Layers {
    bool regions = true;     ///< ROI_d or ROI_t of the newest step.
    bool ellipse = true;     ///< The estimate.
    bool velocity = true;    ///< Arrow to the position predicted 50 ms ahead.
    bool covariance = true;  ///< Ellipse of two standard deviations of the position.
    bool trail = true;       ///< Positions of the last second.
    bool truth = true;
    bool close_up = true;  ///< The puck enlarged in a corner, where it is small.
    bool words = true;     ///< Time, state, speed and error in the picture's corners.
    bool legend = true;

    bool operator==(const Layers&) const = default;
  };

  static constexpr std::int64_t kShortestWindow_us = 100;
  static constexpr std::int64_t kLongestWindow_us = 1'000'000;
  static constexpr int kLeastSide_px = 64;
  static constexpr int kMostSide_px = 4096;

  View view = View::kCamera;
  Backdrop backdrop = Backdrop::kEvents;
  Theme theme = Theme::kDark;
  int side = 0;                     ///< Track 0 or 1.
  std::int64_t window_us = 20'000;  ///< Sensor time of the shown events.
  Layers layers;
  /// Size of the picture, px; the sensor or table fills it as far as its shape allows.
  int width_px = 960;
  int height_px = 720;

  bool operator==(const PictureWishes&) const = default;
};

}  // namespace puck
