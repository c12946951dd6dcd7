#include "tests/bench/live/recordings.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "common/io/event_reader.h"
#include "common/io/event_writer.h"
#include "common/io/size_model_file.h"
#include "common/vision/geometry/puck_size_model.h"
#include "tests/bench/busy_game.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};
constexpr double kNoiseHz = 10'000;
constexpr double kStep_s = 200e-6;

// Slows down evenly from 300 px/s to a halt.
Pixel puck_at(double t_s) {
  const double left_s = std::max(0.0, kStillSceneRests_s - t_s);
  return {420 - 100 * left_s * left_s, 260};
}

bool covers(Pixel centre, PuckSize size, int x, int y) {
  return std::hypot((x - centre.x) / (size.width / 2), (y - centre.y) / (size.height / 2)) < 1;
}

// A dark puck on a bright table: an event of every pixel that it covers or uncovers.
void add_motion(Pixel before, Pixel after, const PuckSizeModel& sizes, EventPacket& out) {
  const PuckSize old_size = sizes.at(before);
  const PuckSize new_size = sizes.at(after);
  const int reach = static_cast<int>(std::max(new_size.width, new_size.height));
  const int left = static_cast<int>(after.x) - reach;
  const int top = static_cast<int>(after.y) - reach;
  for (int y = top; y <= top + 2 * reach; ++y) {
    for (int x = left; x <= left + 2 * reach; ++x) {
      const bool was = covers(before, old_size, x, y);
      const bool is = covers(after, new_size, x, y);
      if (was == is) continue;
      out.events.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                            static_cast<std::uint16_t>(was ? 1 : 0), 0});
    }
  }
}

}  // namespace

Recording dense_recording(const std::filesystem::path& recordings, const Recording& simulated) {
  for (const char* name : {"sparklers_gen31_640x480_evt2.raw", "driving_gen41_1280x720_evt3.raw"}) {
    if (std::filesystem::exists(recordings / name)) return {recordings / name, name};
  }
  return simulated;
}

Recording simulate_game(const LiveSetup& setup, const std::filesystem::path& folder) {
  const std::filesystem::path base = folder / "game";
  const Finished finished =
      run_program({(setup.bin / "puck-simulate").string(), "--output", base.string(), "--seconds",
                   "5", "--seed", "1", "--moving"},
                  {.folder = setup.source});
  if (finished.exit_code != 0) {
    throw std::runtime_error("puck-simulate failed: " + finished.errors);
  }
  return {base.string() + ".raw", "simulated game"};
}

Recording write_still_scene(const LiveSetup& setup, const std::filesystem::path& folder,
                            double seconds) {
  const Recording scene{folder / "still.raw", "still scene"};
  const PuckSizeModel sizes =
      read_size_model_file(setup.source / "config" / "calibration" / "simulated_size.toml");
  const auto writer = make_event_writer(scene.file, "evt3", kSensor);
  std::mt19937_64 random(3);
  std::exponential_distribution<double> gap_s(kNoiseHz);
  std::uniform_int_distribution<int> column(0, kSensor.width - 1);
  std::uniform_int_distribution<int> row(0, kSensor.height - 1);
  std::bernoulli_distribution polarity;
  double noise_at_s = gap_s(random);
  for (double t_s = 0; t_s < kStillSceneRests_s + seconds; t_s += kStep_s) {
    EventPacket packet{{std::llround(t_s * 1e6)}, {}};
    if (t_s < kStillSceneRests_s) add_motion(puck_at(t_s), puck_at(t_s + kStep_s), sizes, packet);
    for (; noise_at_s < t_s + kStep_s; noise_at_s += gap_s(random)) {
      const auto offset_us = std::max(0.0, (noise_at_s - t_s) * 1e6);
      packet.events.push_back({static_cast<std::uint16_t>(column(random)),
                               static_cast<std::uint16_t>(row(random)),
                               static_cast<std::uint16_t>(polarity(random) ? 1 : 0),
                               static_cast<std::uint32_t>(offset_us)});
    }
    if (!packet.empty()) writer->write(packet);
  }
  writer->close();
  return scene;
}

Recording write_busy_game(const Recording& game, double rate_mev_s,
                          const std::filesystem::path& folder) {
  constexpr double kLength_us = 2e6;
  // About what the simulated game has in that time.
  constexpr std::size_t kEvents = 2'000'000;
  const auto reader = open_event_file(game.file);
  EventPacket packet;
  reader->read(packet, kEvents);
  const Recording busy{folder / "busy.raw", "busy game"};
  const auto writer = make_event_writer(busy.file, "evt3", reader->sensor_size());
  EventPacket part;
  for (const TimedPixel& next :
       busy_game(packet, rate_mev_s, static_cast<std::size_t>(rate_mev_s * kLength_us))) {
    constexpr std::int64_t kPart_us = 10'000;
    if (part.empty() || next.time_us >= part.start.us + kPart_us) {
      if (!part.empty()) writer->write(part);
      part = {{next.time_us}, {}};
    }
    part.events.push_back(next.event);
    part.events.back().offset_us = static_cast<std::uint32_t>(next.time_us - part.start.us);
  }
  writer->write(part);
  writer->close();
  return busy;
}

std::vector<std::string> looped_at(const Recording& recording, double rate_mev_s) {
  return {"camera.source=file", "camera.file=" + recording.file.string(), "camera.loop=true",
          "camera.rate_mev_s=" + std::to_string(rate_mev_s)};
}

}  // namespace puck
