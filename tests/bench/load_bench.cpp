// Cost of surface and tracking together, in one thread: the pipeline as offline, with as many
// estimates a second as a tracker publishes. The base is the textbook's surface alone, k = 5.

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/io/contour_calibration_file.h"
#include "common/io/event_reader.h"
#include "common/io/size_model_file.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "tests/bench/bench_streams.h"
#include "tests/bench/busy_game.h"
#include "tests/bench/eros_textbook.h"

namespace puck {
namespace {

constexpr std::int64_t kEstimatePeriod_us = 200;  // The default of tracker.max_publish_hz.
constexpr std::int64_t kIteration_us = 10'000;
// Until the puck is found; not measured.
constexpr std::int64_t kWarmUp_us = 300'000;
constexpr int kTextbookHalfWidth_px = 5;
constexpr double kDecay = 0.786;

// Events in the order of their times, in packets of an estimate's period.
struct Packets {
  SensorSize sensor;
  std::vector<EventPacket> packets;
};

Packets packed(SensorSize sensor, std::vector<TimedPixel> events) {
  sort_by_time(events);
  Packets all{sensor, {}};
  const std::int64_t begin_us = events.front().time_us;
  for (TimedPixel& timed : events) {
    const auto period = static_cast<std::size_t>((timed.time_us - begin_us) / kEstimatePeriod_us);
    while (all.packets.size() <= period) {
      const auto passed = static_cast<std::int64_t>(all.packets.size());
      all.packets.push_back({{begin_us + passed * kEstimatePeriod_us}, {}});
    }
    EventPacket& packet = all.packets[period];
    timed.event.offset_us = static_cast<std::uint32_t>(timed.time_us - packet.start.us);
    packet.events.push_back(timed.event);
  }
  return all;
}

Packets game_at(int kev_s) {
  constexpr std::size_t kMost = 12'000'000;
  const BenchEvents scene = load(BenchStream::kScene);
  return packed(scene.sensor, busy_game(scene.packet, kev_s * 1e-3, kMost));
}

// Events of pixels in a part of the image at random times, for 2 s.
Packets random_events(const Region& where, int kev_s) {
  constexpr double kSpan_us = 2'000'000;
  std::mt19937 random(3);
  std::exponential_distribution<double> gap_us(kev_s * 1e-3);
  std::vector<TimedPixel> events;
  for (double time_us = 0; time_us < kSpan_us; time_us += gap_us(random)) {
    const auto pixel = random() % static_cast<unsigned>(where.width * where.height);
    const auto width = static_cast<unsigned>(where.width);
    events.push_back({std::llround(time_us),
                      {static_cast<std::uint16_t>(static_cast<unsigned>(where.x) + pixel % width),
                       static_cast<std::uint16_t>(static_cast<unsigned>(where.y) + pixel / width),
                       static_cast<std::uint16_t>(random() % 2), 0}});
  }
  return packed({640, 480}, std::move(events));
}

// A lamp that flickers: all its pixels brighten and darken together, 100 times a second.
Packets lamp(int kev_s) {
  constexpr Region kWhere{270, 200, 100, 50};
  constexpr double kHalfPeriod_us = 5'000;
  Packets noise = random_events(kWhere, kev_s);
  for (EventPacket& packet : noise.packets) {
    const auto half =
        static_cast<std::int64_t>(static_cast<double>(packet.start.us) / kHalfPeriod_us);
    for (Event& event : packet.events) event.polarity = static_cast<std::uint16_t>(half % 2);
  }
  return noise;
}

Packets recorded(const std::filesystem::path& path) {
  const auto reader = open_event_file(path);
  EventPacket packet;
  reader->read(packet, std::size_t{1} << 23);
  return packed(reader->sensor_size(), timed(packet));
}

// Made when it is first wanted, once for all repetitions.
class Stream {
 public:
  explicit Stream(std::function<Packets()> make)
      : make_(std::move(make)), made_(std::make_shared<std::optional<Packets>>()) {}

  const Packets& packets() const {
    if (!*made_) *made_ = make_();
    return **made_;
  }

