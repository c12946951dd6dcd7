#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace puck {

/// How a program ended.
struct ProgramEnd {
  int exit_code = -1;  ///< -1: ended by a signal, or not started.
  double cpu_s = 0;    ///< Of the program and its children.
};

/// Runs a program to its end, with stdout and stderr in the two files. Safe from any thread.
ProgramEnd run_program_to_end(const std::vector<std::string>& command,
                              const std::filesystem::path& output,
                              const std::filesystem::path& errors);

/// The same with output.txt and errors.txt in `folder`; returns the CPU time, s. Throws
/// std::runtime_error with the command and the end of its output when it fails.
double run_or_throw(const std::vector<std::string>& command, const std::filesystem::path& folder);

/// Reads a whole file; empty if it does not exist.
std::string read_whole_file(const std::filesystem::path& path);

}  // namespace puck
