#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

#include "common/events/timestamp.h"
#include "common/vision/geometry/image.h"
#include "tools/view/drawing/palette.h"
#include "tools/view/interface/newest_events.h"

namespace puck {

/// Colours the events of the last `window_us` before `now` by polarity, older ones fainter, one
/// pixel of `out` for each of the sensor. Events after `now` are left out.
void draw_events(const NewestEvents& events, Timestamp now, std::int64_t window_us,
                 const Palette& palette, cv::Mat& out);

/// Draws a surface in grey: full grey in the palette's colour of words.
void draw_surface(const Image<std::uint8_t>& surface, const Palette& palette, cv::Mat& out);

/// Draws scores of 0 to 255 in colours whose lightness grows.
void draw_heat(const Image<std::uint8_t>& heat, cv::Mat& out);

}  // namespace puck
