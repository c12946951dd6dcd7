#include "common/runtime/search_worker.h"

#include <cmath>
#include <thread>

#include <doctest/doctest.h>

#include "common/vision/paper/paper_presets.h"
#include "common/vision/paper/puck_search.h"
#include "tests/runtime/tracking_fixtures.h"
#include "tests/vision/puck_picture.h"

namespace puck {
namespace {

using test::kSizeModel;

PuckSearch search_for(SensorSize sensor) {
  return PuckSearch(sensor, correlation_params(), kSizeModel);
}

SearchResult result_of(SearchWorker& worker, SharedSurface& surface) {
  while (worker.is_copying()) worker.copy_more(surface);
  const SearchResult* result = nullptr;
  while (result == nullptr) {
    std::this_thread::yield();
    result = worker.poll();
  }
  return *result;
}

}  // namespace

TEST_CASE("a worker finds the same as an immediate search, near and far, repeatedly") {
  constexpr SensorSize kSensor{320, 240};
  const ErosParams eros = correlation_params().eros;
  SharedSurface shared(kSensor, eros);
  Surface alone(kSensor, eros);
  SearchWorker worker(search_for(kSensor));
  PuckSearch at_once = search_for(kSensor);
  for (int i = 1; i <= 5; ++i) {
    const Pixel puck{30.0 + 15 * i, 60};
    const EventPacket packet{{i * 1000},
                             test::contour_events(kSensor, puck, kSizeModel.at(puck), 150)};
    shared.update(packet, {});
    alone.update(packet);
    const Region where = i % 2 == 0 ? Region::all_of(kSensor) : Region::around(puck, 31, 21);

    REQUIRE(worker.is_idle());
    const SearchRequest request{where, i % 3 == 0};
    worker.begin(request);
    CHECK(worker.poll() == nullptr);
    const SearchResult found = result_of(worker, shared);

    SurfaceSnapshot snapshot;
    alone.snapshot(at_once.snapshot_region(where), snapshot);
    const SearchResult expected = at_once.search(snapshot, request);
    CHECK(found.time == Timestamp{i * 1000});
    CHECK(found.request == request);
    REQUIRE(found.candidates.size() == expected.candidates.size());
    REQUIRE_FALSE(found.candidates.empty());
    CHECK(found.candidates[0].position == expected.candidates[0].position);
    CHECK(found.candidates[0].score == expected.candidates[0].score);
  }
}

TEST_CASE("a small search is made at once, urgent or not, and known to be small") {
  constexpr SensorSize kSensor{320, 240};
  SharedSurface shared(kSensor, correlation_params().eros);
  SearchWorker worker(search_for(kSensor));
  const SearchRequest near{Region::around({160, 120}, 41, 41)};
  REQUIRE(worker.is_small(near));
  CHECK_FALSE(worker.is_small({Region::all_of(kSensor)}));
  worker.begin(near);
  while (worker.is_copying()) worker.copy_more(shared);
  CHECK(worker.poll() != nullptr);
}

TEST_CASE("a worker limited to recent pixels does not see a puck of 40 ms ago") {
  constexpr SensorSize kSensor{320, 240};
  SharedSurface shared(kSensor, correlation_params().eros);
  SearchWorker worker(search_for(kSensor));
  const Pixel puck{150, 60};
  shared.update({{0}, test::contour_events(kSensor, puck, kSizeModel.at(puck), 150)}, {});
  shared.update({{40'000}, {{3, 3, 1, 0}}}, {});
  for (const bool fresh_only : {false, true}) {
    CAPTURE(fresh_only);
    worker.begin({.region = Region::around(puck, 41, 41), .fresh_only = fresh_only});
    CHECK(result_of(worker, shared).candidates.empty() == fresh_only);
  }
}

TEST_CASE("a large surface is copied a few rows at a time") {
  constexpr SensorSize kSensor{1000, 400};
  SharedSurface shared(kSensor, {});
  shared.update({{7}, {{990, 390, 1, 0}}}, {});
  SearchWorker worker(search_for(kSensor));
  worker.begin({Region::all_of(kSensor)});
  int copies = 0;
  while (worker.is_copying()) {
    worker.copy_more(shared);
    ++copies;
  }
  CHECK(copies >= 5);
  CHECK(result_of(worker, shared).candidates.empty());
}

TEST_CASE("a worker ends during a search, a copy, or a wait") {
  constexpr SensorSize kSensor{320, 240};
  SharedSurface shared(kSensor, {});
  const SearchWorker idle(search_for(kSensor));
  CHECK(idle.is_idle());
  SearchWorker copying(search_for(kSensor));
  copying.begin({Region::all_of(kSensor)});
  CHECK(copying.is_copying());
  SearchWorker searching(search_for(kSensor));
  searching.begin({Region::all_of(kSensor)});
  while (searching.is_copying()) searching.copy_more(shared);
  CHECK_FALSE(searching.is_idle());
}

}  // namespace puck
