#include "common/simulation/simulated_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "common/simulation/camera_view.h"
#include "common/simulation/event_sensor.h"
#include "common/simulation/fastest_motion.h"
#include "common/simulation/head_motion.h"
#include "common/simulation/panorama.h"
#include "common/simulation/random.h"
#include "common/simulation/scene_renderer.h"
#include "common/simulation/static_scene.h"
#include "common/simulation/table_game.h"
#include "common/simulation/world_view.h"

namespace puck {
namespace {

constexpr std::uint64_t kHeadStream = 20;
// Interval between two camera poses: a head at 20 °/s turns a quarter of a pixel in it.
constexpr std::int64_t kCameraStep_us = 1000;
// Longest motion of an edge between two drawings.
constexpr double kLongestMove_px = 0.5;
// A body that has moved less than this is not drawn again.
constexpr double kShortestMove_px = 0.02;

// How far a turned camera can see beyond the home pose's image.
Panorama::Margin margin_of(const CameraView& home, SensorSize size, const HeadPose& limits) {
  double x_px = 0;
  double y_px = 0;
  const double right = size.width - 1;
  const double bottom = size.height - 1;
  for (int signs = 0; signs < 8; ++signs) {
    const CameraView view = home.turned({signs & 1 ? limits.yaw_deg : -limits.yaw_deg,
                                         signs & 2 ? limits.pitch_deg : -limits.pitch_deg,
                                         signs & 4 ? limits.roll_deg : -limits.roll_deg, 0, 0, 0});
    for (const Pixel corner :
         {Pixel{0, 0}, Pixel{right, 0}, Pixel{0, bottom}, Pixel{right, bottom}}) {
      const auto seen = home.project(home.centre() + view.ray(corner));
      if (!seen) continue;
      x_px = std::max({x_px, -seen->pixel.x, seen->pixel.x - right});
      y_px = std::max({y_px, -seen->pixel.y, seen->pixel.y - bottom});
    }
  }
  constexpr double kSpare_px = 2;
  return {static_cast<int>(std::ceil(x_px + kSpare_px)),
          static_cast<int>(std::ceil(y_px + kSpare_px))};
}

}  // namespace

class SimulatedTable::World {
 public:
  explicit World(const SimulationParams& params)
      : params_(checked(params)),
        home_(params.camera, params.sensor_size),
        head_motion_(params.head_motion, Random(params.seed, kHeadStream)),
        game_(params),
        world_view_(params.table, params.scene, params.sensor_size),
        view_(view_at({})),
        renderer_(StaticScene(params.table, params.scene), home_, params.sensor_size,
                  params.moving_camera ? margin_of(home_, params.sensor_size, head_motion_.limits())
                                       : Panorama::Margin{}),
        sensor_(params.sensor, renderer_.background(), params.seed, params.light),
        bodies_(WorldView::kBodyCount),
        drawn_at_(WorldView::kBodyCount) {
    // The sensor starts settled on the complete picture, without a flash of events.
    if (params.moving_camera) renderer_.turn_camera(view_, 0, now_, now_, sensor_);
    draw_bodies(now_, now_);
    sensor_ = EventSensor(params.sensor, log_intensity().view(), params.seed, params.light);
  }

  void advance(EventPacket& packet) {
    const Timestamp start = now_;
    const Timestamp end = now_ + params_.slice_us;
    const double slice_s = static_cast<double>(params_.slice_us) * 1e-6;
    const double slice_px = fastest_px_s(game_, params_, view_, slice_s) * slice_s;
    if (params_.moving_camera && camera_turned_until_ <= start) turn_camera();
    const std::int64_t physics_steps = params_.slice_us / PuckPhysics::kStep_us;
    const std::int64_t drawings = std::clamp<std::int64_t>(
        static_cast<std::int64_t>(std::ceil(slice_px / kLongestMove_px)), 1, physics_steps);
    for (std::int64_t i = 0; i < drawings; ++i) {
      const std::int64_t first = physics_steps * i / drawings;
      const std::int64_t last = physics_steps * (i + 1) / drawings;
      for (std::int64_t step = first; step < last; ++step) game_.step();
      const Timestamp from = start + first * PuckPhysics::kStep_us;
      const Timestamp to = start + last * PuckPhysics::kStep_us;
      view_ = view_at(to);
      draw_bodies(from, to);
    }
    now_ = end;
    sensor_.finish_slice(end, packet);
  }

  Timestamp now() const { return now_; }

  SimulatedTruth truth() const {
    SimulatedTruth truth;
    truth.time = now_;
    if (const auto& puck = game_.puck()) {
      const PixelBox box = world_view_.puck_box(puck->position, view_);
      truth.position_px = box.centre;
      truth.size_px = box.size;
      truth.visible = world_view_.visible_share(game_, view_);
      truth.in_play = true;
      truth.position = puck->position;
      truth.velocity = puck->velocity;
    }
    truth.robot_mallet = game_.robot_mallet().position;
    truth.opponent_mallet = game_.opponent_mallet().position;
    if (params_.moving_camera) truth.head = head_motion_.pose_at(seconds(now_));
    truth.counts = game_.counts();
    return truth;
  }

