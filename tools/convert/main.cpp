#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/io/event_writer.h"
#include "common/io/pixel_mask_file.h"
#include "common/recording/recording.h"
#include "tools/command_line/event_file_options.h"
#include "tools/command_line/flush_stdout.h"
#include "tools/command_line/number_range.h"
#include "tools/command_line/run_tool.h"
#include "tools/convert/conversion.h"

namespace puck {
namespace {

std::vector<std::string> written_names() {
  std::vector<std::string> names;
  for (const WrittenFormat& format : kWrittenFormats) names.emplace_back(format.name);
  names.emplace_back(kLcmLogFormat);
  return names;
}

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

void parse_crop(const std::vector<int>& numbers, EventFilterParams& filter) {
  if (numbers.size() == 4) filter.crop = Region{numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  CLI::App app("Converts a recording of events into another format.");
  puck::ConvertOptions options;
  std::vector<int> crop;
  std::filesystem::path mask;
  app.add_option("IN", options.in, "recording of any format; - is stdin")->required();
  app.add_option("OUT", options.out, "file to write; - is stdout")->required();
  app.add_option("--to", options.to, "format to write; without it, from OUT's ending")
      ->check(CLI::IsMember(puck::written_names()));
  puck::add_event_file_options(app, options.file);
  app.add_option("--prefix", options.prefix, "of the channels in an LCM log");
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
  app.add_option("--crop", crop, "x,y,width,height, px: becomes the whole picture")
      ->delimiter(',')
      ->expected(4);
  app.add_flag("--rotate-180", options.filter.rotate_180, "turn the picture upside down");
  app.add_flag("--start-at-zero", options.filter.start_at_zero,
               "count times from the first event that is written");
  app.add_option("--hot-pixel-mask", mask, "TOML of puck-calibrate hot-pixels");
  app.footer(puck::format_list());
  return puck::run_tool(app, argc, argv, "puck-convert", [&] {
    puck::parse_crop(crop, options.filter);
    if (!mask.empty()) options.filter.mask = puck::read_pixel_mask_file(mask);
    puck::convert(options);
    puck::flush_stdout();
    return 0;
  });
}
