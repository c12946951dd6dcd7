#pragma once

#include <string>

#include "common/io/config.h"
#include "common/io/event_filter.h"

namespace puck {

/// Reads the filter keys of a table, such as "camera": hot_pixel_mask, crop, polarity,
/// refractory_us, background_activity_us, flip_x, flip_y, rotate_deg, rotate_180 and undistort.
/// Throws ConfigError.
EventFilterParams read_event_filter(Config& config, const std::string& table);

}  // namespace puck
