#include "tools/calibrate/lag_command.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "common/calibration/contour_fit.h"
#include "common/io/calibration_text.h"
#include "common/io/contour_calibration_file.h"
#include "common/io/size_model_file.h"
#include "common/io/truth_file.h"

namespace puck {
namespace {

// The truth may end this long, or a tenth of the recording, before the events.
constexpr std::int64_t kEndsEarlyUs = 1'000'000;

std::string seconds(Timestamp time) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f", static_cast<double>(time.us) * 1e-6);
  return text;
}

void check_overlap(const TruthMotion& truth, Timestamp first, Timestamp last) {
  const std::int64_t allowed_us = std::max(kEndsEarlyUs, (last - first) / 10);
  if (truth.last() + allowed_us >= last && truth.first() < last) return;
  throw std::invalid_argument("the truth goes from " + seconds(truth.first()) + " to " +
                              seconds(truth.last()) + " s, the events from " + seconds(first) +
                              " to " + seconds(last) +
                              " s: the truth must cover the whole recording; check that it "
                              "belongs to this recording");
}

void check_puck(const TruthMotion& truth, const ContourSamples& samples) {
  if (!truth.ever_visible()) {
    throw std::invalid_argument("the puck is never fully visible in the truth");
  }
  if (samples.windows() == 0) {
    throw std::invalid_argument(
        "the lag cannot be fitted: the truth has no steady motion of 60 px/s or more in rows "
        "at most 50 ms apart");
  }
  if (samples.clear_windows() == 0) {
    throw std::invalid_argument(
        "no events lie on the puck's contour at its true positions: check that the truth "
        "belongs to this recording and the size model to this camera");
  }
}

void print(const ContourFit& fit, const ContourSamples& samples) {
  const ContourCalibration& c = fit.calibration;
  const ContourCalibration& e = fit.standard_error;
  std::printf(
      "%zu contour events from %.1f s in which nothing else fired near the moving puck, of "
      "%.1f s\n",
      fit.events, 2e-3 * static_cast<double>(samples.clear_windows()),
      2e-3 * static_cast<double>(samples.windows()));
  std::printf("lag_us      %8.1f +- %.1f\n", c.lag_us, e.lag_us);
  std::printf("wall_share  %8.4f +- %.4f\n", c.wall_share, e.wall_share);
  std::printf("grow_px     %8.3f +- %.3f\n", c.grow_px, e.grow_px);
  std::printf("trail_px    %8.4f +- %.4f\n", c.trail_px, e.trail_px);
  std::printf("events lie %.3f px from where they are expected, %.3f px before the fit\n",
              fit.spread_px, fit.spread_before_px);
  std::printf("residuals, px: front %+.3f, back %+.3f, upper edge %+.3f, lower edge %+.3f\n",
              fit.front_px, fit.back_px, fit.upper_px, fit.lower_px);
  std::printf("nine tenths of the events move at less than %.0f px/s\n", fit.fast_px_s);
}

}  // namespace

void calibrate_lag(const LagCommand& command, const std::string& typed) {
  check_recording_exists(command.recording);
  const PuckSizeModel size_model = read_size_model_file(command.size_model);
  // The fit does not estimate the lean: keep the value that was set by hand.
  const double lean_deg =
      read_contour_calibration(command.size_model).value_or(ContourCalibration{}).lean_deg;
  const TruthMotion truth(read_truth_file(command.truth));
  const auto events = open_event_file(command.recording, command.file);
  for (const std::string& doubt : doubts_about(size_model, events->sensor_size())) {
    std::fprintf(stderr, "puck-calibrate: %s: %s\n", command.size_model.c_str(), doubt.c_str());
  }

  ContourSamples samples(truth, events->sensor_size(), size_model, lean_deg);
  EventPacket packet;
  std::optional<Timestamp> first;
  Timestamp last;
  while (events->read(packet, EventReader::kUsualEvents)) {
    if (!first) first = packet.time_of(packet.events.front());
    last = packet.newest();
    samples.add(packet);
  }
  samples.finish();
  if (!first) throw std::invalid_argument("there are no events");
  check_overlap(truth, *first, last);
  check_puck(truth, samples);
  const ContourFit fit = fit_contour(samples);

  std::string text = without_table(read_calibration_text(command.size_model), "contour");
  text += contour_calibration_text(fit.calibration, typed);
  write_calibration_text(command.output, text);
  print(fit, samples);
}

}  // namespace puck
