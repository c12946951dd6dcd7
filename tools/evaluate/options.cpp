#include "tools/evaluate/options.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

#include "common/messaging/event_packing.h"
#include "common/vision/contour_params.h"
#include "tools/command_line/number_range.h"

namespace puck {

void add_options(CLI::App& app, EvaluateOptions& options) {
  app.add_option("EVENTS", options.events,
                 "recording: Prophesee RAW (EVT2, EVT3), text, or a log of LCM")
      ->required();
  app.add_option(
      "--truth", options.truth,
      "where the puck truly was: t_us,x,y,width,height; a log of a simulated game has its own");
  app.add_option("--algorithm", options.algorithm)
      ->check(CLI::IsMember({"puck", "cluster", "particle-filter", "particle-filter-eros"}))
      ->capture_default_str();
  app.add_option("--preset", options.preset)
      ->check(CLI::IsMember({"default", "correlation", "paper", "reference"}))
      ->capture_default_str();
  app.add_option("--size-model", options.size_model, "TOML made by puck-calibrate size");
  app.add_option("--hot-pixel-mask", options.hot_pixel_mask,
                 "TOML made by puck-calibrate hot-pixels: leaves their events out");
  app.add_option("--without", options.without,
                 "an ingredient that preset default is to do without; may be given again");
  app.add_flag_callback(
      "--list-ingredients",
      [] {
        for (const ContourIngredient& ingredient : kContourIngredients) {
          std::printf("%s\n", std::string(ingredient.name).c_str());
        }
        throw CLI::Success();
      },
      "print what --without takes, and stop");
  app.add_option("--detection-region", options.detection_region, "x,y,w,h in px");
  app.add_flag("--roi-only", options.roi_only,
               "while there is a track, keep only its region of the surface up to date");
  auto* rate = app.add_option("--rate", options.rate_hz, "estimates a second of sensor time")
                   ->check(number_range(1, 1e6))
                   ->capture_default_str();
  auto* real_time = app.add_flag("--real-time", options.real_time,
                                 "play at the recording's pace: measures latency");
  auto* fast =
      app.add_flag("--as-fast-as-possible", options.as_fast_as_possible, "measures throughput");
  real_time->excludes(rate)->excludes(fast);
  fast->excludes(rate);
  auto* replay =
      app.add_flag(
             "--replay", options.replay,
             "of a log: make each of its estimates again, after as many events, and compare; "
             "exit code 1 when they differ too much. The settings must be those of the tracker")
          ->excludes(rate)
          ->excludes(real_time)
          ->excludes(fast);
  app.add_option("--max-difference-px", options.max_difference_px,
                 "bound on the mean difference of a replay")
      ->check(number_range(0, 1e6))
      ->capture_default_str()
      ->needs(replay);
  app.add_flag("--exact", options.exact,
               "every estimate of a replay must be equal to the bit: those of a tracker that ran "
               "with tracker.reproducible are")
      ->needs(replay);
  app.add_option("--search-delay", options.search_delay_us,
                 "what a search found is told so many µs later, as on a busy machine")
      ->check(number_range(0, 1e6))
      ->excludes(replay)
      ->excludes(real_time);
  constexpr double kLongest_s = 1e6;
  const auto seconds_into = [](std::int64_t& time_us) {
    return [&time_us](double seconds) { time_us = std::llround(seconds * 1e6); };
  };
  app.add_option_function<double>("--start", seconds_into(options.part.from_us),
                                  "begin so many seconds after the first event, knowing nothing "
                                  "of what was before")
      ->check(number_range(0, kLongest_s))
      ->excludes(replay);
  app.add_option_function<double>("--seconds", seconds_into(options.part.length_us),
                                  "stop so many seconds later")
      ->check(number_range(1e-3, kLongest_s))
      ->excludes(replay);
  auto* drop = app.add_option_function<double>(
                      "--drop-packets",
                      [&options](double percent) {
                        options.drops_packets = true;
                        options.loss.drop_percent = percent;
                      },
                      "cut the events into packets as a camera would, and lose so many percent of "
                      "them; compare with 0")
                   ->check(number_range(0, 100))
                   ->excludes(replay);
  app.add_option("--drop-seed", options.loss.seed, "the same seed loses the same packets")
      ->capture_default_str()
      ->needs(drop);
  app.add_option("--packet-bytes", options.loss.packet_bytes,
                 "largest packet; the default fits one Ethernet frame")
      ->check(number_range(EventPackerParams::kMinBytes, EventPackerParams::kMaxBytes))
      ->capture_default_str()
      ->needs(drop);
  app.add_option("--json", options.json, "write the figures here");
  app.add_option("--csv", options.csv, "write a row a tick here");
  app.add_option("--plots", options.plots, "write plots into this folder");
  auto* picture =
      app.add_option("--picture", options.picture, "write a picture of the tracked puck here: PNG");
  app.add_option("--picture-at", options.picture_at_s,
                 "seconds after the first event (default: when the tracked puck is fastest)")
      ->check(number_range(0, kLongest_s))
      ->needs(picture);
  picture->excludes(fast);
  app.add_option("--prefix", options.prefix, "of the channels in a log");
  app.add_option("--from", options.file.from, "format of EVENTS, where it does not say so itself")
      ->check(CLI::IsMember({"evt2", "evt3", "text"}));
  app.add_option("--width", options.file.sensor.width, "sensor, px, where EVENTS does not say");
  app.add_option("--height", options.file.sensor.height, "sensor, px, where EVENTS does not say");
  app.add_option("--columns", options.file.text_columns, "text: order of the columns")
      ->capture_default_str();
  app.add_option("--unit", options.file.text_unit, "text: unit of the times")
      ->check(CLI::IsMember({"auto", "s", "us"}))
      ->capture_default_str();
}

}  // namespace puck
