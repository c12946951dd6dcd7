#include <algorithm>
#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>
#include <opencv2/core.hpp>

#include "tools/view/drawing/scene_painter.h"
#include "tools/view/drawing/track_marks.h"

namespace puck {
namespace {

constexpr SensorSize kPicturedSensor{320, 240};
constexpr Timestamp kPictureTime{1'000'000};

// Two pixels of the picture for one of the sensor, and no bars.
PictureWishes bare_wishes() {
  PictureWishes wishes;
  wishes.width_px = 640;
  wishes.height_px = 480;
  wishes.layers.words = wishes.layers.legend = wishes.layers.close_up = false;
  return wishes;
}

ViewScene empty_scene() {
  ViewScene scene;
  scene.sensor = kPicturedSensor;
  scene.time = kPictureTime;
  scene.seconds = 1;
  scene.events.reset(kPicturedSensor);
  return scene;
}

void add_event_at(ViewScene& scene, int x, int y, int polarity, std::int64_t age_us) {
  EventPacket packet{kPictureTime - age_us, {}};
  Event event;
  event.x = static_cast<std::uint16_t>(x);
  event.y = static_cast<std::uint16_t>(y) & 0x7fff;
  event.polarity = polarity & 1;
  packet.events.push_back(event);
  scene.events.update(packet);
}

PuckEstimate tracked_puck(Pixel place) {
  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.position = place;
  estimate.size = {60, 40};
  estimate.score = 0.9;
  return estimate;
}

ViewScene scene_with(const PuckEstimate& estimate) {
  ViewScene scene = empty_scene();
  scene.tracks[0].name = "default";
  scene.tracks[0].estimate = estimate;
  return scene;
}

cv::Mat paint(const ViewScene& scene, const PictureWishes& wishes = bare_wishes()) {
  ScenePainter painter;
  return painter.paint(scene, wishes).clone();
}

cv::Vec3b at(const cv::Mat& picture, double x, double y) {
  return picture.at<cv::Vec3b>(static_cast<int>((y + 0.5) * 2), static_cast<int>((x + 0.5) * 2));
}
int brightness(cv::Vec3b c) { return c[0] + c[1] + c[2]; }
bool is_white(cv::Vec3b c) { return brightness(c) > 3 * 220; }
bool is_dark(cv::Vec3b c) { return brightness(c) < 3 * 30; }
bool is_pink(cv::Vec3b c) { return c[2] > c[1] + 50 && c[0] > c[1] + 50; }

// Share of the estimate's outline that is bright.
double bright_share(const cv::Mat& picture, Pixel centre, PuckSize size) {
  int bright = 0;
  constexpr int kPlaces = 360;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = i * M_PI / 180;
    bright += brightness(at(picture, centre.x + size.width / 2 * std::cos(angle),
                            centre.y + size.height / 2 * std::sin(angle))) > 3 * 100
                  ? 1
                  : 0;
  }
  return static_cast<double>(bright) / kPlaces;
}

TEST_CASE("events are coloured by polarity, older ones fainter, those outside of the window not") {
  ViewScene scene = empty_scene();
  add_event_at(scene, 10, 20, 1, 1'000);
  add_event_at(scene, 12, 20, 0, 1'000);
  add_event_at(scene, 14, 20, 1, 18'000);
  add_event_at(scene, 16, 20, 1, 21'000);
  add_event_at(scene, 18, 20, 1, -1'000);
  const cv::Mat picture = paint(scene);
  const cv::Vec3b brighter = at(picture, 10, 20);
  const cv::Vec3b darker = at(picture, 12, 20);
  CHECK(brighter[2] > brighter[0] + 50);
  CHECK(darker[0] > darker[2] + 50);
  CHECK(brightness(at(picture, 14, 20)) < brightness(brighter));
  CHECK(!is_dark(at(picture, 14, 20)));
  CHECK(is_dark(at(picture, 16, 20)));
  CHECK(is_dark(at(picture, 18, 20)));
  PictureWishes longer = bare_wishes();
  longer.window_us = 30'000;
  CHECK(!is_dark(at(paint(scene, longer), 16, 20)));
}

TEST_CASE("the ellipse lies where the estimate says, and disappears with its layer") {
  const PuckEstimate estimate = tracked_puck({100, 80});
  const cv::Mat picture = paint(scene_with(estimate));
  CHECK(bright_share(picture, {100, 80}, {60, 40}) > 0.98);
  CHECK(bright_share(picture, {100, 80}, {50, 32}) == 0);
  CHECK(bright_share(picture, {100, 80}, {70, 48}) == 0);
  PictureWishes hidden = bare_wishes();
  hidden.layers.ellipse = false;
  CHECK(bright_share(paint(scene_with(estimate), hidden), {100, 80}, {60, 40}) == 0);
}

TEST_CASE("a track that is not believed is dashed, fainter and named") {
  PuckEstimate estimate = tracked_puck({100, 120});
  estimate.coasting = true;
  const cv::Mat picture = paint(scene_with(estimate));
  const double share = bright_share(picture, {100, 120}, {60, 40});
  CHECK(share > 0.3);
  CHECK(share < 0.7);
  for (int angle = 0; angle < 360; ++angle) {
    CHECK(!is_white(at(picture, 100 + 30 * std::cos(angle * M_PI / 180),
                       120 + 20 * std::sin(angle * M_PI / 180))));
  }
  const ViewScene scene = scene_with(estimate);
  CHECK(state_words(scene.tracks[0], kPictureTime) == "coasting: predicted, not seen");
}

TEST_CASE("a lost puck is marked where it was last seen") {
  PuckEstimate estimate;
  estimate.state = TrackState::kLost;
  ViewScene scene = scene_with(estimate);
  scene.tracks[0].trail = {{kPictureTime - 400'000, Pixel{90, 70}},
                           {kPictureTime - 320'000, Pixel{100, 80}},
                           {kPictureTime - 2'000, std::nullopt}};
  CHECK(state_words(scene.tracks[0], kPictureTime) == "lost for 0.32 s");
  const cv::Mat picture = paint(scene);
  CHECK(bright_share(picture, {100, 80}, {8, 8}) > 0.2);
  CHECK(bright_share(picture, {200, 180}, {8, 8}) == 0);
  scene.tracks[0].estimate->left_image = Pixel{0, 100};
  CHECK(state_words(scene.tracks[0], kPictureTime) == "left the image");
}

TEST_CASE("truth, velocity and trail are drawn at their places") {
  PuckEstimate estimate = tracked_puck({100, 80});
  estimate.velocity = {2000, 0};
  ViewScene scene = scene_with(estimate);
  scene.truth = TruthRow{kPictureTime, {100, 180}, {60, 40}};
  for (int i = 20; i >= 0; --i) {
    scene.tracks[0].trail.push_back({kPictureTime - i * 10'000, Pixel{100, 80.0 + 5 * i}});
  }
  const cv::Mat picture = paint(scene);
  CHECK(is_pink(at(picture, 130, 180)));
  // The arrow ends 50 ms ahead.
  CHECK(is_white(at(picture, 180, 80)));
  CHECK(is_dark(at(picture, 210, 80)));
  const cv::Vec3b trail = at(picture, 100, 120);
  CHECK(trail[1] > trail[2] + 30);
  CHECK(*error_px(scene.tracks[0], scene.truth) == doctest::Approx(100));
  scene.truth->visible = 0.2;
  CHECK(!error_px(scene.tracks[0], scene.truth));
}

TEST_CASE("a light picture has dark marks on white") {
  PictureWishes wishes = bare_wishes();
  wishes.theme = PictureWishes::Theme::kLight;
  const cv::Mat picture = paint(scene_with(tracked_puck({100, 80})), wishes);
  CHECK(is_white(at(picture, 20, 20)));
  CHECK(is_dark(at(picture, 130, 80)));
}

TEST_CASE("wild numbers in an estimate draw nothing and break nothing") {
  for (const double wild : {std::nan(""), HUGE_VAL, -1e300, 1e9}) {
    PuckEstimate estimate = tracked_puck({wild, 10});
    estimate.velocity = {wild, wild};
    estimate.size = {wild, wild};
    estimate.covariance.fill(wild);
    estimate.region = {-2'000'000'000, 5, 10, 10};
    estimate.coasting = true;
    ViewScene scene = scene_with(estimate);
    scene.tracks[0].trail = {{kPictureTime, Pixel{wild, wild}}, {kPictureTime, Pixel{3, wild}}};
    PictureWishes wishes = bare_wishes();
    wishes.layers = {};
    wishes.side = 7;
    wishes.window_us = -5;
    CHECK(paint(scene, wishes).size() == cv::Size(640, 480));
    wishes.side = 0;
    CHECK(paint(scene, wishes).size() == cv::Size(640, 480));
  }
  PictureWishes tiny = bare_wishes();
  tiny.width_px = tiny.height_px = -1;
  CHECK(paint(empty_scene(), tiny).cols == PictureWishes::kLeastSide_px);
}

TEST_CASE("the heat map and the surface fill the picture") {
  ViewScene scene = empty_scene();
  scene.surface.resize(320, 240);
  std::fill(scene.surface.row(0), scene.surface.row(0) + 320 * 240, std::uint8_t{0});
  scene.surface(50, 60) = 255;
  PictureWishes wishes = bare_wishes();
  wishes.backdrop = PictureWishes::Backdrop::kSurface;
  CHECK(is_white(at(paint(scene, wishes), 50, 60)));
  CHECK(is_dark(at(paint(scene, wishes), 60, 60)));
  scene.heat = scene.surface;
  wishes.backdrop = PictureWishes::Backdrop::kHeatMap;
  CHECK(brightness(at(paint(scene, wishes), 50, 60)) > 400);
  CHECK(is_dark(at(paint(scene, wishes), 60, 60)));
}

TEST_CASE("a backdrop that the source has not filled leaves its place empty") {
  ViewScene scene = scene_with(tracked_puck({100, 80}));
  scene.events.reset({});
  for (const auto backdrop : {PictureWishes::Backdrop::kEvents, PictureWishes::Backdrop::kSurface,
                              PictureWishes::Backdrop::kHeatMap}) {
    PictureWishes wishes = bare_wishes();
    wishes.layers.close_up = true;
    wishes.backdrop = backdrop;
    CHECK(bright_share(paint(scene, wishes), {100, 80}, {60, 40}) > 0.98);
  }
}

TEST_CASE("the table shows the puck at its place, lying or upright") {
  ViewScene scene = empty_scene();
  scene.table.emplace();
  scene.table->validity = ViewTable::Validity::kTracked;
  scene.table->puck.state = {{scene.table->geometry.length_m / 2, 0}, {0, 0}};
  scene.table->mallet_y_m = 0.2;
  scene.table->path = {{0, {1.0, 0}}, {0.1, {0.9, 0.1}}, {0.2, {std::nan(""), 0}}};
  PictureWishes wishes = bare_wishes();
  wishes.view = PictureWishes::View::kTable;
  const auto whites = [&](const cv::Rect& part) {
    const cv::Mat picture = paint(scene, wishes);
    int count = 0;
    for (int y = part.y; y < part.y + part.height; ++y) {
      for (int x = part.x; x < part.x + part.width; ++x) {
        count += is_white(picture.at<cv::Vec3b>(y, x)) ? 1 : 0;
      }
    }
    return count;
  };
  CHECK(whites({300, 237, 40, 40}) > 10);
  // Half of the table nearer to the opponent: to the right.
  scene.table->puck.state.position.x_m *= 1.5;
  CHECK(whites({300, 237, 40, 40}) == 0);
  CHECK(whites({430, 237, 60, 40}) > 10);
  wishes.width_px = 300;
  CHECK(whites({130, 130, 40, 60}) > 10);
  scene.table.reset();
  scene.no_table = "no table";
  CHECK(paint(scene, wishes).cols == 300);
}

}  // namespace
}  // namespace puck
