#include "tools/view/recording/recording_source.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/contains.h"
#include "tests/support/wait_until.h"
#include "tests/view/disc_recording.h"

namespace puck {
namespace {

using Action = ViewControl::Action;
using Activity = ViewPlayback::Activity;
using test::DiscRecording;

std::unique_ptr<RecordingSource> source_of(const DiscRecording& disc, const std::string& tracker,
                                           bool plays = false) {
  RecordingOptions options;
  options.recording = disc.path();
  return std::make_unique<RecordingSource>(std::make_unique<OpenedRecording>(options),
                                           std::array<std::string, 2>{tracker, kNoTracker}, plays);
}

ViewState state_of(ViewSource& source) { return source.state({-1}, -1); }

bool comes_to(ViewSource& source, Activity activity) {
  return wait_until([&] { return state_of(source).playback->activity == activity; });
}

std::string order(ViewSource& source, Action action, double value = 0, const std::string& name = "",
                  int side = 0) {
  return source.control({action, value, side, name});
}

TEST_CASE("a recording plays to its end, says so, and plays again from its beginning") {
  const DiscRecording disc;
  const auto source = source_of(disc, "correlation");
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(state_of(*source).seconds == doctest::Approx(0).epsilon(0.001));
  CHECK(order(*source, Action::kSpeed, 0).empty());
  const std::uint64_t before = source->version();
  CHECK(order(*source, Action::kPlay).empty());
  REQUIRE(comes_to(*source, Activity::kEnded));
  CHECK(source->version() != before);
  const ViewState ended = state_of(*source);
  CHECK(ended.seconds == doctest::Approx(0.9).epsilon(0.01));
  REQUIRE(!ended.messages.empty());
  CHECK(contains(ended.messages.back().text, "ends at"));
  CHECK(order(*source, Action::kSpeed, 1).empty());
  CHECK(order(*source, Action::kPlay).empty());
  CHECK(wait_until([&] { return state_of(*source).seconds < 0.5; }));
}

TEST_CASE("a recording waits for its first viewer") {
  const DiscRecording disc;
  const auto source = source_of(disc, "correlation", true);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(state_of(*source).seconds < 0.1);
  CHECK(wait_until([&] { return state_of(*source).seconds > 0.2; }));
}

TEST_CASE("seeking, stepping and pausing lead to the wanted times") {
  const DiscRecording disc;
  const auto source = source_of(disc, "correlation");
  CHECK(order(*source, Action::kSeek, 0.4).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  const double at = state_of(*source).seconds;
  CHECK(at == doctest::Approx(0.4));
  const std::int64_t run = state_of(*source).run;
  CHECK(order(*source, Action::kStep, 0.005).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(state_of(*source).seconds == doctest::Approx(at + 0.005));
  CHECK(state_of(*source).run == run);
  CHECK(order(*source, Action::kStep, -0.1).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(state_of(*source).seconds == doctest::Approx(at - 0.095));
  CHECK(state_of(*source).run == run + 1);
  CHECK(order(*source, Action::kSeek, -5).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(state_of(*source).seconds == doctest::Approx(0));
  CHECK(order(*source, Action::kSeek, 1e6).empty());
  CHECK(comes_to(*source, Activity::kEnded));
}

TEST_CASE("the next loss is searched for, and the previous one is found again") {
  const DiscRecording disc;
  const auto source = source_of(disc, "correlation");
  CHECK(order(*source, Action::kSeek, 0.35).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(order(*source, Action::kNextLoss).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  const double loss = state_of(*source).seconds;
  CHECK(loss > 0.5);
  CHECK(loss < 0.7);
  REQUIRE(state_of(*source).errors_px[0]);
  CHECK(*state_of(*source).errors_px[0] > 20);
  CHECK(!source->timeline().losses[0].empty());
  CHECK(order(*source, Action::kSeek, 0.85).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(order(*source, Action::kPreviousLoss).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(state_of(*source).seconds == doctest::Approx(loss).epsilon(0.05));
  CHECK(contains(order(*source, Action::kNextLoss, 0, "", 1), "no tracker"));
}

TEST_CASE("a side's tracker can be changed, and a wrong wish is answered") {
  const DiscRecording disc;
  const auto source = source_of(disc, kNoTracker);
  CHECK(order(*source, Action::kTracker, 0, "cluster", 1).empty());
  REQUIRE(comes_to(*source, Activity::kPaused));
  CHECK(state_of(*source).chosen[1] == "cluster");
  CHECK(contains(order(*source, Action::kTracker, 0, "best"), "choose"));
  CHECK(contains(order(*source, Action::kSpeed, -1), "speed"));
  CHECK(
      contains(order(*source, Action::kSeek, std::numeric_limits<double>::quiet_NaN()), "number"));
  CHECK(contains(order(*source, Action::kPlay, 0, "", 2), "side"));
}

TEST_CASE("pictures are filled and changes waited for while it plays, from several threads") {
  const DiscRecording disc;
  const auto source = source_of(disc, "correlation", true);
  std::vector<std::jthread> viewers;
  std::atomic<int> pictures{0};
  for (int i = 0; i < 2; ++i) {
    viewers.emplace_back([&, i] {
      ViewScene scene;
      PictureWishes wishes;
      wishes.backdrop =
          i == 0 ? PictureWishes::Backdrop::kEvents : PictureWishes::Backdrop::kHeatMap;
      std::uint64_t seen = 0;
      for (int n = 0; n < 10; ++n) {
        source->wait_for_change(seen, std::chrono::milliseconds(50));
        seen = source->version();
        if (source->fill(wishes, scene) && scene.sensor == test::kDiscSensor) ++pictures;
        source->state({0}, 1);
      }
    });
  }
  viewers.clear();
  CHECK(pictures == 20);
}

}  // namespace
}  // namespace puck