  std::int64_t events_lost() const { return sensor_.lost(); }
  void set_robot_mallet(double y_m) { game_.set_robot_mallet(y_m); }
  SensorSize sensor_size() const { return params_.sensor_size; }
  Homography table_from_image() const {
    return home_.table_from_image(params_.scene.puck_height_m / 2);
  }
  PinholeCamera camera() const { return {home_.focal_px(), home_.principal_point(), {}}; }

  Image<float> log_intensity() const {
    Image<float> image(params_.sensor_size.width, params_.sensor_size.height);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) image(x, y) = sensor_.log_intensity(x, y);
    }
    return image;
  }

 private:
  static const SimulationParams& checked(const SimulationParams& params) {
    check(params);
    return params;
  }
  // The head turns slowly, so the static scene is drawn ahead for more than one slice; the sensor
  // holds the events until their slice.
  void turn_camera() {
    const Timestamp from = camera_turned_until_;
    const std::int64_t slices = (kCameraStep_us + params_.slice_us - 1) / params_.slice_us;
    camera_turned_until_ = from + slices * params_.slice_us;
    const double step_s = static_cast<double>(camera_turned_until_ - from) * 1e-6;
    const double fastest = fastest_px_s(game_, params_, view_, step_s);
    const int reach_px = static_cast<int>(std::ceil(fastest * step_s)) + 2;
    renderer_.turn_camera(view_at(camera_turned_until_), reach_px, from, camera_turned_until_,
                          sensor_);
  }

  static double seconds(Timestamp time) { return static_cast<double>(time.us) * 1e-6; }

  CameraView view_at(Timestamp time) const {
    return params_.moving_camera ? home_.turned(head_motion_.pose_at(seconds(time))) : home_;
  }

  void draw_bodies(Timestamp from, Timestamp to) {
    std::vector<bool> moved(WorldView::kBodyCount);
    for (int i = 0; i < WorldView::kBodyCount; ++i) {
      const auto which = static_cast<WorldView::Body>(i);
      const auto index = static_cast<std::size_t>(i);
      const auto seen_at = place_in_image(which);
      moved[index] = has_moved(drawn_at_[index], seen_at);
      if (!moved[index]) continue;
      bodies_[index] = world_view_.body(which, game_, view_);
      drawn_at_[index] = seen_at;
    }
    renderer_.draw_bodies(bodies_, WorldView::nearest_first(game_), moved, from, to, sensor_);
  }

  // `std::nullopt` for an absent body; not a number behind the camera.
  std::optional<Pixel> place_in_image(WorldView::Body which) const {
    const auto place = WorldView::place_of(which, game_);
    if (!place) return std::nullopt;
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    const auto seen = view_.project({place->x_m, place->y_m, 0});
    return seen ? seen->pixel : Pixel{kNowhere, kNowhere};
  }

  static bool has_moved(const std::optional<Pixel>& from, const std::optional<Pixel>& to) {
    if (!from || !to) return from.has_value() != to.has_value();
    return !(std::hypot(to->x - from->x, to->y - from->y) <= kShortestMove_px);
  }

  SimulationParams params_;
  CameraView home_;
  HeadMotion head_motion_;
  TableGame game_;
  WorldView world_view_;
  CameraView view_;
  SceneRenderer renderer_;
  EventSensor sensor_;
  std::vector<SceneBody> bodies_;
  std::vector<std::optional<Pixel>> drawn_at_;
  Timestamp now_;
  Timestamp camera_turned_until_;
};

SimulatedTable::SimulatedTable(const SimulationParams& params)
    : world_(std::make_unique<World>(params)) {}
SimulatedTable::~SimulatedTable() = default;
SimulatedTable::SimulatedTable(SimulatedTable&&) noexcept = default;
SimulatedTable& SimulatedTable::operator=(SimulatedTable&&) noexcept = default;

void SimulatedTable::advance(EventPacket& packet) { world_->advance(packet); }
Timestamp SimulatedTable::now() const { return world_->now(); }
SimulatedTruth SimulatedTable::truth() const { return world_->truth(); }
std::int64_t SimulatedTable::events_lost() const { return world_->events_lost(); }
void SimulatedTable::set_robot_mallet(double y_m) { world_->set_robot_mallet(y_m); }
SensorSize SimulatedTable::sensor_size() const { return world_->sensor_size(); }
Homography SimulatedTable::table_from_image() const { return world_->table_from_image(); }
PinholeCamera SimulatedTable::camera() const { return world_->camera(); }
Image<float> SimulatedTable::log_intensity() const { return world_->log_intensity(); }

}  // namespace puck
