#include "common/vision/paper/puck_search.h"

#include <doctest/doctest.h>

#include "common/vision/contour/puck_contour.h"
#include "common/vision/presets.h"
#include "common/vision/surface/surface.h"
#include "tests/vision/puck_picture.h"
#include "tests/vision/test_sensor.h"

namespace puck {
namespace {

using test::kSensor;
using test::kSizeModel;

PuckSearch search_of(Preset preset) {
  return PuckSearch(kSensor, search_params(preset_params(preset)), kSizeModel);
}

SearchResult search_for_puck_at(Pixel truth, const Region& where, Preset preset) {
  Surface surface(kSensor, search_params(preset_params(preset)).eros);
  surface.update(
      EventPacket{{7000}, test::contour_events(kSensor, truth, kSizeModel.at(truth), 200)});
  PuckSearch search = search_of(preset);
  SurfaceSnapshot snapshot;
  surface.snapshot(search.snapshot_region(where), snapshot);
  return search.search(snapshot, {where});
}

}  // namespace

TEST_CASE("a search finds the puck anywhere, and gives the same on a part of the surface") {
  for (const Pixel truth : {Pixel{60, 100}, {320, 190}, {560, 400}}) {
    CAPTURE(truth.x);
    const SearchResult everywhere =
        search_for_puck_at(truth, Region::all_of(kSensor), Preset::kCorrelation);
    REQUIRE_FALSE(everywhere.candidates.empty());
    const SearchCandidate best = everywhere.candidates.front();
    CHECK(std::hypot(best.position.x - truth.x, best.position.y - truth.y) <= 1.5);
    CHECK(everywhere.time == Timestamp{7000});

    const SearchResult near =
        search_for_puck_at(truth, Region::around(truth, 11, 11), Preset::kCorrelation);
    REQUIRE_FALSE(near.candidates.empty());
    CHECK(near.candidates.front().position == best.position);
    CHECK(near.candidates.front().score == best.score);
  }
}

TEST_CASE("a puck with another side wall than calibrated is found by a search for it") {
  for (const double calibrated : {0.0, 0.165}) {
    CAPTURE(calibrated);
    HypothesesParams params = default_params();
    params.contour.wall_share = calibrated;
    const PuckContour contour(kSensor, kSizeModel, params.contour);
    PuckSearch search(kSensor, params, kSizeModel);
    for (const Pixel truth : {Pixel{200, 60}, {320, 190}, {330, 400}}) {
      CAPTURE(truth.x);
      const ContourRing ring = contour.ring_at(truth, contour.other_wall_share());
      Surface surface(kSensor, params.eros);
      surface.update(EventPacket{{7000},
                                 test::contour_events(kSensor, {truth.x, truth.y - ring.rise},
                                                      {2 * ring.semi_x, 2 * ring.semi_y}, 200)});
      SurfaceSnapshot snapshot;
      surface.snapshot(Region::all_of(kSensor), snapshot);
      const auto best_of = [&](bool other_wall) {
        const SearchRequest request{Region::all_of(kSensor), other_wall};
        const SearchResult result = search.search(snapshot, request);
        CHECK(result.request == request);
        REQUIRE_FALSE(result.candidates.empty());
        return result.candidates.front();
      };
      const SearchCandidate best = best_of(true);
      CHECK(std::hypot(best.position.x - truth.x, best.position.y - truth.y) < 1);
      CHECK(best.score > best_of(false).score);
    }
  }
}

TEST_CASE("the authors' detection returns the best place only") {
  const Region detection{60, 150, 500, 80};
  const SearchResult found = search_for_puck_at({300, 190}, detection, Preset::kReference);
  REQUIRE(found.candidates.size() == 1);
  CHECK(std::abs(found.candidates[0].position.x - 300) <= 2);
  CHECK(found.candidates[0].score <= 1);
}

TEST_CASE("the snapshot for a search stays inside the sensor and covers the kernels' reach") {
  const PuckSearch search = search_of(Preset::kCorrelation);
  const Region all = Region::all_of(kSensor);
  CHECK(search.snapshot_region(all) == all);
  CHECK(search.snapshot_region({}).empty());
  const Region part = search.snapshot_region({300, 200, 20, 10});
  CHECK(part.intersect(all) == part);
  // The puck is 30×21 px there; its canvas is 10 px larger, and the blur reaches 2 px.
  CHECK(part.x <= 300 - 22);
  CHECK(part.bottom() >= 210 + 17);
}

}  // namespace puck
