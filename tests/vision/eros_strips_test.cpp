#include "common/vision/surface/eros_strips.h"

#include <algorithm>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/geometry/image.h"
#include "tests/support/simd_targets.h"

namespace puck {
namespace {

// Repeated single pixels, clusters, corners and borders among random events.
std::vector<Event> hard_events(SensorSize size, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  std::vector<Event> events;
  int x = 0;
  int y = 0;
  while (static_cast<int>(events.size()) < count) {
    switch (below(4)) {
      case 0:
        x = below(size.width);
        y = below(size.height);
        break;
      case 1:
        x = std::clamp(x + below(5) - 2, 0, size.width - 1);
        y = std::clamp(y + below(5) - 2, 0, size.height - 1);
        break;
      case 2:
        x = below(2) * (size.width - 1);
        break;
      default:
        y = below(2) * (size.height - 1);
    }
    events.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y & 0x7fff),
                      static_cast<std::uint16_t>(below(2) & 1), 0});
  }
  return events;
}

// The specification of ErosStrips::apply, pixel by pixel.
Image<std::uint8_t> applied_plainly(SensorSize size, int half_width,
                                    const std::vector<Event>& events) {
  Image<std::uint8_t> counts(size.width, size.height);
  for (const Event& event : events) {
    const int right = std::min(event.x + half_width, size.width - 1);
    const int bottom = std::min(event.y + half_width, size.height - 1);
    for (int y = std::max(event.y - half_width, 0); y <= bottom; ++y) {
      for (int x = std::max(event.x - half_width, 0); x <= right; ++x) {
        if (counts(x, y) > 0) --counts(x, y);
      }
    }
    counts(event.x, event.y) = 255;
  }
  return counts;
}

bool same_everywhere(const ErosStrips& strips, const Image<std::uint8_t>& counts) {
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      if (strips.at(x, y) != counts(x, y)) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE(
    "every instruction set gives the bytes of the pixel-by-pixel form, for every half width") {
  int targets = 0;
  with_each_simd_target([&](const std::string& name) {
    CAPTURE(name);
    ++targets;
    for (const SensorSize size : {SensorSize{1, 1}, SensorSize{7, 3}, SensorSize{83, 61}}) {
      for (int half_width = 1; half_width <= ErosStrips::kMaxHalfWidth; ++half_width) {
        CAPTURE(half_width);
        const auto events = hard_events(size, 4000, static_cast<unsigned>(half_width));
        ErosStrips fast(size, half_width);
        fast.apply(events);
        REQUIRE(same_everywhere(fast, applied_plainly(size, half_width, events)));
      }
    }
  });
  CHECK(targets >= 2);
}

TEST_CASE("the largest sensor holds events in all of its corners") {
  const SensorSize size{SensorSize::kMax, SensorSize::kMax};
  ErosStrips strips(size, 8);
  const std::vector<Event> corners{
      {0, 0, 1, 0}, {2047, 0, 1, 0}, {0, 2047, 0, 0}, {2047, 2047, 0, 0}};
  strips.apply(corners);
  for (const Event& event : corners) CHECK(strips.at(event.x, event.y) == 255);
  CHECK(strips.at(1, 1) == 0);
}

TEST_CASE("a cleared part is dark and its neighbours are unchanged") {
  const SensorSize size{40, 30};
  ErosStrips strips(size, 5);
  ErosStrips before(size, 5);
  const auto events = hard_events(size, 3000, 9);
  strips.apply(events);
  before.apply(events);
  const Region cleared{3, 7, 21, 11};
  strips.clear(cleared);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      REQUIRE(strips.at(x, y) == (cleared.contains(x, y) ? 0 : before.at(x, y)));
    }
  }
}

}  // namespace puck
