#include "tools/calibrate/evidence_packets.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/calibration/median.h"
#include "common/evaluation/truth_track.h"
#include "common/io/contour_calibration_file.h"
#include "common/io/size_model_file.h"
#include "common/io/truth_file.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"

namespace puck {
namespace {

enum class Label : std::uint8_t { kPuck, kOther, kUnknown };

// On the puck: so near that the difference does not matter. Another thing: so far that the contour
// has little in common with the puck's.
Label label_of(const Hypothesis& hypothesis, const TruthRow& truth) {
  const double distance = distance_px(hypothesis.filter().position(), truth.centre);
  if (distance > 0.35 * hypothesis.width_px() + 2) return Label::kOther;
  const bool is_near = distance < 0.1 * hypothesis.width_px() + 1;
  return is_near && is_visible(truth) ? Label::kPuck : Label::kUnknown;
}

// Labels packets as they come.
class Collector {
 public:
  Collector(const EvidenceSource& source, TruthTrack truth)
      : source_(source), truth_(std::move(truth)) {}

  void add(const Hypothesis& hypothesis, const GameTraits& game) {
    const std::optional<TruthRow> truth =
        truth_.at({hypothesis.decided_us()}, source_.truth_gap_us);
    const Label label = truth ? label_of(hypothesis, *truth) : Label::kUnknown;
    if (label == Label::kUnknown || (label == Label::kOther && source_.has_lookalikes)) {
      ++result_.left_out;
      return;
    }
    const LabelledPacket packet{hypothesis.packet(), hypothesis.areas(),
                                hypothesis.expected_density(), game, label == Label::kPuck};
    if (!packet.is_puck) {
      result_.packets.push_back(packet);
      return;
    }
    OnPuck& on_puck = pucks_[hypothesis.wall_share()];
    on_puck.packets.push_back(packet);
    on_puck.distances_px.push_back(distance_px(hypothesis.filter().position(), truth->centre));
  }

  EvidencePackets take_result() {
    const auto best = std::min_element(pucks_.begin(), pucks_.end(), [&](auto& a, auto& b) {
      return std::pair(is_rare(a.second), median(a.second.distances_px)) <
             std::pair(is_rare(b.second), median(b.second.distances_px));
    });
    if (best == pucks_.end()) {
      throw std::invalid_argument(
          "no events are of the puck at its true positions: check that the truth belongs to this "
          "recording and the size model to this camera");
    }
    for (const auto& [wall_share, on_puck] : pucks_) {
      if (wall_share != best->first) result_.wrong_wall += on_puck.packets.size();
    }
    const std::vector<LabelledPacket>& good = best->second.packets;
    result_.packets.insert(result_.packets.end(), good.begin(), good.end());
    return std::move(result_);
  }

 private:
  // With one assumption about the side wall.
  struct OnPuck {
    std::vector<LabelledPacket> packets;
    std::vector<double> distances_px;  // from the truth
  };

  // Positions of a few packets tell little.
  bool is_rare(const OnPuck& on_puck) const {
    constexpr std::size_t kShare = 10;
    return std::any_of(pucks_.begin(), pucks_.end(), [&](const auto& other) {
      return kShare * on_puck.packets.size() < other.second.packets.size();
    });
  }

  const EvidenceSource& source_;
  TruthTrack truth_;
  std::map<double, OnPuck> pucks_;  // by wall share, of which one fits the truth best
  EvidencePackets result_;
};

}  // namespace

EvidencePackets collect_evidence(const EvidenceSource& source, EventFileOptions file) {
  check_recording_exists(source.recording);
  const PuckSizeModel size_model = read_size_model_file(source.size_model);
  file.fallback_sensor = size_model.sensor;
  HypothesesParams params = default_params();
  params.contour = read_contour_calibration(source.size_model).value_or(ContourCalibration{});
  Collector collector(source, TruthTrack(read_truth_file(source.truth)));
  const auto events = open_event_file(source.recording, file);
  const SensorSize sensor = events->sensor_size();
  const PuckSizeModel sizes = params.sizes_of(size_model);
  for (const std::string& doubt : doubts_about(sizes, sensor)) {
    std::fprintf(stderr, "puck-calibrate: %s: %s\n", source.size_model.c_str(), doubt.c_str());
  }
  params.on_packet = [&](const Hypothesis& hypothesis, const GameTraits& game) {
    collector.add(hypothesis, game);
  };
  SurfaceTracker tracker(sensor, params, size_model);
  EventPacket packet;
  while (events->read(packet, EventReader::kUsualEvents)) tracker.update(packet);
  return collector.take_result();
}

}  // namespace puck
