#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

#include <doctest/doctest.h>

namespace puck {

/// The folder of real recordings by others: PUCK_RECORDINGS, else ../shared/recordings beside the
/// project. Nothing, with a message, where there is none.
inline std::optional<std::filesystem::path> recordings_folder() {
  const char* named = std::getenv("PUCK_RECORDINGS");
  const char* source = std::getenv("PUCK_SOURCE_DIR");
  const std::filesystem::path folder =
      named != nullptr ? std::filesystem::path(named)
                       : std::filesystem::path(source != nullptr ? source : ".") / ".." / "shared" /
                             "recordings";
  if (std::filesystem::exists(folder / "MANIFEST.md")) return folder;
  MESSAGE("skipped: no recordings in " << folder.string()
                                       << "; PUCK_RECORDINGS can tell where they are");
  return std::nullopt;
}

}  // namespace puck
