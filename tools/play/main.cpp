#include <CLI/CLI.hpp>

#include "tools/command_line/run_tool.h"
#include "tools/play/options.h"
#include "tools/play/program.h"

int main(int argc, char** argv) {
  CLI::App app("Plays air hockey on the simulated table, in steps and as fast as it can.");
  puck::PlayOptions options;
  puck::add_options(app, options);
  return puck::run_tool(app, argc, argv, "puck-play", [&] {
    puck::run(options);
    return 0;
  });
}
