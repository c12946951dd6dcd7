#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "common/io/event_filter.h"
#include "common/io/pixel_mask_file.h"

namespace puck {

/// An event filter as the command line gives it.
struct EventFilterOptions {
  EventFilterParams params;
  std::filesystem::path hot_pixel_mask;

  /// Reads the mask's file. Throws ConfigError.
  EventFilterParams with_files() const {
    EventFilterParams filter = params;
    if (hot_pixel_mask.empty()) return filter;
    filter.mask = read_pixel_mask_file(hot_pixel_mask);
    filter.mask_name = hot_pixel_mask.string();
    return filter;
  }
};

/// Options for filters that leave events out and do not move the others. `filter` must outlive the
/// parsing.
inline void add_event_filter_options(CLI::App& app, EventFilterOptions& filter) {
  using Polarity = EventFilterParams::Polarity;
  app.add_option("--hot-pixel-mask", filter.hot_pixel_mask,
                 "TOML made by puck-calibrate hot-pixels: leaves their events out");
  app.add_option_function<std::string>(
         "--polarity",
         [&filter](const std::string& polarity) {
           filter.params.polarity = polarity == "on"    ? Polarity::kOn
                                    : polarity == "off" ? Polarity::kOff
                                                        : Polarity::kBoth;
         },
         "leave out events of the other polarity")
      ->check(CLI::IsMember({"both", "on", "off"}));
  const CLI::Range durations(std::int64_t{0}, EventFilterParams::kLongestUs);
  app.add_option("--refractory-us", filter.params.refractory_us,
                 "leave out a pixel's events within so many µs of one that is kept")
      ->check(durations);
  app.add_option("--background-activity-us", filter.params.background_activity_us,
                 "leave out events before which no pixel around theirs had one within so many µs")
      ->check(durations);
}

}  // namespace puck
