// Cost of surface and tracking together at a rate of events, in one thread: the pipeline as
// offline, with as many estimates a second as a tracker publishes.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/io/contour_calibration_file.h"
#include "common/io/size_model_file.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "tests/bench/bench_streams.h"

namespace puck {
namespace {

// The default of tracker.max_publish_hz.
constexpr int kEstimatesHz = 5000;
constexpr int kEstimatesAnIteration = 50;
constexpr std::size_t kMaxPackets = 20'000;
// Until the puck is found; not measured.
constexpr std::size_t kWarmUpEvents = 200'000;
constexpr std::size_t kWarmUpPacket = 1'000;

std::vector<EventPacket> cut(Timestamp start, std::span<const Event> events, std::size_t size) {
  std::vector<EventPacket> packets;
  for (; events.size() >= size && packets.size() < kMaxPackets; events = events.subspan(size)) {
    packets.push_back(
        {start, {events.begin(), events.begin() + static_cast<std::ptrdiff_t>(size)}});
  }
  return packets;
}

class Load {
 public:
  Load(Preset preset, int kev_s) : params_(preset_params(preset)) {
    const auto calibration =
        std::filesystem::path(PUCK_SOURCE_DIR) / "config/calibration/simulated_size.toml";
    size_model_ = read_size_model_file(calibration);
    if (const auto contour = read_contour_calibration(calibration)) {
      params_.contour = *contour;
    }
    const BenchEvents scene = load(BenchStream::kScene);
    sensor_ = scene.sensor;
    const std::span events(scene.packet.events);
    warm_up_ = cut(scene.packet.start, events.first(kWarmUpEvents), kWarmUpPacket);
    packets_ = cut(scene.packet.start, events.subspan(kWarmUpEvents),
                   static_cast<std::size_t>(kev_s) * 1000 / kEstimatesHz);
    restart();
  }

  bool is_at_end() const { return next_ == packets_.size(); }

  void restart() {
    tracker_ = std::make_unique<SurfaceTracker>(sensor_, params_, size_model_);
    for (const EventPacket& packet : warm_up_) {
      tracker_->update(packet);
      tracker_->estimate();
    }
    next_ = 0;
  }

  PuckEstimate step() {
    tracker_->update(packets_[next_++]);
    return tracker_->estimate();
  }

 private:
  PipelineParams params_;
  PuckSizeModel size_model_;
  SensorSize sensor_;
  std::vector<EventPacket> warm_up_;
  std::vector<EventPacket> packets_;
  std::unique_ptr<SurfaceTracker> tracker_;
  std::size_t next_ = 0;
};

void measure(benchmark::State& state, Preset preset, int kev_s) {
  Load load(preset, kev_s);
  std::int64_t tracked = 0;
  for (auto _ : state) {
    for (int i = 0; i < kEstimatesAnIteration; ++i) {
      if (load.is_at_end()) {
        state.PauseTiming();
        load.restart();
        state.ResumeTiming();
      }
      tracked += load.step().state == TrackState::kTracking;
    }
  }
  const auto estimates = state.iterations() * kEstimatesAnIteration;
  state.counters["steps"] = kEstimatesAnIteration;
  // CPU time over the time that the events would take at this rate.
  const auto lasts_s = static_cast<double>(estimates) / kEstimatesHz;
  state.counters["core_percent"] =
      benchmark::Counter(lasts_s / 100, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["tracked_percent"] =
      100 * static_cast<double>(tracked) / static_cast<double>(estimates);
}

[[maybe_unused]] const bool registered = [] {
  for (const int kev_s : {100, 300, 1'000, 3'000, 10'000, 20'000}) {
    for (const Preset preset : {Preset::kDefault, Preset::kCorrelation}) {
      const std::string name =
          std::string("load_") + to_string(preset) + "_" + std::to_string(kev_s) + "kev/ours";
      benchmark::RegisterBenchmark(name.c_str(), measure, preset, kev_s);
    }
  }
  return true;
}();

}  // namespace
}  // namespace puck
