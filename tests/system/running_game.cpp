#include "tests/system/running_game.h"

#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <utility>

#include "tests/support/status_counter.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHandle{2};
constexpr std::chrono::seconds kGenerous{40};

std::string faketime_library() {
  for (const auto& folder : std::filesystem::directory_iterator("/usr/lib")) {
    const std::filesystem::path library = folder.path() / "faketime" / "libfaketime.so.1";
    std::error_code error;
    if (std::filesystem::exists(library, error)) return library.string();
  }
  throw std::runtime_error("libfaketime is not installed; tools/install-deps.sh installs it");
}

}  // namespace

RunningGame::RunningGame(const std::string& url) : url_(url), bus_({.url = url}) {
  bus_.subscribe<service_status_t>([this](const service_status_t& status, const Receipt& at) {
    if (is_of_now(status.utime, at)) statuses_[status.service] = status;
  });
  bus_.subscribe<puck_estimate_t>([this](const puck_estimate_t& estimate, const Receipt& at) {
    if (!is_of_now(estimate.utime, at)) return;
    estimate_ = estimate;
    if (estimate.state == puck_estimate_t::STATE_TRACKING) ++tracked_;
  });
  bus_.subscribe<arm_state_t>([this](const arm_state_t& state, const Receipt& at) {
    if (!is_of_now(state.utime, at)) return;
    arm_ = state;
    lowest_m_ = std::min(lowest_m_.value_or(state.position_m), state.position_m);
    highest_m_ = std::max(highest_m_.value_or(state.position_m), state.position_m);
  });
  std::stop_source give_up;
  if (!bus_.start(give_up.get_token(), [&](const std::string&) { give_up.request_stop(); })) {
    throw std::runtime_error("no multicast route on this machine");
  }
}

// A log player's copies are not messages of the services.
bool RunningGame::is_of_now(std::int64_t utime, const Receipt& at) const {
  constexpr std::int64_t kLogIsOlderUs = 1'000'000;
  return !clocks_.empty() || utime > at.utime - kLogIsOlderUs;
}

std::vector<std::string> RunningGame::with_clock(const std::string& offset,
                                                 std::vector<std::string> command) {
  command.insert(command.begin(), {"env", "LD_PRELOAD=" + faketime_library(), "FAKETIME=" + offset,
                                   "DONT_FAKE_MONOTONIC=1", "FAKETIME_DONT_FAKE_MONOTONIC=1"});
  return command;
}

void RunningGame::start(const std::string& name, std::vector<std::string> settings) {
  if (name == "puck-logger") {
    ++logs_;
    settings.push_back("logger.path=" + log_path().string());
  }
  std::vector<std::string> command = service_command(name, url_, settings);
  command.insert(command.end(), {"--log-level", "error"});
  if (const auto clock = clocks_.find(name); clock != clocks_.end()) {
    command = with_clock(clock->second, std::move(command));
  }
  processes_[name] =
      std::make_unique<ChildProcess>(command, ChildOptions{.folder = source_folder()});
}

void RunningGame::start_all() {
  for (const char* name : {"puck-logger", "puck-tracker", "puck-bridge", "puck-arm"}) start(name);
  until([&] { return statuses_.size() == 4; });
  start("puck-camera");
}

void RunningGame::kill(const std::string& name) {
  process(name).send(SIGKILL);
  process(name).wait();
}

bool RunningGame::until(const std::function<bool()>& condition) {
  return poll_until(
      condition, [&] { bus_.handle(kHandle); }, kGenerous);
}

void RunningGame::listen(milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) bus_.handle(kHandle);
}

bool RunningGame::plays() {
  return arm_ && estimate_ && arm_->session == session("puck-arm") &&
         arm_->command_session == session("puck-bridge") && arm_->command_session != 0 &&
         arm_->estimate_session == session("puck-tracker") &&
         estimate_->session == session("puck-tracker") &&
         estimate_->events_session == session("puck-camera");
}

std::int64_t RunningGame::session(const std::string& name) const {
  const auto found = statuses_.find(name);
  return found == statuses_.end() ? 0 : found->second.session;
}

std::string RunningGame::state_text(const std::string& name) const {
  const auto found = statuses_.find(name);
  return found == statuses_.end() ? "" : found->second.state_text;
}

bool RunningGame::is_stopping(const std::string& name) const {
  const auto found = statuses_.find(name);
  return found != statuses_.end() && found->second.state == service_status_t::STATE_STOPPING;
}

std::int64_t RunningGame::counter(const std::string& name, const std::string& counter) const {
  const auto found = statuses_.find(name);
  if (found == statuses_.end()) return -1;
  return test::counter(found->second, counter).value_or(-1);
}

std::string RunningGame::name_and_place(const std::string& name) const {
  const service_status_t& status = statuses_.at(name);
  return status.service + " on " + status.host + ", pid " + std::to_string(status.pid);
}

double RunningGame::take_arm_span_m() {
  const double span_m = lowest_m_ ? *highest_m_ - *lowest_m_ : 0;
  lowest_m_.reset();
  highest_m_.reset();
  return span_m;
}

std::filesystem::path RunningGame::log_path() const {
  return folder_ / ("game" + std::to_string(logs_) + ".lcm");
}

}  // namespace puck
