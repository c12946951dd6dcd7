#include "tools/convert/output_place.h"

#include <array>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>

#include <unistd.h>

namespace puck {
namespace {

constexpr std::array kDeadlySignals{SIGINT, SIGTERM, SIGHUP};

// A signal handler reaches nothing but globals.
std::array<char, 4096> file_to_remove{};

void remove_and_die(int signal) {
  unlink(file_to_remove.data());
  std::signal(signal, SIG_DFL);
  raise(signal);
}

// Of a link, what it names is replaced, not the link.
std::filesystem::path place_of(const std::filesystem::path& named) {
  std::error_code error;
  if (!std::filesystem::is_symlink(named, error)) return named;
  const auto place = std::filesystem::weakly_canonical(named, error);
  return error ? named : place;
}

}  // namespace

OutputPlace::OutputPlace(const std::filesystem::path& final)
    : final_(place_of(final)), part_(final_) {
  std::error_code error;
  const auto status = std::filesystem::status(final_, error);
  const bool is_direct = final_ == "-" || (std::filesystem::exists(status) &&
                                           !std::filesystem::is_regular_file(status));
  if (is_direct) return;
  part_ += ".part" + std::to_string(getpid());
  const std::string name = part_.string();
  if (name.size() >= file_to_remove.size()) return;
  std::memcpy(file_to_remove.data(), name.c_str(), name.size() + 1);
  // A signal that is ignored, as under nohup, stays so.
  for (const int signal : kDeadlySignals) {
    if (std::signal(signal, remove_and_die) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

OutputPlace::~OutputPlace() {
  for (const int signal : kDeadlySignals) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  if (part_ == final_) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

std::string OutputPlace::with_final_name(std::string message) const {
  const std::string part = part_.string();
  return message.starts_with(part) ? final_.string() + message.substr(part.size()) : message;
}

void OutputPlace::keep() {
  if (part_ == final_) return;
  std::filesystem::rename(part_, final_);
  part_ = final_;
}

}  // namespace puck
