#include "tools/compare/result_store.h"

#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tools/compare/content_hash.h"
#include "tools/compare/program.h"

namespace puck {
namespace {

constexpr const char* kUnfinished = ".unfinished";
constexpr const char* kKeyFile = "key.txt";
constexpr std::size_t kHashDigits = 16;

}  // namespace

ResultStore::ResultStore(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::filesystem::create_directories(folder_);
  std::vector<std::filesystem::path> unfinished;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() == kUnfinished) unfinished.push_back(entry.path());
  }
  for (const auto& path : unfinished) std::filesystem::remove_all(path);
}

std::filesystem::path ResultStore::path_of(const std::string& name, const std::string& key) const {
  return folder_ / (name + "-" + ContentHash().add(key).text());
}

std::optional<std::filesystem::path> ResultStore::find(const std::string& name,
                                                       const std::string& key) const {
  const std::filesystem::path path = path_of(name, key);
  // Two keys may have the same short hash: compare the key itself.
  if (!std::filesystem::exists(path) || read_whole_file(path / kKeyFile) != key) {
    return std::nullopt;
  }
  return path;
}

std::filesystem::path ResultStore::make(
    const std::string& name, const std::string& key,
    const std::function<void(const std::filesystem::path&)>& fill) {
  const std::filesystem::path path = path_of(name, key);
  std::filesystem::path unfinished = path;
  unfinished += kUnfinished;
  std::filesystem::remove_all(unfinished);
  std::filesystem::create_directory(unfinished);
  fill(unfinished);
  std::ofstream(unfinished / kKeyFile, std::ios::binary) << key;

  std::vector<std::filesystem::path> outdated;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string other = entry.path().filename();
    if (other.size() == name.size() + 1 + kHashDigits && other.starts_with(name + "-")) {
      outdated.push_back(entry.path());
    }
  }
  for (const auto& old : outdated) std::filesystem::remove_all(old);
  std::filesystem::rename(unfinished, path);
  return path;
}

void ResultStore::remove(const std::string& name, const std::string& key) {
  std::filesystem::remove_all(path_of(name, key));
}

}  // namespace puck
