#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/io/event_writer.h"
#include "common/io/lens_file.h"
#include "common/recording/recording.h"
#include "tools/command_line/event_file_options.h"
#include "tools/command_line/event_filter_options.h"
#include "tools/command_line/flush_stdout.h"
#include "tools/command_line/log_prefix_option.h"
#include "tools/command_line/number_range.h"
#include "tools/command_line/run_tool.h"
#include "tools/convert/conversion.h"

namespace puck {
namespace {

std::string format_list() {
  std::string text = "Formats to write (--to), with the ending that means them:\n";
  for (const WrittenFormat& format : kWrittenFormats) {
    char line[120];
    std::snprintf(line, sizeof line, "  %-9s %-8s %s\n", std::string(format.name).c_str(),
                  std::string(format.ending).c_str(), std::string(format.what).c_str());
    text += line;
  }
  return text + "  lcm       .lcm     LCM log of PUCK_EVENTS";
}

/// What the picture becomes, as the command line gives it.
struct PictureOptions {
  std::vector<int> crop;
  bool rotate_180 = false;
  std::filesystem::path lens;

  void apply_to(EventFilterParams& filter) const {
    filter.crop_name = "--crop";
    filter.crop_is_sensor = true;
    if (crop.size() == 4) filter.crop = Region{crop[0], crop[1], crop[2], crop[3]};
    if (rotate_180) filter.turn.rotate_deg = 180;
    if (lens.empty()) return;
    filter.lens_name = lens.string();
    filter.lens = read_lens_file(lens);
  }
};

void add_picture_options(CLI::App& app, PictureOptions& picture, PictureTurn& turn) {
  app.add_option("--crop", picture.crop, "x,y,width,height, px: becomes the whole picture")
      ->delimiter(',')
      ->expected(4);
  app.add_flag("--flip-x", turn.flip_x, "mirror the picture: left becomes right");
  app.add_flag("--flip-y", turn.flip_y, "mirror the picture: top becomes bottom");
  auto* rotate = app.add_option("--rotate", turn.rotate_deg, "then rotate it clockwise, degrees")
                     ->check(CLI::IsMember({0, 90, 180, 270}));
  app.add_flag("--rotate-180", picture.rotate_180, "the same as --rotate 180")->excludes(rotate);
  app.add_option("--undistort", picture.lens,
                 "TOML of the lens, in OpenCV's model: removes its distortion");
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  CLI::App app("Converts a recording of events into another format.");
  puck::ConvertOptions options;
  puck::EventFilterOptions filter;
  puck::PictureOptions picture;
  app.add_option("IN", options.in, "recording of any format; - is stdin")->required();
  app.add_option("OUT", options.out, "file to write; - is stdout")->required();
  app.add_option("--to", options.to, "format to write; without it, from OUT's ending")
      ->check(CLI::IsMember(puck::written_format_names()));
  puck::add_event_file_options(app, options.file);
  puck::add_log_prefix_option(app, options.prefix);
  constexpr double kLongest_s = 1e9;
  app.add_option_function<double>(
         "--start", [&](double seconds) { options.filter.from_us = std::llround(seconds * 1e6); },
         "leave out what comes before, s since the first event")
      ->check(puck::number_range(0, kLongest_s));
  app.add_option_function<double>(
         "--seconds",
         [&](double seconds) { options.filter.length_us = std::llround(seconds * 1e6); },
         "length from there on, s")
      ->check(puck::number_range(1e-6, kLongest_s));
  app.add_flag("--start-at-zero", options.filter.start_at_zero,
               "count times from the first event that is written");
  puck::add_event_filter_options(app, filter);
  puck::add_picture_options(app, picture, filter.params.turn);
  app.footer(puck::format_list());
  return puck::run_tool(app, argc, argv, "puck-convert", [&] {
    options.filter.events = filter.with_files();
    picture.apply_to(options.filter.events);
    const bool is_complete = puck::convert(options);
    puck::flush_stdout();
    return is_complete ? 0 : 1;
  });
}
