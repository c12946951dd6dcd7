#include "services/camera/camera_operator.h"

#include <array>
#include <cmath>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/io/parse_number.h"
#include "services/camera/camera_request.h"
#include "services/camera/replay.h"
#include "services/camera/replay_request.h"

namespace puck {
namespace {

constexpr double kLongest_s = 1e9;
// By then every camera has been heard, unless its STATUS was lost.
constexpr std::int64_t kAtLeastUs = 100'000;

std::optional<CameraOperator::Place> parse_place(std::string_view text) {
  const bool is_relative = text.starts_with('+') || text.starts_with('-');
  if (text.starts_with('+')) text.remove_prefix(1);
  double seconds = 0;
  if (!parse_number(text, seconds) || !(std::abs(seconds) <= kLongest_s)) return std::nullopt;
  return CameraOperator::Place{std::llround(seconds * 1e6), is_relative};
}

// CLI::Range accepts "nan".
std::string check_speed(const std::string& text) {
  double speed = 0;
  const bool is_valid = parse_number(std::string_view(text), speed) &&
                        speed >= ReplayRequest::kSlowest && speed <= ReplayRequest::kFastest;
  return is_valid ? "" : "must be a number from 0.001 to 1000, got " + text;
}

}  // namespace

void CameraOperator::add_options(CLI::App& app) {
  const std::array<CLI::Option*, 5> requests{
      app.add_flag("--pause", pause_, "Pause the recording that a running puck-camera plays"),
      app.add_flag("--resume", resume_, "Play it on"),
      app.add_flag("--step", step_,
                   "Pause it, and play one packet on, or the time of camera.step_us"),
      app.add_option_function<std::string>(
             "--seek", [this](const std::string& text) { seek_ = parse_place(text); },
             "Go to this place, s since the recording's first event; +S and -S count from where it "
             "is")
          ->type_name("[+|-]S")
          ->check([](const std::string& text) -> std::string {
            return parse_place(text) ? "" : "must be seconds, such as 12.5, +10 or -1, got " + text;
          }),
      app.add_option("--speed", speed_, "Play it at this speed, sensor time per host time")
          ->type_name("X")
          ->check(check_speed),
  };
  for (CLI::Option* one : requests) {
    for (CLI::Option* other : requests) {
      if (one != other) one->excludes(other);
    }
  }
}

std::optional<int> CameraOperator::run(const BusParams& params, std::stop_token stop) const {
  CameraControl control;
  std::string goal;
  if (pause_) {
    control.mode = CameraControlMode::kPause;
    goal = "paused";
  } else if (resume_) {
    control.mode = CameraControlMode::kResume;
    goal = "playing";
  } else if (step_) {
    control.mode = CameraControlMode::kStep;
    goal = "a step on";
  } else if (seek_) {
    control.mode = CameraControlMode::kSeek;
    control.position_us = seek_->us;
    goal = std::string(seek_->is_relative ? "moved by " : "at ") + seconds_text(seek_->us);
  } else if (speed_) {
    control.mode = CameraControlMode::kSpeed;
    control.speed = *speed_;
    goal = fmt::format("at speed {:g}", *speed_);
  } else {
    return std::nullopt;
  }
  CameraRequest request(control, seek_ && seek_->is_relative, goal);
  return make_operator_request({.program = "puck-camera", .at_least_us = kAtLeastUs}, params,
                               request, std::move(stop));
}

}  // namespace puck
