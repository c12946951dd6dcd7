#include "tools/convert/output_place.h"

#include <array>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

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

}  // namespace

OutputPlace::OutputPlace(std::filesystem::path final) : final_(std::move(final)), part_(final_) {
  std::error_code error;
  const auto status = std::filesystem::status(final_, error);
  const bool is_direct = final_ == "-" || (std::filesystem::exists(status) &&
                                           !std::filesystem::is_regular_file(status));
  if (is_direct) return;
  part_ += ".part" + std::to_string(getpid());
  const std::string name = part_.string();
  if (name.size() >= file_to_remove.size()) return;
  std::memcpy(file_to_remove.data(), name.c_str(), name.size() + 1);
  for (const int signal : kDeadlySignals) std::signal(signal, remove_and_die);
}

OutputPlace::~OutputPlace() {
  for (const int signal : kDeadlySignals) std::signal(signal, SIG_DFL);
  if (part_ == final_) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputPlace::keep() {
  if (part_ == final_) return;
  std::filesystem::rename(part_, final_);
  part_ = final_;
}

}  // namespace puck
