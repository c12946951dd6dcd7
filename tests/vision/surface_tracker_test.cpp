#include "common/vision/surface_tracker.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/interfaces/event_pieces.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"
#include "tests/vision/puck_picture.h"

namespace puck {
namespace {

constexpr SensorSize kSmallSensor{160, 120};
constexpr PuckSizeModel kSmallSizeModel{25, 0, 0, 17, 0, 0};

// A pipeline's inputs.
struct Record {
  std::vector<std::vector<std::int64_t>> pieces;  // the times of each piece's events
  std::vector<SearchResult> results;
  int steps = 0;
};

// Requests single events or a region, and a search on demand.
class Recorder final : public TrackingPipeline {
 public:
  Recorder(Record& record, bool needs_events, std::int64_t period_us, const SearchRequest& search)
      : record_(record), needs_events_(needs_events), period_us_(period_us), search_(search) {}

  bool needs_events() const override { return needs_events_; }
  std::int64_t decision_period_us() const override { return period_us_; }
  void take(Timestamp start, std::span<const Event> events) override {
    std::vector<std::int64_t>& piece = record_.pieces.emplace_back();
    for (const Event& event : events) piece.push_back(start.us + event.offset_us);
  }
  Region region_needed() const override { return {0, 0, 20, 20}; }
  PuckEstimate step(const SurfaceSnapshot& snapshot) override {
    ++record_.steps;
    PuckEstimate estimate;
    estimate.newest_event = snapshot.newest_event;
    return estimate;
  }
  SearchRequest search_wanted() override { return std::exchange(search_, {}); }
  void take(const SearchResult& result) override { record_.results.push_back(result); }

 private:
  Record& record_;
  bool needs_events_;
  std::int64_t period_us_;
  SearchRequest search_;
};

SurfaceTracker tracker_with(Record& record, bool needs_events, std::int64_t period_us,
                            const SearchRequest& search, bool roi_only = false,
                            std::int64_t search_delay_us = 0) {
  PipelineParams params = default_params();  // so that recent pixels are recorded
  if (roi_only) params = correlation_params();
  if (roi_only) std::get<PuckPipelineParams>(params).roi_only = true;
  search_params(params).search_delay_us = search_delay_us;
  return SurfaceTracker(kSmallSensor, params, kSmallSizeModel,
                        std::make_unique<Recorder>(record, needs_events, period_us, search));
}

using Pieces = std::vector<std::vector<std::int64_t>>;

}  // namespace

TEST_CASE("events are divided at the multiples of the period, which end their pieces") {
  const std::vector<Event> events{{0, 0, 0, 0},  {0, 0, 0, 5},  {0, 0, 0, 10},
                                  {0, 0, 0, 10}, {0, 0, 0, 11}, {0, 0, 0, 20},
                                  {0, 0, 0, 21}, {0, 0, 0, 49}, {0, 0, 0, 1000}};
  const auto pieces_of = [&](std::int64_t start_us, std::int64_t period_us) {
    Pieces pieces;
    for_each_piece({start_us}, events, period_us, [&](std::span<const Event> piece) {
      std::vector<std::int64_t>& times = pieces.emplace_back();
      for (const Event& event : piece) times.push_back(start_us + event.offset_us);
    });
    return pieces;
  };
  CHECK(pieces_of(0, 10) == Pieces{{0}, {5, 10, 10}, {11, 20}, {21}, {49}, {1000}});
  CHECK(pieces_of(90, 100) == Pieces{{90, 95, 100, 100}, {101, 110, 111, 139}, {1090}});
  CHECK(pieces_of(0, 0).size() == 1);
}

TEST_CASE("a pipeline gets the events in pieces, and no empty piece") {
  Record record;
  SurfaceTracker tracker = tracker_with(record, true, 100, {});
  tracker.update(
      {{50},
       {{10, 10, 0, 20}, {29, 29, 1, 50}, {15, 15, 1, 60}, {15, 15, 1, 151}, {40, 40, 1, 400}}});
  CHECK(record.pieces == Pieces{{70, 100}, {110}, {201}, {450}});
  CHECK(tracker.estimate().newest_event == Timestamp{450});
  CHECK(record.steps == 1);  // one more only after a search
  CHECK(record.results.empty());
}

TEST_CASE("a search is made at once, on the surface of its request") {
  const Pixel puck{80, 60};
  const std::vector<Event> ring =
      test::contour_events(kSmallSensor, puck, kSmallSizeModel.at(puck), 150);
  for (const bool takes_events : {false, true}) {
    CAPTURE(takes_events);
    Record record;
    const Region all = Region::all_of(kSmallSensor);
    SurfaceTracker tracker = tracker_with(record, takes_events, 1000, {.region = all});
    tracker.update({{3000}, ring});
    tracker.update({{3500}, {{1, 1, 0, 0}}});
    tracker.estimate();
    REQUIRE(record.results.size() == 1);
    CHECK(record.results[0].time == Timestamp{takes_events ? 3000 : 3500});
    CHECK(record.results[0].request == SearchRequest{all});
    REQUIRE_FALSE(record.results[0].candidates.empty());
    const SearchCandidate best = record.results[0].candidates.front();
    CHECK(std::abs(best.position.x - puck.x) <= 1);
    CHECK(std::abs(best.position.y - puck.y) <= 1);
    CHECK(best.score > 0.5);
  }
}

TEST_CASE("a search of recent pixels does not see a puck without events for 40 ms") {
  const Pixel puck{80, 60};
  for (const bool fresh_only : {false, true}) {
    CAPTURE(fresh_only);
    Record record;
    SurfaceTracker tracker = tracker_with(
        record, false, 0, {.region = Region::all_of(kSmallSensor), .fresh_only = fresh_only});
    tracker.update({{0}, test::contour_events(kSmallSensor, puck, kSmallSizeModel.at(puck), 150)});
    tracker.update({{40'000}, {{3, 3, 1, 0}}});
    tracker.estimate();
    REQUIRE(record.results.size() == 1);
    const std::vector<SearchCandidate>& found = record.results[0].candidates;
    CHECK(std::any_of(found.begin(), found.end(), [&](const SearchCandidate& candidate) {
            return distance_px(candidate.position, puck) < 3;
          }) != fresh_only);
  }
}

TEST_CASE("with a delay the result of a search comes that much after its snapshot, not earlier") {
  const Region all = Region::all_of(kSmallSensor);
  Record record;
  SurfaceTracker tracker = tracker_with(record, true, 1000, {.region = all}, false, 5'000);
  tracker.update({{3000}, {{1, 1, 0, 0}}});
  tracker.update({{7999}, {{1, 1, 0, 0}}});
  tracker.estimate();
  CHECK(record.results.empty());
  tracker.update({{8000}, {{1, 1, 0, 0}}});
  REQUIRE(record.results.size() == 1);
  CHECK(record.results[0].time == Timestamp{3000});
}

TEST_CASE("a tracker that keeps only its region of the surface finds nothing elsewhere") {
  const Pixel puck{80, 60};
  const std::vector<Event> ring =
      test::contour_events(kSmallSensor, puck, kSmallSizeModel.at(puck), 150);
  for (const bool roi_only : {false, true}) {
    CAPTURE(roi_only);
    Record record;
    const Region all = Region::all_of(kSmallSensor);
    SurfaceTracker tracker = tracker_with(record, false, 0, {.region = all}, roi_only);
    tracker.update({{3000}, ring});
    tracker.estimate();
    REQUIRE(record.results.size() == 1);
    CHECK(record.results[0].candidates.empty() == roi_only);
  }
}

}  // namespace puck
