#include "services/logger/log_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace puck {
namespace {

constexpr std::size_t kDigits = 6;
// Enough for ten million files. More digits are not ours: log.20261121.lcm is a user's name.
constexpr std::size_t kMostDigits = 7;

/// A file's name, split into number and rest.
struct Numbered {
  std::string name;  ///< Name without rotation.
  int number = 0;
};

std::optional<Numbered> split(const std::string& file_name, const std::string& ending) {
  if (!file_name.ends_with(ending)) return std::nullopt;
  const std::string rest = file_name.substr(0, file_name.size() - ending.size());
  const std::size_t dot = rest.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  const char* const begin = rest.data() + dot + 1;
  const char* const end = rest.data() + rest.size();
  const auto digits = static_cast<std::size_t>(end - begin);
  if (digits < kDigits || digits > kMostDigits || *begin == '-') return std::nullopt;
  if (digits > kDigits && *begin == '0') return std::nullopt;
  Numbered numbered{rest.substr(0, dot) + ending, 0};
  const auto read = std::from_chars(begin, end, numbered.number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return numbered;
}

std::string file_part(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

std::string expand_log_path(const std::string& pattern, std::time_t time) {
  std::tm local{};
  localtime_r(&time, &local);
  std::array<char, 4096> path{};
  const std::size_t length = std::strftime(path.data(), path.size(), pattern.c_str(), &local);
  if (length == 0) throw std::invalid_argument("logger.path must be 1 to 4095 bytes long");
  return {path.data(), length};
}

LogNames::LogNames(std::string pattern, const std::filesystem::path& path)
    : pattern_(file_part(pattern)),
      folder_(path.has_parent_path() ? path.parent_path() : "."),
      stem_(path.stem()),
      ending_(path.extension()) {}

std::filesystem::path LogNames::at(int number) const {
  std::string digits = std::to_string(number);
  if (digits.size() < kDigits) digits.insert(0, kDigits - digits.size(), '0');
  return folder_ / (stem_ + "." + digits + ending_);
}

int LogNames::first_free() const {
  int free = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto numbered = split(entry->path().filename(), ending_);
    if (numbered && numbered->name == stem_ + ending_) {
      free = std::max(free, numbered->number + 1);
    }
  }
  return free;
}

// The name must be exactly that of the pattern for the time that it contains: a merely similar file
// belongs to someone else.
bool LogNames::is_ours(const std::string& file_name) const {
  const auto numbered = split(file_name, ending_);
  if (!numbered) return false;
  if (numbered->name == stem_ + ending_) return true;
  std::tm time{};
  const char* const end = strptime(numbered->name.c_str(), pattern_.c_str(), &time);
  if (end == nullptr || *end != '\0') return false;
  std::array<char, 4096> again{};
  const std::size_t length = std::strftime(again.data(), again.size(), pattern_.c_str(), &time);
  return std::string_view(again.data(), length) == numbered->name;
}

}  // namespace puck
