#pragma once

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace puck {

/// Shell scripts in place of the real programs, to test a tool with their output or failure.
/// puck-simulate writes a game with its seed in the last line and its arguments as truth, and then
/// runs `simulate`; puck-calibrate writes an empty file. `evaluate` is the script of puck-evaluate:
/// the seed is in $seed, and its arguments are at their usual places.
inline std::filesystem::path programs_that(const TemporaryFolder& folder,
                                           const std::string& evaluate,
                                           const std::string& simulate = "") {
  namespace fs = std::filesystem;
  // Sets variables from --output and --seed.
  const std::string read_options =
      "#!/bin/sh\n"
      "for argument; do\n"
      "  case \"$before\" in --output) output=$argument ;; --seed) seed=$argument ;; esac\n"
      "  before=$argument\n"
      "done\n";
  const fs::path programs = folder / "programs";
  fs::create_directory(programs);
  const auto write = [&](const char* name, const std::string& script) {
    write_text(programs / name, script);
    fs::permissions(programs / name, fs::perms::owner_all);
  };
  write("puck-simulate",
        read_options +
            "printf '%% geometry 64x48\\n%% end\\n%s\\n' \"$seed\" >\"$output.raw\"\n"
            "echo \"$*\" >\"$output.truth.csv\"\n"
            "touch \"$output.annotations.csv\" \"$output.toml\"\n" +
            simulate);
  write("puck-calibrate", read_options + "touch \"$output\"\n");
  write("puck-evaluate", "#!/bin/sh\nseed=$(tail -n 1 \"$1\")\n" + evaluate);
  return programs;
}

}  // namespace puck
