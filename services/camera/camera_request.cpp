#include "services/camera/camera_request.h"

#include <algorithm>
#include <cstddef>

#include "common/messages/host_time.h"
#include "common/messaging/conversions.h"

namespace puck {
namespace {

// STATUS comes every 100 ms.
constexpr std::int64_t kSilentUs = 400'000;
constexpr std::int64_t kMaxAgeUs = 200'000;
// A camera refuses a sender whose clock it does not know: one whose STATUS has not answered its
// own. That takes up to 20 ms, and the camera may be busy for 10 ms.
constexpr std::int64_t kIntroductionUs = 50'000;
// More come from a sender that makes them up.
constexpr std::size_t kMostCameras = 64;
constexpr std::int64_t kFarthestUs = 1'000'000'000'000'000;

// A camera's own state stands behind the troubles.
std::string without_troubles(const std::string& text) {
  const std::size_t end = text.rfind("; ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

void CameraRequest::listen(Bus& bus, StatusReporter& status) {
  own_session_ = bus.session();
  status.listen([this, &status](const PeerStatus& heard, const Receipt& receipt) {
    if (heard.service != "puck-camera") return;
    const HostNow now{receipt.utime, receipt.monotonic_us};
    const SenderClock clock = status.clock_of(heard.session);
    hear(heard, now, freshness_of(heard.utime, now, clock, kMaxAgeUs) == Freshness::kOfNow);
  });
}

void CameraRequest::hear(const PeerStatus& status, const HostNow& now, bool is_current) {
  const std::string name = status.host + ", pid " + std::to_string(status.pid);
  const bool answers = status.counter(kControlSession) == own_session_;
  // No log can name our session, whatever the clocks. Another old STATUS may be from a log of the
  // same camera.
  if (!is_current && !answers) return;
  if (cameras_.size() >= kMostCameras && !cameras_.contains(name)) return;
  Camera& camera = cameras_[name];
  if (camera.name.empty()) camera.first_heard_us = now.monotonic_us;
  camera.name = name;
  if (const std::string state = without_troubles(status.state_text); !state.empty()) {
    camera.state = state;
  }
  camera.session = status.session;
  camera.heard_us = now.monotonic_us;
  const auto position_us = status.counter(kPositionUs);
  if (!position_us) {  // It need not be asked.
    camera.has_answered = true;
    camera.verdict = ControlVerdict::kNoRecording;
    return;
  }
  camera.position_us = std::clamp<std::int64_t>(*position_us, 0, kFarthestUs);
  if (!answers) return;
  const std::int64_t verdict = status.counter(kControlVerdict).value_or(-1);
  if (verdict < 0 || verdict >= kControlVerdicts) return;
  camera.has_answered = true;
  camera.verdict = static_cast<ControlVerdict>(verdict);
}

bool CameraRequest::speaks(const Camera& camera, const HostNow& now) {
  return now.monotonic_us - camera.heard_us <= kSilentUs;
}

bool CameraRequest::publish(Bus& bus) {
  const HostNow now = host_now();
  bool has_any = false;
  for (auto& [name, camera] : cameras_) {
    if (!speaks(camera, now)) continue;
    if (now.monotonic_us - camera.first_heard_us < kIntroductionUs) continue;
    has_any = true;
    // During a search the answer to another sender may hide the one to this.
    if (camera.has_answered && camera.verdict != ControlVerdict::kSearching) continue;
    if (camera.target_us < 0) {
      const std::int64_t from_us = is_relative_ ? camera.position_us : 0;
      camera.target_us = std::max<std::int64_t>(0, from_us + control_.position_us);
    }
    CameraControl control = control_;
    control.camera_session = camera.session;
    control.position_us = camera.target_us;
    bus.publish(control);
  }
  return has_any;
}

std::string CameraRequest::why_not() const {
  const HostNow now = host_now();
  bool has_any = false;
  for (const auto& [name, camera] : cameras_) {
    if (!speaks(camera, now)) continue;
    has_any = true;
    if (!camera.has_answered) return "the camera on " + name + " does not answer" + but_obeyed();
    if (camera.verdict == ControlVerdict::kSearching) return "the camera on " + name + " searches";
  }
  return has_any ? "" : "no puck-camera is heard";
}

std::string CameraRequest::refusal() const {
  const HostNow now = host_now();
  bool is_any_left = false;
  for (const auto& [name, camera] : cameras_) {
    if (!camera.has_answered) {
      is_any_left = is_any_left || speaks(camera, now);
    } else if (camera.verdict == ControlVerdict::kObeyed ||
               camera.verdict == ControlVerdict::kSearching) {
      is_any_left = true;
    } else if (camera.verdict != ControlVerdict::kNoRecording) {
      return to_string(camera.verdict) + (" (" + name + ")") + but_obeyed();
    }
  }
  const std::string others = list(ControlVerdict::kNoRecording);
  if (is_any_left || others.empty()) return {};
  return "no camera on this bus plays a recording: camera.source is not \"file\" or \"log\", or "
         "camera.pace is \"arrival\" (" +
         others + ")";
}

bool CameraRequest::is_in_progress() const {
  const HostNow now = host_now();
  return std::any_of(cameras_.begin(), cameras_.end(), [&](const auto& entry) {
    const Camera& camera = entry.second;
    return speaks(camera, now) && camera.is(ControlVerdict::kSearching);
  });
}

std::string CameraRequest::result() const { return list(ControlVerdict::kObeyed); }

std::string CameraRequest::but_obeyed() const {
  const std::string obeyed = list(ControlVerdict::kObeyed);
  return obeyed.empty() ? "" : "; but obeyed: " + obeyed;
}

// The cameras that gave this answer; those that obeyed with their states.
std::string CameraRequest::list(ControlVerdict verdict) const {
  std::string text;
  for (const auto& [name, camera] : cameras_) {
    if (!camera.is(verdict)) continue;
    if (!text.empty()) text += "; ";
    text += verdict == ControlVerdict::kObeyed ? camera.state + " (" + name + ")" : name;
  }
  return text;
}

}  // namespace puck
