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
      "Looks into logs of LCM, of any size. Exit codes: 0 the log is fine, 1 something is wrong "
      "with it or with a file, 2 usage.",
      "puck-log");
  app.set_version_flag("--version", PUCK_VERSION);
  app.require_subcommand(1);
  std::filesystem::path log;
  std::filesystem::path output;
  bool as_json = false;
  ExportOptions exported;

  CLI::App* info = app.add_subcommand(
      "info", "What is in a log: channels, rates, gaps, sessions, losses, events");
  info->add_flag("--json", as_json, "For scripts");
  CLI::App* verify = app.add_subcommand(
      "verify", "Checks every message as a receiver does; says what is wrong, and at which byte");
  CLI::App* export_app = app.add_subcommand(
      "export", "CSV, a line a message: every channel into a folder, or one to stdout");
  export_app->add_option("--output", exported.folder,
                         "Folder for a CHANNEL.csv each; made if need be (default: game-csv beside "
                         "game.lcm)");
  export_app->add_option("--channel", exported.channel,
                         "Only this one, as PUCK_ESTIMATE; to stdout without --output");
  CLI::App* repair = app.add_subcommand(
      "repair",
      "Copies all whole messages into a new log and says what it left out, and where. "
      "Exit code 0 when the new log is fine");
  for (CLI::App* command : {info, verify, export_app, repair}) {
    command->add_option("log", log, "Log of LCM")->required();
  }
  repair->add_option("output", output, "The new log; must not exist")->required();
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
