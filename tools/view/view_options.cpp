#include "tools/view/view_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <utility>

#include "common/io/size_model_file.h"
#include "common/trackers/tracker_setup.h"
#include "tools/command_line/event_file_options.h"
#include "tools/command_line/number_range.h"
#include "tools/view/interface/layer_names.h"

namespace puck {
namespace {

constexpr double kLongest_s = 1e6;

std::function<void(const double&)> seconds_into(std::int64_t& time_us) {
  return [&time_us](double seconds) { time_us = std::llround(seconds * 1e6); };
}

void add_recording_options(CLI::App& app, ViewOptions& options) {
  RecordingOptions& recording = options.recording;
  app.add_option("--truth", recording.truth,
                 "true positions, as puck-evaluate takes them (default: BASE.truth.csv beside the "
                 "recording, or the log's own)");
  app.add_option("--size-model", recording.size_model,
                 "TOML made by puck-calibrate size (default: BASE.toml beside the recording)");
  app.add_option("--table", recording.table,
                 "TOML made by puck-calibrate table (default: BASE.toml beside the recording)");
  app.add_option("--tracker", options.trackers,
                 "default, correlation, paper, reference, cluster, particle-filter, "
                 "particle-filter-eros, log (what a log says) or off; two: side by side")
      ->delimiter(',')
      ->expected(1, 2);
  app.add_option("--detection-region", options.detection_region, "x,y,w,h in px");
  app.add_option_function<double>(
         "--truth-gap-ms",
         [&](double milliseconds) { recording.truth_gap_us = std::llround(milliseconds * 1e3); },
         "between rows of the truth that are farther apart there is none (default 10)")
      ->check(number_range(0, 1e6));
  app.add_option("--prefix", recording.prefix, "prefix of the channels of a log or of the bus");
  add_event_filter_options(app, options.filter);
  add_event_file_options(app, recording.file);
}

void add_picture_options(CLI::App& app, ViewOptions& options) {
  PictureFiles& files = options.files;
  auto* png = app.add_option("--png", files.png_folder,
                             "write pictures into this folder, without a browser");
  auto* every = app.add_option_function<double>("--every", seconds_into(files.every_us),
                                                "time between two pictures, s (default 0.1)")
                    ->check(number_range(1e-4, kLongest_s))
                    ->needs(png);
  auto* video = app.add_option("--video", files.video, "write a video, FILE.mp4, without a browser")
                    ->excludes(png)
                    ->excludes(every);
  app.add_option("--speed", options.speed, "of the video: 0.1 is ten times slower than it was")
      ->check(number_range(1e-3, 100))
      ->capture_default_str()
      ->needs(video);
  app.add_option_function<double>("--start", seconds_into(files.from_us),
                                  "time of the first picture, s after the first event")
      ->check(number_range(0, kLongest_s));
  app.add_option_function<double>(
         "--seconds", [&](double seconds) { files.length_us = std::llround(seconds * 1e6); },
         "length of the part, s")
      ->check(number_range(1e-3, kLongest_s));
  app.add_option("--show", options.shown,
                 "events, surface, heat-map or table; several: side by side")
      ->delimiter(',')
      ->check(CLI::IsMember({"events", "surface", "heat-map", "table"}))
      ->capture_default_str();
  app.add_option_function<double>(
         "--window-ms",
         [&](double milliseconds) { options.look.window_us = std::llround(milliseconds * 1e3); },
         "sensor time of the shown events (default 20)")
      ->check(number_range(static_cast<double>(PictureWishes::kShortestWindow_us) * 1e-3,
                           static_cast<double>(PictureWishes::kLongestWindow_us) * 1e-3));
  std::vector<std::string> names;
  for (const auto& layer : kLayerNames) names.emplace_back(layer.first);
  app.add_option("--hide", options.hidden, "marks to leave out")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_flag("--light", options.is_light, "on white instead of black");
  app.add_option("--size", options.size, "of the pictures, px")->capture_default_str();
}

void read_size(const std::string& text, PictureFiles& files) {
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%5dx%5d%c", &files.width_px, &files.height_px, &rest);
  const auto fits = [](int side) {
    return side >= PictureWishes::kLeastSide_px && side <= PictureWishes::kMostSide_px;
  };
  if (read != 2 || !fits(files.width_px) || !fits(files.height_px)) {
    throw std::invalid_argument(
        "--size: expected WIDTHxHEIGHT with sides of 64 to 4096 px, such as "
        "1280x720, got " +
        text);
  }
}

PictureWishes wishes_for(const std::string& shown, PictureWishes wishes) {
  if (shown == "table") wishes.view = PictureWishes::View::kTable;
  if (shown == "surface") wishes.backdrop = PictureWishes::Backdrop::kSurface;
  if (shown == "heat-map") wishes.backdrop = PictureWishes::Backdrop::kHeatMap;
  return wishes;
}

// Under this heading of --help: all options without one so far.
void name_group(CLI::App& app, const char* heading) {
  for (CLI::Option* option : app.get_options()) {
    const bool is_named = option->get_group() != "Options" || option == app.get_help_ptr();
    if (!is_named && !option->get_positional()) option->group(heading);
  }
}

}  // namespace

void add_options(CLI::App& app, ViewOptions& options) {
  app.add_option(
      "SOURCE", options.recording.recording,
      "recording of any format in docs/formats.md, or LCM log; without it, the live bus");
  app.add_option("--listen", options.listen,
                 "address and port of the page; on any other than this machine's own, it needs the "
                 "token in the printed URL")
      ->type_name("ADDRESS:PORT")
      ->capture_default_str();
  name_group(app, "Page");
  add_recording_options(app, options);
  name_group(app, "Recordings and logs");
  add_picture_options(app, options);
  name_group(app, "Pictures and videos without a browser");
  add_bus_options(app, options.bus);
  name_group(app, "Live bus");
}

RecordingOptions recording_options(const ViewOptions& options) {
  RecordingOptions recording = options.recording;
  recording.filter = options.filter.with_files();
  if (!options.detection_region.empty()) {
    recording.detection_region = parse_region(options.detection_region);
  }
  return recording;
}

LiveOptions live_options(const ViewOptions& options) {
  LiveOptions live{.bus = bus_params(options.bus)};
  if (!options.recording.prefix.empty()) live.bus.prefix = options.recording.prefix;
  try {
    live.size_model = read_size_model_file(find_calibration({}, options.recording.size_model));
  } catch (const std::exception& error) {
    if (!options.recording.size_model.empty()) throw;
    live.no_size_model = error.what();
  }
  return live;
}

std::array<std::string, kViewSides> trackers_of(const ViewOptions& options,
                                                const OpenedRecording& recording) {
  std::array<std::string, kViewSides> trackers{kNoTracker, kNoTracker};
  if (options.trackers.size() > trackers.size()) {
    throw std::invalid_argument("--tracker: two trackers at most are shown at a time");
  }
  std::copy(options.trackers.begin(), options.trackers.end(), trackers.begin());
  const std::vector<std::string> known = recording.trackers();
  if (options.trackers.empty() && !known.empty()) trackers[0] = known.front();
  return trackers;
}

PictureFiles picture_files(const ViewOptions& options,
                           const std::array<std::string, kViewSides>& trackers) {
  PictureFiles files = options.files;
  read_size(options.size, files);
  if (!files.video.empty()) {
    files.every_us =
        std::max<std::int64_t>(1, std::llround(options.speed * 1e6 / files.kVideo_fps));
  }
  PictureWishes look = options.look;
  if (options.is_light) look.theme = PictureWishes::Theme::kLight;
  for (const auto& [name, shown] : kLayerNames) {
    const auto& hidden = options.hidden;
    if (std::find(hidden.begin(), hidden.end(), name) != hidden.end()) look.layers.*shown = false;
  }
  for (int side = 0; side < kViewSides; ++side) {
    // Without any tracker there are still the events.
    if (side > 0 && trackers[static_cast<std::size_t>(side)] == kNoTracker) continue;
    look.side = side;
    for (const std::string& shown : options.shown) {
      files.pictures.push_back(wishes_for(shown, look));
    }
  }
  return files;
}

}  // namespace puck
