#include <array>
#include <cstdio>
#include <string>

#include <doctest/doctest.h>

#include "common/table/motion_constants.h"
#include "tests/play/prediction_run.h"
#include "tests/support/sanitizers.h"

namespace puck {
namespace {

constexpr double kSeconds = kIsSanitized ? 20 : 120;

std::string table_of(const char* what, const std::array<PredictionBin, 10>& bins) {
  std::string text = std::string("\n") + what +
                     "\n to go, s  predictions  place: median  p90, mm  time: median  p90, ms  "
                     "within 1, 2 sigma: place  time, %\n";
  for (const PredictionBin& bin : bins) {
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(),
                  " %.1f-%.1f  %11lld  %13.1f  %7.1f  %12.1f  %7.1f  %15.0f %3.0f  %6.0f %3.0f\n",
                  bin.from_s, bin.to_s, static_cast<long long>(bin.predictions), 1e3 * bin.median_m,
                  1e3 * bin.p90_m, 1e3 * bin.median_s, 1e3 * bin.p90_s, bin.within_1_sigma_percent,
                  bin.within_2_sigma_percent, bin.time_within_1_sigma_percent,
                  bin.time_within_2_sigma_percent);
    text += line.data();
  }
  return text;
}

PredictionRun shots() {
  PredictionRun run;
  run.seconds = kSeconds;
  run.world.game.bank_share = 0.4;
  run.noise_px = 0.1;
  run.noise_memory_ms = 8;
  return run;
}

void check_honest(const std::array<PredictionBin, 10>& bins) {
  for (const PredictionBin& bin : bins) {
    if (bin.predictions < 500) continue;
    CAPTURE(bin.from_s);
    CHECK(bin.within_1_sigma_percent >= 65);
    CHECK(bin.within_2_sigma_percent >= 92);
  }
}

TEST_CASE("With the table's own constants shots are predicted to millimetres, with true errors") {
  PredictionRun run = shots();
  const PhysicsParams& physics = run.world.physics;
  run.motion = with_constants(
      {}, {physics.damping_1_s, physics.rail_normal_keep, physics.rail_tangential_keep});
  const PredictionRun::Result result = run.play();
  MESSAGE(table_of("fitted constants, direct", result.report.direct));
  MESSAGE(table_of("fitted constants, bounced", result.report.bounced));
  const PredictionReport& report = result.report;
  CHECK(report.crossings > kSeconds / 4);
  CHECK(report.direct[1].median_m < 0.002);
  CHECK(report.direct[3].median_m < 0.003);
  CHECK(report.direct[5].median_m < 0.006);
  CHECK(report.bounced[4].median_m < 0.01);
  for (std::size_t i = 0; i < 4; ++i) CHECK(report.missing_percent[i] < 3);
  check_honest(report.direct);
  check_honest(report.bounced);
  CHECK(result.rms_position_m < 0.0015);
}

TEST_CASE("With another table's constants bank shots are predicted worse, with larger errors") {
  const PredictionRun::Result result = shots().play();
  MESSAGE(table_of("default constants, direct", result.report.direct));
  MESSAGE(table_of("default constants, bounced", result.report.bounced));
  CHECK(result.report.direct[3].median_m < 0.003);
  check_honest(result.report.direct);
  check_honest(result.report.bounced);
}

}  // namespace
}  // namespace puck
