#pragma once

#include <filesystem>
#include <string_view>

#include "common/vision/hypotheses/evidence.h"

namespace puck {

/// Reads the table [evidence] with a key for each of kEvidenceNumbers, all required. Ignores other
/// tables. Throws ConfigError when the file is missing or not TOML, or a key is missing, unknown,
/// not a number or out of range.
EvidenceParams read_evidence_file(const std::filesystem::path& path);

/// Writes a file that `read_evidence_file` reads, with the same bits. `provenance`: where the
/// numbers come from; becomes a comment. Throws ConfigError when it cannot be written.
void write_evidence_file(const std::filesystem::path& path, const EvidenceParams& params,
                         std::string_view provenance);

}  // namespace puck
