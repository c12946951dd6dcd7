#include "tools/view/server/page_files.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace puck {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::string> kTypes{{".html", "text/html; charset=utf-8"},
                                                {".css", "text/css; charset=utf-8"},
                                                {".js", "text/javascript; charset=utf-8"},
                                                {".svg", "image/svg+xml"}};

std::string read_page_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

PageFiles::PageFiles(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto type = kTypes.find(entry.path().extension());
    if (type == kTypes.end() || !entry.is_regular_file(error)) continue;
    HttpReply reply{.content_type = type->second,
                    .body = std::make_shared<const std::string>(read_page_file(entry.path()))};
    // The files belong to this program's version.
    reply.headers.emplace_back("Cache-Control", "no-cache");
    files_.emplace('/' + entry.path().filename().string(), std::move(reply));
  }
  const auto index = files_.find("/index.html");
  if (index == files_.end() || index->second.body->empty()) {
    throw std::runtime_error("the page's files are missing: expected index.html in " +
                             folder.string() +
                             "; build the target puck-view again, or install share/puck/view");
  }
  files_.emplace("/", index->second);
}

const HttpReply* PageFiles::find(std::string_view path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

fs::path page_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "puck" / "view";
}

}  // namespace puck
