#include "common/vision/twins.h"

#include <cmath>

#include "common/vision/track_trust.h"

namespace puck {
namespace {

constexpr std::int64_t kAtRestPeriod_us = 2'000;
constexpr std::int64_t kOfOtherWallPeriod_us = 60'000;
constexpr std::int64_t kTrustedOfOtherWallPeriod_us = 300'000;
// A track explains its events if so many of them, faded as they are at a decision (some thirty a
// millisecond), are worth so much each. On a whole ring one is worth nearly 1, beside it less than
// 0.
constexpr double kMemory_us = 700;
constexpr double kEnough = 15;
constexpr double kExplained = 0.9;
// Where the ring is, and how fast, is known from the main track.
constexpr double kOfOtherWallSigma_px = 1;
constexpr double kOfOtherWallSigma_px_s = 100;

}  // namespace

// Only of a track beyond doubt: others may explain events that are not the puck's.
bool Twins::is_needless(const ContourTrack& main, const ContourContext& context) const {
  return context.is_trusted && main.quality() > TrackTrust::kSound && events_ > kEnough &&
         worth_ > kExplained * events_;
}

void Twins::fade(std::int64_t time_us) {
  const double keep = std::exp(-static_cast<double>(time_us - faded_us_) / kMemory_us);
  events_ *= keep;
  worth_ *= keep;
  faded_us_ = time_us;
}

void Twins::bear_at_rest(const ContourTrack& main, const ContourContext& context,
                         std::int64_t time_us, Challengers& challengers) {
  fade(time_us);
  if (!context.ingredients.twins || is_needless(main, context) ||
      time_us - at_rest_us_ < kAtRestPeriod_us) {
    return;
  }
  at_rest_us_ = time_us;
  challengers.add(Challenger::Kind::kTwin, context,
                  main.filter().start_at(main.filter().position()), time_us, main.wall_share());
}

void Twins::bear_of_other_wall(const ContourTrack& main, const ContourContext& context,
                               std::int64_t time_us, Challengers& challengers) {
  const std::int64_t period_us =
      context.is_trusted ? kTrustedOfOtherWallPeriod_us : kOfOtherWallPeriod_us;
  if (!context.ingredients.wall || time_us - of_other_wall_us_ < period_us) return;
  of_other_wall_us_ = time_us;
  const PuckContour& contour = context.contour;
  const double share = contour.wall_share(!contour.is_other_wall(main.wall_share()));
  ContourFilter::Start start;
  start.position = contour.centre_with_wall(main.filter().position(), main.wall_share(), share);
  start.velocity = main.filter().velocity();
  start.sigma_px = kOfOtherWallSigma_px;
  start.sigma_px_s = kOfOtherWallSigma_px_s;
  challengers.add(Challenger::Kind::kWall, context, start, time_us, share);
}

}  // namespace puck
