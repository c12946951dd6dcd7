#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "common/evaluation/prediction_score.h"
#include "common/simulation/camera_view.h"
#include "common/simulation/table_game.h"
#include "common/simulation/world_view.h"
#include "common/table/intercept_predictor.h"
#include "common/table/motion_filter.h"
#include "common/table/table_view.h"

namespace puck {

/// A simulated game without images, measured with a tracker's errors in the image, which last for
/// some ms.
struct PredictionRun {
  SimulationParams world;
  PuckMotionParams motion;
  MotionFilterParams filter;
  InterceptParams intercept;
  double seconds = 60;
  std::int64_t period_us = 1000;
  double noise_px = 0.2;
  double noise_memory_ms = 3;
  double velocity_noise_px_s = 60;

  struct Result {
    PredictionReport report;
    std::int64_t measurements = 0;
    std::int64_t outliers = 0;
    std::int64_t starts = 0;
    double worst_position_m = 0;  ///< Of the track against the truth.
    double rms_position_m = 0;
    double rms_velocity_m_s = 0;
    double position_nees = 0;  ///< Mean normalised error squared; 2 is consistent.
    double velocity_nees = 0;
  };

  Result play() const {
    SimulationParams params = world;
    params.autonomous_robot = true;
    TableGame game(params);
    const CameraView camera(params.camera, params.sensor_size);
    const WorldView seen_world(params.table, params.scene, params.sensor_size);
    const TableView view(camera.table_from_image(params.scene.puck_height_m / 2));
    const PuckMotion model(params.table, motion);
    MotionFilter tracker(model, filter);
    const InterceptPredictor predictor(model, intercept);
    PredictionScore score;
    Result result;

    std::mt19937 random(static_cast<std::uint32_t>(params.seed));
    std::normal_distribution<double> normal;
    const double kept = std::exp(-static_cast<double>(period_us) * 1e-3 / noise_memory_ms);
    double error_x = 0;
    double error_y = 0;
    double sum_position = 0;
    double sum_velocity = 0;
    double sum_position_nees = 0;
    double sum_velocity_nees = 0;
    std::int64_t counted = 0;

    Timestamp t;
    std::optional<DiscState> before;
    const auto steps = static_cast<std::int64_t>(seconds * 1e6) / PuckPhysics::kStep_us;
    for (std::int64_t step = 1; step <= steps; ++step) {
      game.step();
      t = t + PuckPhysics::kStep_us;
      const std::optional<DiscState> puck = game.puck();
      if (!puck) {
        if (before) score.interrupted(t), tracker.reset();
        before.reset();
        continue;
      }
      if (before) {
        if (is_near(*puck, game.opponent_mallet(), params.table)) score.interrupted(t);
        const double line_m = predictor.line_x_m();
        if (before->position.x_m > line_m && puck->position.x_m <= line_m) {
          score.crossed(t, puck->position.y_m);
        }
      }
      before = puck;
      if (t.us % period_us != 0) continue;

      const Pixel centre = seen_world.puck_box(puck->position, camera).centre;
      const Pixel next = seen_world
                             .puck_box({puck->position.x_m + 1e-4 * puck->velocity.x_m_s,
                                        puck->position.y_m + 1e-4 * puck->velocity.y_m_s},
                                       camera)
                             .centre;
      error_x = kept * error_x + std::sqrt(1 - kept * kept) * noise_px * normal(random);
      error_y = kept * error_y + std::sqrt(1 - kept * kept) * noise_px * normal(random);
      ImageTrack seen{{centre.x + error_x, centre.y + error_y},
                      {(next.x - centre.x) * 1e4 + velocity_noise_px_s * normal(random),
                       (next.y - centre.y) * 1e4 + velocity_noise_px_s * normal(random)}};
      const double speed_variance = velocity_noise_px_s * velocity_noise_px_s;
      seen.covariance =
          diagonal(noise_px * noise_px, noise_px * noise_px, speed_variance, speed_variance);
      const std::optional<PuckTrack> on_table = view.to_table(seen);
      if (!on_table) continue;
      const Matrix4& p = on_table->covariance;
      ++result.measurements;
      switch (tracker.update({t, on_table->state.position, p.topLeftCorner<2, 2>(),
                              on_table->state.velocity, false, p.bottomRightCorner<2, 2>()})) {
        case MeasurementUse::kStarted:
        case MeasurementUse::kHit:
        case MeasurementUse::kJumped:
          ++result.starts;
          break;
        case MeasurementUse::kOutlier:
          ++result.outliers;
          break;
        default:
          break;
      }
      const std::optional<PuckTrack> track = tracker.at(t);
      score.add(t, track ? predictor.predict(*track) : std::nullopt);
      if (!track) continue;
      ++counted;
      const double dx = track->state.position.x_m - puck->position.x_m;
      const double dy = track->state.position.y_m - puck->position.y_m;
      const double dvx = track->state.velocity.x_m_s - puck->velocity.x_m_s;
      const double dvy = track->state.velocity.y_m_s - puck->velocity.y_m_s;
      sum_position += dx * dx + dy * dy;
      sum_velocity += dvx * dvx + dvy * dvy;
      const Matrix4& c = track->covariance;
      sum_position_nees += nees(dx, dy, c(0, 0), c(0, 1), c(1, 1));
      sum_velocity_nees += nees(dvx, dvy, c(2, 2), c(2, 3), c(3, 3));
      result.worst_position_m = std::max(result.worst_position_m, std::hypot(dx, dy));
    }
    const auto n = static_cast<double>(std::max<std::int64_t>(counted, 1));
    result.rms_position_m = std::sqrt(sum_position / n);
    result.rms_velocity_m_s = std::sqrt(sum_velocity / n);
    result.position_nees = sum_position_nees / n;
    result.velocity_nees = sum_velocity_nees / n;
    result.report = score.report();
    return result;
  }

 private:
  static bool is_near(const DiscState& puck, const DiscState& mallet, const TableGeometry& table) {
    constexpr double kTouch_m = 5e-4;
    return std::hypot(puck.position.x_m - mallet.position.x_m,
                      puck.position.y_m - mallet.position.y_m) <
           table.puck_radius_m + table.mallet_radius_m + kTouch_m;
  }
  static double nees(double dx, double dy, double xx, double xy, double yy) {
    return (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy);
  }
};

}  // namespace puck
