#include "common/io/event_filter_config.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "common/io/lens_file.h"
#include "common/io/pixel_mask_file.h"

namespace puck {
namespace {

void read_crop(Config& config, EventFilterParams& filter) {
  const std::string& key = filter.crop_name;
  std::vector<double> crop;
  config.read(key, crop, 0, SensorSize::kMax);
  if (crop.empty()) return;
  const bool is_whole = std::all_of(crop.begin(), crop.end(),
                                    [](double number) { return number == std::floor(number); });
  if (crop.size() != 4 || !is_whole || crop[2] < 1 || crop[3] < 1) {
    config.fail_expected(key, "[] or [x, y, width, height] in whole px");
  }
  filter.crop = Region{static_cast<int>(crop[0]), static_cast<int>(crop[1]),
                       static_cast<int>(crop[2]), static_cast<int>(crop[3])};
}

void read_polarity(Config& config, const std::string& key, EventFilterParams& filter) {
  constexpr std::array<std::string_view, 3> kPolarities{"both", "on", "off"};
  std::string polarity = "both";
  config.read_choice(key, polarity, kPolarities);
  using Polarity = EventFilterParams::Polarity;
  filter.polarity = polarity == "on"    ? Polarity::kOn
                    : polarity == "off" ? Polarity::kOff
                                        : Polarity::kBoth;
}

void read_turn(Config& config, const std::string& table, PictureTurn& turn) {
  config.read(table + ".flip_x", turn.flip_x);
  config.read(table + ".flip_y", turn.flip_y);
  const std::string key = table + ".rotate_deg";
  config.read(key, turn.rotate_deg, std::numeric_limits<int>::lowest(),
              std::numeric_limits<int>::max());
  if (turn.rotate_deg % 90 != 0 || turn.rotate_deg < 0 || turn.rotate_deg > 270) {
    config.fail_expected(key, "0, 90, 180 or 270");
  }
  bool rotate_180 = false;
  const std::string short_key = table + ".rotate_180";
  config.read(short_key, rotate_180);
  if (!rotate_180) return;
  if (turn.rotate_deg != 0) config.fail_expected(short_key, "false when " + key + " is set");
  turn.rotate_deg = 180;
}

}  // namespace

EventFilterParams read_event_filter(Config& config, const std::string& table) {
  EventFilterParams filter;
  filter.mask_name = table + ".hot_pixel_mask";
  filter.crop_name = table + ".crop";
  filter.lens_name = table + ".undistort";
  std::string mask;
  config.read(filter.mask_name, mask);
  if (!mask.empty()) filter.mask = read_pixel_mask_file(mask);
  read_crop(config, filter);
  read_polarity(config, table + ".polarity", filter);
  constexpr std::int64_t kLongestUs = EventFilterParams::kLongestUs;
  config.read(table + ".refractory_us", filter.refractory_us, std::int64_t{0}, kLongestUs);
  config.read(table + ".background_activity_us", filter.background_activity_us, std::int64_t{0},
              kLongestUs);
  read_turn(config, table, filter.turn);
  std::string lens;
  config.read(filter.lens_name, lens);
  if (!lens.empty()) filter.lens = read_lens_file(lens);
  return filter;
}

}  // namespace puck
