#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

const char* to_string(TrackState state) {
  switch (state) {
    case TrackState::kSearching:
      return "searching";
    case TrackState::kTracking:
      return "tracking";
    case TrackState::kLost:
      return "lost";
  }
  return "unknown";
}

}  // namespace puck
