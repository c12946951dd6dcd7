#pragma once

#include <cstdint>

namespace puck {

/// What became of a request to a camera. Its number is in STATUS, for the program that sent it.
enum class ControlVerdict : std::uint8_t {
  kObeyed,
  kSearching,     ///< The place is searched for; the verdict will follow.
  kNoRecording,   ///< The source is not a file or a log.
  kReadOnlyOnce,  ///< The recording comes from a pipe, and the place is behind.
  kBeyondEnd,     ///< The recording, or the played part of it, ends before the place.
  kNotBegun,      ///< No event has been read yet.
  kInvalid,       ///< A value is out of its range.
  kUnreadable,    ///< The recording's file cannot be read again.
  kReplaced,      ///< Another request came before the place was found.
};
inline constexpr std::int64_t kControlVerdicts = 9;

/// Counters of STATUS that answer a request: its sender's session, and the number of the verdict.
inline constexpr const char* kControlSession = "control_session";
inline constexpr const char* kControlVerdict = "control_verdict";
/// Counter of STATUS: where the recording is, µs since its first event.
inline constexpr const char* kPositionUs = "position_us";

/// The reason of a refusal, for people.
constexpr const char* to_string(ControlVerdict verdict) {
  switch (verdict) {
    case ControlVerdict::kObeyed:
      return "obeyed";
    case ControlVerdict::kSearching:
      return "the place is searched for";
    case ControlVerdict::kNoRecording:
      return "only a recording can be controlled: camera.source \"file\" or \"log\", at the pace "
             "of its sensor; this camera may be live";
    case ControlVerdict::kReadOnlyOnce:
      return "the recording comes from a pipe and cannot go back; play it from a file";
    case ControlVerdict::kBeyondEnd:
      return "the recording, or the part that is played, ends before that place";
    case ControlVerdict::kNotBegun:
      return "the recording has not begun yet; try again";
    case ControlVerdict::kInvalid:
      return "the speed must be 0.001 to 1000, a step at most 10 s";
    case ControlVerdict::kUnreadable:
      return "the recording cannot be read again; the camera's log says why";
    case ControlVerdict::kReplaced:
      return "somebody asked for another place before this one was found";
  }
  return "unknown";
}

}  // namespace puck
