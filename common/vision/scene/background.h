#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/scene/camera_turn.h"
#include "common/vision/scene/fading_map.h"
#include "common/vision/scene/image_cells.h"

namespace puck {

/// Tells events of what stands still in the world, while the head turns, from those of what moves.
/// Keeps a map of where events have been and, each millisecond, finds the turn of the camera by
/// which the new ones fit it best. What lies on the map stands still. It takes a scene with edges
/// in most of the image: of a plain table with a few marks nothing is known. The same events give
/// the same answers, to the bit.
class Background {
 public:
  /// `least_cells`: the number of the image's 48 cells in which what stands still must be seen for
  /// it to be known. Arms that cross half of the image are in up to 30, a table while the head
  /// turns in 37 to 48; a scene with few edges needs fewer.
  Background(SensorSize sensor, int least_cells);

  /// Takes an event of anywhere in the image, but not of the puck's. Of too many it takes some.
  void take(double x, double y) {
    ++seen_;
    if (--until_taken_ > 0 || taken_.size() == kMostEvents) return;
    until_taken_ = stride_;
    taken_.push_back({x, y});
  }

  /// To be called at each decision: ends a period of a millisecond. `noise_per_pixel_us`:
  /// NoiseFloor's.
  void decide(std::int64_t time_us, double noise_per_pixel_us = 0);

  /// Learns from the last period. The next decide() does it if nobody has; until then all answers
  /// are those of the periods before.
  void work_off();

  /// The map is of a scene that moves as one, or so it seems. Otherwise nothing is known to stand
  /// still: with a still camera only hands and mallets might have drawn it.
  bool is_known() const { return is_known_; }

  /// Most of what is seen is known to stand still, so that it is the head that moves: hands and
  /// mallets may have as many events, but beside the map.
  bool head_turns() const { return head_turns_; }

  /// For long nothing has been known to stand still and little of the image has been busy, so that
  /// the head is at rest: all that is seen of a table is busy at once when it turns.
  bool head_rests() const { return calm_us_ > kRestsAfter_us; }

  /// Little of the image has been busy for 20 ms, so the head does not turn.
  bool is_calm() const { return calm_us_ > kCalmAfter_us; }

  /// How fast the image of what stands still moves there, px/s, while the head turns; none while it
  /// is not known that it does, or has been known for less than TurnTrail takes.
  std::optional<PixelVelocity> still_velocity_at(Pixel place) const;

  /// Whether an event here is of something that stands still.
  bool is_still(double x, double y) const {
    return is_known_ && map_.level(turn_.then_of({x, y})) > still_level_;
  }

 private:
  // So many events say where the camera looks.
  static constexpr std::size_t kMostEvents = 1'000;
  // Of an edge that passes once, and leaves a few events at each pixel, there is less.
  static constexpr double kStill = 15;
  // A scene that moves as one is known, or busy, sooner.
  static constexpr std::int64_t kRestsAfter_us = 300'000;
  static constexpr std::int64_t kCalmAfter_us = 20'000;
  using Cells = std::array<double, ImageCells::kCount>;

  // Events and the time in which they came.
  struct Period {
    std::int64_t time_us = 0;  // of its end
    std::int64_t passed_us = 0;
    double noise = 0;  // events of a pixel
    std::vector<Pixel> events;
  };

  void place_events();
  void align();
  void clear_map();
  std::size_t cell_of(Pixel event) const {
    return cells_.cell_of(static_cast<int>(event.x), static_cast<int>(event.y));
  }
  void note_activity();

  SensorSize sensor_;
  int least_cells_;
  ImageCells cells_;
  FadingMap map_;
  CameraTurn turn_;
  CameraTurn::Steps speed_{};  // a period
  TurnTrail trail_;
  std::vector<Pixel> taken_;
  Period last_;
  bool is_owed_ = false;     // The last period is to be learned from.
  std::vector<Pixel> then_;  // where its events lie on the map
  std::int64_t seen_ = 0;    // in this period
  std::int64_t stride_ = 1;  // Of so many events one is taken.
  std::int64_t until_taken_ = 1;
  std::int64_t decided_us_ = 0;
  double still_level_ = kStill;  // more than noise has on the map
  Cells activity_{};             // events on the map, fading
  Cells events_{};               // all events, fading
  double noise_ = 0;             // those that a pixel made by itself, on average, fading
  bool is_known_ = false;
  bool head_turns_ = false;
  std::int64_t calm_us_ = 0;     // see head_rests
  std::int64_t unknown_us_ = 0;  // for how long it has not been known what stands still
};

}  // namespace puck
