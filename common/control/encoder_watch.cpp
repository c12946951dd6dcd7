#include "common/control/encoder_watch.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

// No joint turns that far. The bound keeps squares and differences per µs far from overflow.
constexpr double kMostTurnedDeg = 1e6;

}  // namespace

const char* EncoderWatch::look(const std::optional<JointReading>& reading) {
  if (!reading) return nullptr;
  const JointAngles& deg = reading->position;
  if (deg.size() != table_.size()) return "the number of encoders is not that of the joint table";
  const auto is_finite = [](double angle) { return std::isfinite(angle); };
  if (!std::all_of(deg.deg().begin(), deg.deg().end(), is_finite)) {
    return "an encoder's angle is not finite";
  }
  const auto can_be = [](double angle) { return std::abs(angle) <= kMostTurnedDeg; };
  if (!std::all_of(deg.deg().begin(), deg.deg().end(), can_be)) {
    return "the angle of an encoder is out of the possible range";
  }
  if (!newest_) {
    newest_ = reading;
    find_place();
    return nullptr;
  }
  if (reading->received_us <= newest_->received_us) return nullptr;
  const double dt_s = 1e-6 * static_cast<double>(reading->received_us - newest_->received_us);
  const LinePlace before = place_;
  place_ = table_.place_near(before.y_m, deg.deg());
  velocity_m_s_ = (place_.y_m - before.y_m) / dt_s;
  for (std::size_t k = 0; k < deg.size(); ++k) {
    velocity_deg_s_[k] = (deg[k] - newest_->position[k]) / dt_s;
  }
  newest_ = reading;
  return nullptr;
}

void EncoderWatch::find_place() {
  place_ = table_.place_of(newest_->position.deg());
  velocity_m_s_ = 0;
  velocity_deg_s_.fill(0);
}

}  // namespace puck
