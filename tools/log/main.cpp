#include <cstdio>
#include <exception>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "tools/command_line/flush_stdout.h"
#include "tools/log/export_command.h"
#include "tools/log/info_command.h"
#include "tools/log/repair_command.h"
#include "tools/log/verify_command.h"

namespace puck {
namespace {

int run(int argc, char** argv) {
  CLI::App app(
      "Examines, exports and repairs LCM logs of any size. Exit code 0: the log is valid, 1: "
      "the log is damaged or a file cannot be used, 2: usage.",
      "puck-log");
  app.set_version_flag("--version", PUCK_VERSION);
  app.require_subcommand(1);
  std::filesystem::path log;
  std::filesystem::path output;
  bool as_json = false;
  ExportOptions exported;

  CLI::App* info = app.add_subcommand(
      "info", "Lists the channels of a log: rates, gaps, sessions, losses, events");
  info->add_flag("--json", as_json, "Print JSON for scripts");
  CLI::App* verify =
      app.add_subcommand("verify",
                         "Checks every message as a receiver does; names each defect and its byte "
                         "position");
  CLI::App* export_app = app.add_subcommand(
      "export", "Writes CSV, one line a message: all channels into a folder, or one to stdout");
  export_app->add_option("--output", exported.folder,
                         "Folder for CHANNEL.csv files, created if missing (default: game-csv "
                         "beside game.lcm)");
  export_app->add_option("--channel", exported.channel,
                         "Export this channel only, for example PUCK_ESTIMATE; to stdout "
                         "without --output");
  CLI::App* repair = app.add_subcommand(
      "repair",
      "Copies all whole messages into a new log and lists what it left out, with byte "
      "positions. Exit code 0: the new log is valid");
  for (CLI::App* command : {info, verify, export_app, repair}) {
    command->add_option("log", log, "LCM log")->required();
  }
  repair->add_option("output", output, "The new log; the file must not exist yet")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (repair->parsed()) {
      repair_log(log, output);
      return 0;
    }
    if (exported.folder.empty() && exported.channel.empty()) {
      exported.folder = log.parent_path() / (log.stem().string() + "-csv");
    }
    const LogTally tally = info->parsed()     ? print_log_info(log, as_json)
                           : verify->parsed() ? verify_log(log)
                                              : export_log(log, exported);
    flush_stdout();
    return tally.is_fine() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-log: %s\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) { return puck::run(argc, argv); }
