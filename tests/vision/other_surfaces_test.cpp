// TOS, SITS and SAE: each rule on a few events by hand, and correlation on each.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"
#include "common/vision/surface/surface.h"
#include "common/vision/surface_tracker.h"
#include "tests/vision/puck_picture.h"
#include "tests/vision/test_sensor.h"

namespace puck {
namespace {

constexpr SensorSize kFew{32, 24};

Event event_of(int x, int y, std::uint32_t offset_us = 0) {
  return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), 1, offset_us};
}

std::vector<Event> events_anywhere(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    events.push_back(event_of(static_cast<int>(random() % kFew.width),
                              static_cast<int>(random() % kFew.height)));
  }
  return events;
}

Image<std::uint8_t> picture_of(Surface& surface) {
  SurfaceSnapshot snapshot;
  surface.snapshot(Region::all_of(surface.size()), snapshot);
  return snapshot.grey;
}

// The papers' rules word for word, without a border, pixel by pixel.
Image<int> textbook_tos(const TosParams& params, const std::vector<Event>& events) {
  Image<int> tos(kFew.width, kFew.height);
  for (const Event& event : events) {
    for (int y = event.y - params.half_width_px; y <= event.y + params.half_width_px; ++y) {
      for (int x = event.x - params.half_width_px; x <= event.x + params.half_width_px; ++x) {
        if (!kFew.contains(x, y)) continue;
        --tos(x, y);
        if (tos(x, y) < 255 - params.depth) tos(x, y) = 0;
      }
    }
    tos(event.x, event.y) = 255;
  }
  return tos;
}

Image<int> textbook_sits(const SitsParams& params, const std::vector<Event>& events) {
  Image<int> sits(kFew.width, kFew.height);
  const int r = params.radius_px;
  for (const Event& event : events) {
    const int own = sits(event.x, event.y);
    for (int y = event.y - r; y <= event.y + r; ++y) {
      for (int x = event.x - r; x <= event.x + r; ++x) {
        if (!kFew.contains(x, y)) continue;
        if (sits(x, y) >= own && sits(x, y) > 0) --sits(x, y);
      }
    }
    sits(event.x, event.y) = (2 * r + 1) * (2 * r + 1);
  }
  return sits;
}

template <typename Expected>
void check_picture(Surface& surface, Expected expected) {
  const Image<std::uint8_t> picture = picture_of(surface);
  for (int y = 0; y < kFew.height; ++y) {
    for (int x = 0; x < kFew.width; ++x) REQUIRE(picture(x, y) == expected(x, y));
  }
}

}  // namespace

TEST_CASE("TOS subtracts 1 around an event, and a pixel below 255 - 2k is dark") {
  Surface surface(kFew, TosParams{});
  surface.update(event_of(10, 10));
  surface.update(event_of(13, 10));
  surface.update(event_of(13, 10));
  CHECK(picture_of(surface)(10, 10) == 253);  // three pixels away: twice
  CHECK(picture_of(surface)(13, 10) == 255);
  surface.update(event_of(14, 10));
  CHECK(picture_of(surface)(10, 10) == 253);  // four pixels away: beyond the window of 7
  for (int i = 0; i < 12; ++i) surface.update(event_of(11, 10));
  CHECK(picture_of(surface)(10, 10) == 241);
  surface.update(event_of(11, 10));
  CHECK(picture_of(surface)(10, 10) == 0);
}

TEST_CASE("SITS subtracts 1 from the neighbours that are not less than the event's pixel") {
  Surface surface(kFew, SitsParams{1});  // from 9 down, shown as 255 · value / 9
  surface.update(event_of(10, 10));
  CHECK(picture_of(surface)(10, 10) == 255);
  surface.update(event_of(11, 10));  // it was 0, so its neighbour's 9 is not less
  CHECK(picture_of(surface)(10, 10) == 227);
  CHECK(picture_of(surface)(11, 10) == 255);
  surface.update(event_of(11, 10));  // it was 9: its neighbour's 8 is less
  CHECK(picture_of(surface)(10, 10) == 227);
  surface.update(event_of(10, 10));  // it was 8: its neighbour's 9 is not less
  CHECK(picture_of(surface)(10, 10) == 255);
  CHECK(picture_of(surface)(11, 10) == 227);
  surface.update(event_of(12, 10));
  CHECK(picture_of(surface)(10, 10) == 255);  // two pixels away
  CHECK(picture_of(surface)(11, 10) == 198);
}

