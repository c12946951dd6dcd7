#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/surface/surface.h"

namespace puck {
namespace {

Event event_at(int x, int y) {
  return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), 1, 0};
}

std::vector<Event> random_events(SensorSize size, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    events.push_back(event_at(static_cast<int>(random() % static_cast<unsigned>(size.width)),
                              static_cast<int>(random() % static_cast<unsigned>(size.height))));
  }
  return events;
}

SurfaceSnapshot whole(Surface& surface) {
  SurfaceSnapshot snapshot;
  surface.snapshot(Region::all_of(surface.size()), snapshot);
  return snapshot;
}

// Algorithm 1 word for word, in double precision.
Image<double> textbook_eros(SensorSize size, const ErosParams& params,
                            const std::vector<Event>& events) {
  Image<double> surface(size.width, size.height);
  for (const Event& event : events) {
    for (int y = event.y - params.half_width_px; y <= event.y + params.half_width_px; ++y) {
      for (int x = event.x - params.half_width_px; x <= event.x + params.half_width_px; ++x) {
        if (size.contains(x, y)) surface(x, y) *= params.decay;
      }
    }
    surface(event.x, event.y) = 255;
  }
  return surface;
}

}  // namespace

TEST_CASE("EROS decays neighbours, not pixels beyond its half width") {
  Surface surface({32, 32}, ErosParams{2, 0.5, ErosRounding::kNearest});
  surface.update(event_at(10, 10));
  surface.update(event_at(16, 10));
  surface.update(event_at(12, 10));
  const SurfaceSnapshot snapshot = whole(surface);
  CHECK(snapshot.grey(12, 10) == 255);
  CHECK(snapshot.grey(10, 10) == 128);  // two pixels away: decayed once
  CHECK(snapshot.grey(16, 10) == 255);  // four pixels away: untouched
  CHECK(snapshot.grey(11, 10) == 0);    // never fired
}

TEST_CASE("EROS equals the textbook's multiplication for every half width, even at the borders") {
  const SensorSize size{41, 23};
  for (int half_width = 1; half_width <= 8; ++half_width) {
    CAPTURE(half_width);
    const ErosParams params{half_width, std::pow(0.3, 1.0 / half_width), ErosRounding::kNearest};
    const auto events = random_events(size, 3000, 7u + static_cast<unsigned>(half_width));
    Surface surface(size, params);
    surface.update(events);
    const SurfaceSnapshot snapshot = whole(surface);
    const Image<double> expected = textbook_eros(size, params, events);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        REQUIRE(std::abs(snapshot.grey(x, y) - expected(x, y)) <= 0.5 + 1e-9);
      }
    }
  }
}

TEST_CASE("a batch of events and single events give the same surface") {
  const SensorSize size{64, 48};
  const auto events = random_events(size, 5000, 3);
  Surface batch(size, {});
  Surface single(size, {});
  batch.update(events);
  for (const Event& event : events) single.update(event);
  const SurfaceSnapshot a = whole(batch);
  const SurfaceSnapshot b = whole(single);
  CHECK(std::equal(a.grey.row(0), a.grey.row(0) + 64 * 48, b.grey.row(0)));
  CHECK(a.events_applied == 5000);
  CHECK(b.events_applied == 5000);
}

TEST_CASE("truncating after every decay gives the authors' sequence of grey values") {
  const std::vector<int> expected{255, 183, 131, 94, 67, 48, 34, 24, 17, 12, 8, 5, 3, 2, 1, 0};
  Surface surface({16, 16}, ErosParams{3, std::pow(0.1, 1.0 / 7), ErosRounding::kTruncateEachStep});
  surface.update(event_at(8, 8));
  for (const int value : expected) {
    CHECK(whole(surface).grey(8, 8) == value);
    surface.update(event_at(9, 8));
  }
}

TEST_CASE("a pixel is dark after 255 events around it") {
  Surface surface({16, 16}, ErosParams{3, 0.9999, ErosRounding::kNearest});
  surface.update(event_at(8, 8));
  for (int i = 0; i < 254; ++i) surface.update(event_at(9, 8));
  CHECK(whole(surface).grey(8, 8) == 249);
  surface.update(event_at(9, 8));
  CHECK(whole(surface).grey(8, 8) == 0);
}

TEST_CASE("a snapshot is cut to the sensor and has the newest event and the number of events") {
  Surface surface({32, 24}, {});
  EventPacket packet;
  packet.start = {1000};
  packet.events = {{31, 23, 1, 0}, {30, 23, 0, 7}};
  surface.update(packet);
  SurfaceSnapshot snapshot;
  surface.snapshot({28, 20, 100, 100}, snapshot);
  CHECK(snapshot.region == Region{28, 20, 4, 4});
  CHECK(snapshot.newest_event == Timestamp{1007});
  CHECK(snapshot.events_applied == 2);
  CHECK(snapshot.grey(2, 3) == 255);
  surface.snapshot({40, 20, 5, 5}, snapshot);
  CHECK(snapshot.region.empty());
}

