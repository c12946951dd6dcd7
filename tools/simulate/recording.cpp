#include "tools/simulate/recording.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "common/calibration/size_calibration.h"
#include "common/io/annotation_file.h"
#include "common/io/calibration_text.h"
#include "common/io/size_model_file.h"
#include "common/io/table_file.h"
#include "common/io/truth_file.h"
#include "common/recording/recording.h"
#include "common/simulation/simulated_table.h"
#include "tools/simulate/marks.h"

namespace puck {
namespace {

constexpr int kMarks = 40;

// A puck off the table keeps its last visible position, as invisible.
TruthRow row_of(const SimulatedTruth& truth, const TruthRow& before) {
  if (!truth.in_play) return {truth.time, before.centre, before.size, 0};
  return {truth.time, truth.position_px, truth.size_px, truth.visible};
}

// Both parts of a calibration in one file.
bool write_calibration(const SimulateSettings& settings, bool moving_camera, SensorSize sensor,
                       const std::vector<Annotation>& marks, const TableCalibration& table) {
  const std::filesystem::path path = settings.output + ".toml";
  std::string note = settings.command;
  if (moving_camera) note += "\nThe camera moves: the table is as seen from its home pose.";
  std::string text = table_text(table, note);

  bool has_size_model = false;
  try {
    const SizeCalibration calibration = calibrate_size(marks, sensor);
    const std::size_t used = marks.size() - calibration.outliers.size();
    text += size_model_text(calibration.model, "Fitted to " + std::to_string(used) + " marks.");
    has_size_model = true;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "puck-simulate: no size model in %s: %s\n", path.c_str(), error.what());
  }
  write_calibration_text(path, text);
  return has_size_model;
}

class Progress {
 public:
  explicit Progress(double seconds) : seconds_(seconds) {}

  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void tell(double done_s, std::int64_t events) {
    if (elapsed_s() < next_s_) return;
    next_s_ = elapsed_s() + 1;
    std::fprintf(stderr, "puck-simulate: %.1f of %.1f s, %.1f Mev\n", done_s, seconds_,
                 static_cast<double>(events) * 1e-6);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_;
  double next_s_ = 1;
};

}  // namespace

RecordingSummary record(const SimulateSettings& settings, const SimulationParams& params) {
  const std::string file = settings.output + std::string(usual_ending_of(settings.format));
  const auto writer = make_recording_writer(file, settings.format, params.sensor_size, "");
  SimulatedTable table(params);
  Progress progress(settings.seconds);
  RecordingSummary summary;

  std::vector<TruthRow> truth{row_of(table.truth(), {})};
  EventPacket packet;
  const auto end_us = static_cast<std::int64_t>(settings.seconds * 1e6);
  while (table.now().us < end_us) {
    packet.events.clear();
    table.advance(packet);
    writer->write(packet);
    summary.events += static_cast<std::int64_t>(packet.events.size());
    if (table.now().us % kTruthPeriod_us != 0) continue;
    truth.push_back(row_of(table.truth(), truth.back()));
    progress.tell(static_cast<double>(table.now().us) * 1e-6, summary.events);
  }
  writer->close();
  summary.lost = table.events_lost();

  const std::vector<Annotation> marks = spread_marks(truth, kMarks);
  write_truth_file(settings.output + ".truth.csv", truth);
  write_annotation_file(settings.output + ".annotations.csv", marks);
  summary.has_size_model =
      write_calibration(settings, params.moving_camera, params.sensor_size, marks,
                        {table.table_from_image(), params.table, table.camera()});
  summary.seconds = static_cast<double>(table.now().us) * 1e-6;
  summary.took_s = progress.elapsed_s();
  summary.marks = static_cast<int>(marks.size());
  summary.counts = table.truth().counts;
  return summary;
}

}  // namespace puck
