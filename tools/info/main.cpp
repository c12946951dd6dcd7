#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "common/recording/recording.h"
#include "tools/command_line/event_file_options.h"
#include "tools/command_line/flush_stdout.h"
#include "tools/command_line/log_prefix_option.h"
#include "tools/command_line/run_tool.h"
#include "tools/info/plots.h"
#include "tools/info/report.h"
#include "tools/info/survey.h"

namespace puck {
namespace {

struct InfoOptions {
  std::filesystem::path file;
  std::filesystem::path plots;
  std::string prefix;
  bool as_json = false;
  EventFileOptions event_file;
};

// False when something is wrong with the file.
bool tell(const InfoOptions& options) {
  const auto events = open_recording(options.file, options.event_file, options.prefix);
  const bool is_stream = options.file == "-";
  Survey survey = survey_recording(*events, is_stream ? "stdin" : options.file.string());
  std::error_code error;
  const auto bytes = std::filesystem::file_size(options.file, error);
  if (!is_stream && !error) survey.bytes = static_cast<std::int64_t>(bytes);
  const std::string text = options.as_json ? survey_json(survey, false) : survey_text(survey);
  std::fwrite(text.data(), 1, text.size(), stdout);
  flush_stdout();
  if (!options.plots.empty()) draw_survey(survey, options.plots);
  return survey.problems.empty();
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  CLI::App app("Says what is in a recording of events; exit 1 when something is wrong with it.");
  puck::InfoOptions options;
  app.add_option("FILE", options.file, "recording of any format; - is stdin")->required();
  app.add_flag("--json", options.as_json, "one JSON object on stdout");
  app.add_option("--plots", options.plots,
                 "folder for rate.png and pixels.png; needs python3-matplotlib");
  puck::add_log_prefix_option(app, options.prefix);
  puck::add_event_file_options(app, options.event_file);
  return puck::run_tool(app, argc, argv, "puck-info", [&] { return puck::tell(options) ? 0 : 1; });
}