TEST_CASE("a surface that keeps a region equals a whole one there, and entering pixels are dark") {
  const SensorSize size{90, 70};
  const ErosParams params{4, 0.8, ErosRounding::kNearest};
  const auto events = random_events(size, 40'000, 11);
  Surface whole_one(size, params);
  Surface part(size, params);
  part.update(std::span(events).first(10'000));
  whole_one.update(std::span(events).first(10'000));

  const auto same_in = [&](const Region& region) {
    SurfaceSnapshot a;
    SurfaceSnapshot b;
    part.snapshot(region, a);
    whole_one.snapshot(region, b);
    return a.events_applied == b.events_applied && a.grey.view().width() == region.width &&
           std::equal(a.grey.row(0), a.grey.row(0) + region.width * region.height, b.grey.row(0));
  };
  const auto is_dark = [&](const Region& region) {
    SurfaceSnapshot a;
    part.snapshot(region, a);
    return std::all_of(a.grey.row(0), a.grey.row(0) + region.width * region.height,
                       [](std::uint8_t grey) { return grey == 0; });
  };
  CHECK(same_in({0, 0, 90, 70}));

  const Region first{20, 15, 31, 22};
  part.keep_only(first);
  CHECK(same_in(first));
  CHECK(is_dark({0, 0, 90, 15}));
  CHECK(is_dark({0, 15, 20, 55}));
  part.update(std::span(events).subspan(10'000, 10'000));
  whole_one.update(std::span(events).subspan(10'000, 10'000));
  CHECK(same_in(first));
  CHECK(is_dark({0, 0, 90, 11}));  // outside the windows' reach

  // It moves to the lower right, and grows: the common part is unchanged.
  const Region second{23, 11, 34, 30};
  part.keep_only(second);
  CHECK(same_in(first.intersect(second)));
  CHECK(is_dark({23, 11, 34, 4}));
  CHECK(is_dark({23, 37, 34, 4}));
  CHECK(is_dark({51, 11, 6, 30}));
  CHECK(is_dark({0, 0, 23, 70}));
  // Every pixel of it fires many times, so that no earlier value remains.
  part.update(std::span(events).subspan(20'000));
  whole_one.update(std::span(events).subspan(20'000));
  CHECK(same_in(second));

  part.keep_only({0, 0, 90, 70});
  CHECK(same_in(second));
  CHECK(is_dark({0, 0, 90, 11}));
  CHECK(is_dark({0, 41, 90, 29}));
  CHECK(is_dark({0, 0, 23, 70}));
  CHECK(is_dark({57, 0, 33, 70}));

  part.keep_only({});
  part.update(std::span(events).first(100));
  CHECK(is_dark({12, 12, 78, 58}));
  CHECK(part.events_applied() == 40'100);
}

TEST_CASE("an exposure shows the surface of its time, even if developed later") {
  const SensorSize size{64, 48};
  const auto events = random_events(size, 5000, 3);
  Surface surface(size, {});
  surface.update(events);
  const SurfaceSnapshot then = whole(surface);
  SurfaceExposure upper;
  SurfaceExposure lower;
  surface.take({0, 0, 64, 17}, upper);
  surface.take({0, 17, 64, 31}, lower);
  surface.update(events);
  SurfaceSnapshot joined;
  joined.region = Region::all_of(size);
  joined.grey.resize(64, 48);
  surface.develop_part(upper, joined);
  surface.develop_part(lower, joined);
  CHECK(std::equal(then.grey.row(0), then.grey.row(0) + 64 * 48, joined.grey.row(0)));
  CHECK(joined.events_applied == 5000);
}

TEST_CASE("EROS refuses parameters out of range and names the key") {
  CHECK_THROWS_WITH_AS(Surface({640, 480}, ErosParams{0, 0.5}),
                       "tracker.half_width_px must be 1 to 8, got 0", std::invalid_argument);
  CHECK_THROWS_AS(Surface({640, 480}, ErosParams{9, 0.5}), std::invalid_argument);
  CHECK_THROWS_AS(Surface({640, 480}, ErosParams{3, 1.0}), std::invalid_argument);
  CHECK_THROWS_AS(Surface({640, 480}, ErosParams{3, std::nan("")}), std::invalid_argument);
  CHECK_THROWS_AS(Surface({0, 480}, ErosParams{3, 0.5}), std::invalid_argument);
  CHECK_THROWS_AS(Surface({640, 4096}, ErosParams{3, 0.5}), std::invalid_argument);
}

}  // namespace puck
