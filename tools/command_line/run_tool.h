#pragma once

#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

namespace puck {

/// The rest of a program's main() after its options are added: parses the command line, then calls
/// `run`, which returns the exit code. A usage error is printed and ends with 2; an exception of
/// `run` is printed after `name` and ends with 1.
template <typename Run>
int run_tool(CLI::App& app, int argc, char** argv, const char* name, Run run) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace puck
