#pragma once

#include <filesystem>
#include <string_view>

namespace puck {

/// Writes a file of this content. Throws std::runtime_error, which names the file and the reason.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace puck
