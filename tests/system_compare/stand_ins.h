#pragma once

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace puck {

/// Shell scripts in the place of the real programs, to see what a tool makes of what they say or of
/// their failure. puck-simulate writes a game whose last line is its seed and whose truth is what
/// it was asked for, and then does `simulate`; puck-calibrate writes an empty file. `evaluate` is
/// what puck-evaluate does: it finds the seed in $seed, and its own arguments where a program finds
/// them.
inline std::filesystem::path programs_that(const TemporaryFolder& folder,
                                           const std::string& evaluate,
                                           const std::string& simulate = "") {
  namespace fs = std::filesystem;
  // Puts what --output and --seed say into variables of those names.
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
