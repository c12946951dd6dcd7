#include <cstdio>
#include <memory>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>

#include "tools/command_line/run_tool.h"
#include "tools/view/live/live_source.h"
#include "tools/view/output/picture_files.h"
#include "tools/view/recording/opened_recording.h"
#include "tools/view/recording/recording_source.h"
#include "tools/view/server/serve.h"
#include "tools/view/view_options.h"

namespace puck {
namespace {

int write_files(const ViewOptions& options) {
  if (options.recording.recording.empty()) {
    throw std::invalid_argument("--png and --video need a recording: name it first");
  }
  const OpenedRecording recording(recording_options(options));
  for (const ViewMessage& message : recording.messages()) {
    std::fprintf(stderr, "puck-view: %s\n", message.text.c_str());
  }
  const auto trackers = trackers_of(options, recording);
  const int written = write_pictures(recording, trackers, picture_files(options, trackers));
  std::printf("%d pictures\n", written);
  return 0;
}

int serve_page(const ViewOptions& options) {
  if (options.recording.recording.empty()) {
    LiveSource source(live_options(options));
    serve(source, options.listen);
    return 0;
  }
  auto recording = std::make_unique<OpenedRecording>(recording_options(options));
  const auto trackers = trackers_of(options, *recording);
  RecordingSource source(std::move(recording), trackers, true);
  serve(source, options.listen);
  return 0;
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  CLI::App app("Shows events, surface, track and game of a recording or of the live bus.");
  puck::ViewOptions options;
  puck::add_options(app, options);
  return puck::run_tool(app, argc, argv, "puck-view", [&] {
    return options.has_pictures() ? puck::write_files(options) : puck::serve_page(options);
  });
}
