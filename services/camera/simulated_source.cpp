#include "services/camera/simulated_source.h"

#include <utility>

namespace puck {

SimulatedSource::SimulatedSource(const SimulationParams& params, std::int64_t truth_period_us,
                                 OnTruth on_truth)
    : table_(params), truth_period_us_(truth_period_us), on_truth_(std::move(on_truth)) {}

EventSource::Outcome SimulatedSource::next(Chunk& chunk) {
  if (table_.now() >= next_truth_) {
    on_truth_(table_.truth());
    next_truth_ = next_truth_ + truth_period_us_;
  }
  chunk.packet.events.clear();
  table_.advance(chunk.packet);
  chunk.until = table_.now();
  return Outcome::kEvents;
}

}  // namespace puck
