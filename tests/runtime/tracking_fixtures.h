#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "common/runtime/tracking_thread.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/paper/puck_search.h"

namespace puck::test {

// Small, so that a search of all of it is quick even under ThreadSanitizer.
inline constexpr SensorSize kSensor{160, 120};
inline constexpr PuckSizeModel kSizeModel{25, 0, 0, 17, 0, 0};

// Collects the tracking thread's estimates.
class Published {
 public:
  void add(const TrackedEstimate& estimate) {
    const std::lock_guard lock(mutex_);
    estimates_.push_back(estimate);
  }
  std::vector<TrackedEstimate> all() const {
    const std::lock_guard lock(mutex_);
    return estimates_;
  }
  std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return estimates_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<TrackedEstimate> estimates_;
};

inline std::unique_ptr<TrackingPipeline> default_pipeline() {
  return make_pipeline(kSensor, correlation_params(), kSizeModel);
}

inline PuckSearch default_search() { return PuckSearch(kSensor, correlation_params(), kSizeModel); }

}  // namespace puck::test