 private:
  std::function<Packets()> make_;
  std::shared_ptr<std::optional<Packets>> made_;
};

class Load {
 public:
  Load(Preset preset, const Packets& packets, std::int64_t warm_up_us)
      : params_(preset_params(preset)),
        packets_(packets),
        warm_up_(static_cast<std::size_t>(warm_up_us / kEstimatePeriod_us)) {
    const auto calibration =
        std::filesystem::path(PUCK_SOURCE_DIR) / "config/calibration/simulated_size.toml";
    size_model_ = read_size_model_file(calibration);
    if (const auto contour = read_contour_calibration(calibration)) {
      search_params(params_).contour = *contour;
    }
    restart();
  }

  bool is_at_end() const { return next_ == packets_.packets.size(); }

  void restart() {
    tracker_ = std::make_unique<SurfaceTracker>(packets_.sensor, params_, size_model_);
    for (next_ = 0; next_ < warm_up_;) step();
  }

  PuckEstimate step() {
    const EventPacket& packet = packets_.packets[next_++];
    if (!packet.empty()) tracker_->update(packet);
    return tracker_->estimate();
  }

 private:
  PipelineParams params_;
  const Packets& packets_;
  std::size_t warm_up_;
  PuckSizeModel size_model_;
  std::unique_ptr<SurfaceTracker> tracker_;
  std::size_t next_ = 0;
};

void measure(benchmark::State& state, Preset preset, const Stream& stream) {
  Load load(preset, stream.packets(), kWarmUp_us);
  std::int64_t tracked = 0;
  constexpr int kSteps = kIteration_us / kEstimatePeriod_us;
  for (auto _ : state) {
    for (int i = 0; i < kSteps; ++i) {
      if (load.is_at_end()) {
        state.PauseTiming();
        load.restart();
        state.ResumeTiming();
      }
      tracked += load.step().state == TrackState::kTracking;
    }
  }
  const auto estimates = static_cast<double>(state.iterations() * kSteps);
  state.counters["steps"] = kSteps;
  // CPU time over the time that the events take.
  const double lasts_s = estimates * kEstimatePeriod_us * 1e-6;
  state.counters["core_percent"] =
      benchmark::Counter(lasts_s / 100, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["tracked_percent"] = 100 * static_cast<double>(tracked) / estimates;
}

void textbook(benchmark::State& state, const Stream& stream) {
  const Packets& all = stream.packets();
  TextbookEros<std::uint8_t> surface(all.sensor, kTextbookHalfWidth_px, kDecay);
  const std::size_t first = kWarmUp_us / kEstimatePeriod_us;
  std::size_t next = first;
  constexpr int kSteps = kIteration_us / kEstimatePeriod_us;
  for (auto _ : state) {
    for (int i = 0; i < kSteps; ++i) {
      if (next == all.packets.size()) next = first;
      surface.update(all.packets[next++].events);
    }
  }
  state.counters["steps"] = kSteps;
}

void add(const std::string& figure, Preset preset, const Stream& stream) {
  benchmark::RegisterBenchmark((figure + "/ours").c_str(), measure, preset, stream);
}

[[maybe_unused]] const bool registered = [] {
  for (const int kev_s : {100, 300, 1'000, 3'000, 10'000, 20'000}) {
    const Stream game([kev_s] { return game_at(kev_s); });
    for (const Preset preset : {Preset::kDefault, Preset::kCorrelation}) {
      const std::string figure =
          std::string("load_") + to_string(preset) + "_" + std::to_string(kev_s) + "kev";
      add(figure, preset, game);
      benchmark::RegisterBenchmark((figure + "/opencv_eros").c_str(), textbook, game);
    }
  }
  for (const int kev_s : {1, 5}) {
    add("load_lamp_" + std::to_string(kev_s) + "kev", Preset::kDefault,
        Stream([kev_s] { return lamp(kev_s); }));
  }
  add("load_noise_10kev", Preset::kDefault, Stream([] {
        return random_events({0, 0, 640, 480}, 10);
      }));
  const auto faint = bench_recordings() / "second_simulator" / "moving_faint_5_m_s.raw";
  if (std::filesystem::exists(faint)) {
    add("load_faint", Preset::kDefault, Stream([faint] { return recorded(faint); }));
  }
  return true;
}();

}  // namespace
}  // namespace puck
