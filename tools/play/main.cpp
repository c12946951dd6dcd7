#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "tools/play/options.h"
#include "tools/play/program.h"

int main(int argc, char** argv) {
  CLI::App app("Plays air hockey on the simulated table, in steps and as fast as it can.");
  puck::PlayOptions options;
  puck::add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    puck::run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-play: %s\n", error.what());
    return 1;
  }
}
