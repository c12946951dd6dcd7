#include "tests/bench/live/live_figures.h"

#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

TransportRun run_at(double wanted_mev_s, double sent_mev_s, std::int64_t lost = 0) {
  return {.wanted_mev_s = wanted_mev_s,
          .sent_mev_s = sent_mev_s,
          .events_sent = 1'000'000,
          .lost_on_the_way = lost};
}

}  // namespace

TEST_CASE("the highest rate without loss is the last one before a loss") {
  CHECK(highest_lossless_mev_s({run_at(10, 10), run_at(20, 19.9), run_at(30, 30, 1)}) == 20);
  CHECK(highest_lossless_mev_s({run_at(10, 10, 1), run_at(20, 20)}) == 0);
  TransportRun counted = run_at(10, 10);
  counted.counted_by_tracker = 1;
  CHECK(highest_lossless_mev_s({counted}) == 0);
}

TEST_CASE("a camera below its intended rate is no loss: the sent events count") {
  const TransportRun slow = run_at(10, 9.7);
  CHECK(slow.lost_nothing());
  CHECK_FALSE(slow.kept_pace());
  CHECK_FALSE(slow.carried_all());
  CHECK(highest_lossless_mev_s({slow}) == 9.7);
  CHECK(highest_lossless_mev_s({run_at(20, 20), run_at(30, 18)}) == 20);
  CHECK(run_at(10, 9.9).kept_pace());
}

TEST_CASE("the figures of a cable name sent and lost packets") {
  const TemporaryFolder folder;
  LiveFigures figures;
  figures.network_transport = {run_at(10, 9.7), run_at(15, 15, 3)};
  write_json(figures, folder / "live.json");
  const auto json = nlohmann::json::parse(read_text(folder / "live.json"));
  CHECK(json["network_lossless_mev_s"] == 9.7);
  CHECK(json["network_sent_mev_s"] == 9.7);
  CHECK(json["network_lost"] == 0);
  CHECK(json["lcm_lossless_mev_s"].is_null());
  CHECK(json["lcm_sent_mev_s"].is_null());
}

}  // namespace puck