TEST_CASE("SAE fades to 1/e in its time constant and is dark after six and a half") {
  Surface surface(kFew, SaeParams{5'000});
  surface.update({{0}, {event_of(10, 10), event_of(20, 10, 5'000)}});
  CHECK(picture_of(surface)(20, 10) == 255);
  CHECK(std::abs(picture_of(surface)(10, 10) - 255 / std::exp(1.0)) <= 3);
  CHECK(picture_of(surface)(15, 10) == 0);  // never fired
  surface.update({{32'500}, {event_of(21, 10)}});
  CHECK(picture_of(surface)(10, 10) == 0);
  CHECK(picture_of(surface)(20, 10) == 1);
  surface.update({{60'000'000}, {event_of(10, 10)}});
  CHECK(picture_of(surface)(10, 10) == 255);
  CHECK(picture_of(surface)(20, 10) == 0);
}

TEST_CASE("TOS and SITS equal their papers' rules for every window, even at the borders") {
  const std::vector<Event> events = events_anywhere(3000, 5);
  for (int half_width = 1; half_width <= 8; ++half_width) {
    CAPTURE(half_width);
    const TosParams params{half_width, 4 * half_width + 2};
    Surface surface(kFew, params);
    surface.update(events);
    const Image<int> expected = textbook_tos(params, events);
    check_picture(surface, [&](int x, int y) { return std::max(expected(x, y), 0); });
  }
  for (int radius = 1; radius <= 7; ++radius) {
    CAPTURE(radius);
    const SitsParams params{radius};
    Surface surface(kFew, params);
    surface.update(events);
    const Image<int> expected = textbook_sits(params, events);
    const double highest = (2 * radius + 1) * (2 * radius + 1);
    check_picture(surface,
                  [&](int x, int y) { return std::lround(255 * expected(x, y) / highest); });
  }
}

TEST_CASE("a part of any surface is that part of the whole") {
  const std::vector<Event> events = events_anywhere(400, 6);
  for (const SurfaceParams& params : {SurfaceParams(ErosParams{}), SurfaceParams(TosParams{}),
                                      SurfaceParams(SitsParams{}), SurfaceParams(SaeParams{})}) {
    CAPTURE(params.index());
    Surface surface(kFew, params);
    surface.update(Timestamp{5}, events);
    const Image<std::uint8_t> all = picture_of(surface);
    SurfaceSnapshot part;
    surface.snapshot({20, 11, 100, 100}, part);
    REQUIRE(part.region == Region{20, 11, 12, 13});
    CHECK(part.events_applied == 400);
    int bright = 0;
    for (int y = 0; y < 13; ++y) {
      for (int x = 0; x < 12; ++x) {
        REQUIRE(part.grey(x, y) == all(20 + x, 11 + y));
        bright += part.grey(x, y) > 0 ? 1 : 0;
      }
    }
    CHECK(bright > 0);
    surface.snapshot({40, 11, 5, 5}, part);
    CHECK(part.region.empty());
  }
}

TEST_CASE("any surface that keeps a region is up to date there and dark elsewhere") {
  const std::vector<Event> events = events_anywhere(4000, 7);
  for (const SurfaceParams& params :
       {SurfaceParams(TosParams{1, 6}), SurfaceParams(SitsParams{1}), SurfaceParams(SaeParams{})}) {
    CAPTURE(params.index());
    Surface whole(kFew, params);
    Surface part(kFew, params);
    whole.update(Timestamp{5}, std::span(events).first(2000));
    part.update(Timestamp{5}, std::span(events).first(2000));
    part.keep_only({8, 6, 16, 12});
    CHECK(picture_of(part)(7, 8) == 0);
    CHECK(picture_of(part)(24, 17) == 0);
    CHECK(picture_of(part)(8, 6) == picture_of(whole)(8, 6));
    whole.update(Timestamp{5}, std::span(events).subspan(2000));
    part.update(Timestamp{5}, std::span(events).subspan(2000));
    CHECK(picture_of(part)(3, 3) == 0);
    // Not at the border, where SITS may differ.
    for (int y = 9; y < 15; ++y) {
      for (int x = 11; x < 21; ++x) REQUIRE(picture_of(part)(x, y) == picture_of(whole)(x, y));
    }
  }
}

TEST_CASE("surfaces refuse settings out of range and name them") {
  CHECK_THROWS_WITH_AS(Surface(kFew, TosParams{.half_width_px = 9}),
                       "tos.half_width_px must be 1 to 8, got 9", std::invalid_argument);
  CHECK_THROWS_AS(Surface(kFew, TosParams{.depth = 255}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(Surface(kFew, SitsParams{8}), "sits.radius_px must be 1 to 7, got 8",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Surface(kFew, SaeParams{99}),
                       "sae.time_constant_us must be 100 to 1000000, got 99",
                       std::invalid_argument);
}

TEST_CASE("surfaces are found by their names") {
  for (const SurfaceKind kind :
       {SurfaceKind::kEros, SurfaceKind::kTos, SurfaceKind::kSits, SurfaceKind::kSae}) {
    CHECK(surface_kind_from(to_string(kind)) == kind);
  }
  CHECK_FALSE(surface_kind_from("scarf").has_value());
}

TEST_CASE("correlation tracks a moving puck on every surface") {
  for (const SurfaceKind kind :
       {SurfaceKind::kEros, SurfaceKind::kTos, SurfaceKind::kSits, SurfaceKind::kSae}) {
    CAPTURE(std::string(to_string(kind)));
    PuckPipelineParams params = correlation_params();
    params.surface = kind;
    SurfaceTracker tracker(test::kSensor, params, test::kSizeModel);
    PuckEstimate estimate;
    Pixel centre{250, 180};
    for (int ms = 1; ms <= 150; ++ms) {
      centre = {250 + 0.8 * ms, 180 + 0.3 * ms};
      tracker.update(
          {{1000 * ms},
           test::contour_events(test::kSensor, centre, test::kSizeModel.at(centre), 150)});
      estimate = tracker.estimate();
    }
    REQUIRE(estimate.state == TrackState::kTracking);
    // SITS leaves a trail at half brightness.
    CHECK(distance_px(*estimate.position, centre) < (kind == SurfaceKind::kSits ? 2 : 1));
  }
}

TEST_CASE("preset default refuses the other surfaces") {
  HypothesesParams params = default_params();
  params.surface = SurfaceKind::kTos;
  CHECK_THROWS_AS(SurfaceTracker(test::kSensor, params, test::kSizeModel), std::invalid_argument);
}

}  // namespace puck
