#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "tools/view/server/http_message.h"

namespace puck {

/// The page's files, read once, so that no request opens a file. Immutable; safe from any thread.
class PageFiles {
 public:
  /// All HTML, CSS, JavaScript and SVG files of the folder. Throws std::runtime_error without
  /// index.html.
  explicit PageFiles(const std::filesystem::path& folder);

  /// Null for an unknown path; `/` is index.html.
  const HttpReply* find(std::string_view path) const;

 private:
  std::map<std::string, HttpReply, std::less<>> files_;
};

/// Beside this program: share/puck/view, next to the folder that it is in.
std::filesystem::path page_folder();

}  // namespace puck
