#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace puck {

/// How a program ended.
struct ProgramEnd {
  int exit_code = -1;  ///< -1: a signal ended it, or it could not be started.
  double cpu_s = 0;    ///< Of all that it did.
};

/// Runs a program to its end; what it prints goes into the two files. Safe from any thread.
ProgramEnd run_program_to_end(const std::vector<std::string>& command,
                              const std::filesystem::path& output,
                              const std::filesystem::path& errors);

/// The same, at least quiet: throws std::runtime_error with the command and the end of what it said
/// when it fails. Both go into files of `folder`, output.txt and errors.txt. Returns its CPU time,
/// s.
double run_or_throw(const std::vector<std::string>& command, const std::filesystem::path& folder);

/// A whole file; empty where there is none.
std::string read_whole_file(const std::filesystem::path& path);

}  // namespace puck
