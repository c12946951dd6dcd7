#include "tools/view/live/doctor_run.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/posix/file_descriptor.h"

namespace puck {
namespace {

constexpr std::int64_t kBetweenRuns_us = 20'000'000;
constexpr std::size_t kLongestReport = 1 << 20;
constexpr int kStopCheck_ms = 50;

std::string doctor_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).replace_filename(kDoctorProgram);
}

/// A program's output; nothing if it cannot be started or `stop` came first.
std::optional<std::string> output_of(std::vector<std::string> command,
                                     const std::stop_token& stop) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  FileDescriptor read_end(ends[0]);
  FileDescriptor write_end(ends[1]);
  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, write_end.number(), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return std::nullopt;
  write_end = FileDescriptor();

  std::string text;
  std::array<char, 4096> part{};
  while (!stop.stop_requested() && text.size() < kLongestReport) {
    pollfd waiting{read_end.number(), POLLIN, 0};
    if (poll(&waiting, 1, kStopCheck_ms) <= 0) continue;
    const ssize_t size = read(read_end.number(), part.data(), part.size());
    if (size <= 0) break;
    text.append(part.data(), static_cast<std::size_t>(size));
  }
  if (stop.stop_requested()) kill(child, SIGKILL);
  read_end = FileDescriptor();
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (stop.stop_requested()) return std::nullopt;
  return text;
}

/// Empty unless it is a text.
std::string text_in(const nlohmann::json& finding, const char* key) {
  const auto found = finding.find(key);
  return found != finding.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::vector<ViewMessage> doctor_messages(const std::string& report) {
  const auto json = nlohmann::json::parse(report, nullptr, false);
  if (!json.is_object() || !json.contains("findings") || !json["findings"].is_array()) {
    return {{ViewMessage::Level::kWarning,
             "puck-doctor gave no report; run it in a terminal on this machine"}};
  }
  std::vector<ViewMessage> messages;
  for (const auto& finding : json["findings"]) {
    if (!finding.is_object()) continue;
    const std::string verdict = text_in(finding, "verdict");
    if (verdict == "ok") continue;
    const bool is_wrong = verdict == "wrong";
    std::string text = text_in(finding, "check") + ": " + text_in(finding, "text");
    const std::string mend = text_in(finding, "mend");
    if (!mend.empty()) text += (is_wrong ? ". To mend it: " : ": ") + mend;
    messages.push_back(
        {is_wrong ? ViewMessage::Level::kError : ViewMessage::Level::kWarning, text});
  }
  if (messages.empty()) {
    messages.push_back({ViewMessage::Level::kWarning,
                        "puck-doctor finds nothing wrong with this machine's network: no service "
                        "publishes, or those on other machines do not reach this one"});
  }
  return messages;
}

void DoctorRun::ask(std::int64_t now_us) {
  const std::lock_guard lock(mutex_);
  if (is_running_ || (begun_us_ != 0 && now_us - begun_us_ < kBetweenRuns_us)) return;
  begun_us_ = now_us;
  is_running_ = true;
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

std::vector<ViewMessage> DoctorRun::answer() const {
  const std::lock_guard lock(mutex_);
  return answer_;
}

void DoctorRun::run(const std::stop_token& stop) {
  std::vector<std::string> command{doctor_program(), "--json", "--seconds", "1",
                                   "--lcm-url",      bus_.url, "--prefix",  bus_.prefix};
  if (!bus_.key_file.empty()) {
    command.insert(command.end(), {"--set", "lcm.key_file=" + bus_.key_file});
  }
  const auto report = output_of(std::move(command), stop);
  const std::lock_guard lock(mutex_);
  answer_ = doctor_messages(report.value_or(""));
  is_running_ = false;
}

}  // namespace puck
