#include "common/vision/hypotheses/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/vision/contour/side_view.h"
#include "common/vision/geometry/image_bounds.h"

namespace puck {
namespace {

// An edge slower than this along its normal does not tell dark from bright, px/s; nor one whose
// speed is not so many standard errors from 0.
constexpr double kTelling_px_s = 40;
constexpr double kTelling_sigma = 1.5;
// Events with the wrong sign do not correct the contour of a puck whose tone is known so well.
constexpr double kKnownTone = 0.4;
constexpr double kToneMass = 5;
constexpr double kLargestGate_px = 5;
// Of more repeated events than this between two decisions only every n-th is used, with weight n.
constexpr int kMostRepeats = 50;
// Time constants of the speed: of a puck that is seen, and of one that is not.
constexpr double kSeenDamping_s = 1;
constexpr double kUnseenDamping_s = 0.1;
constexpr double kOwnMemory_s = 0.05;
constexpr double kClutterMemory_s = 0.01;
constexpr double kLeastClutter_px2_s = 1e-3;
// A packet is heard if it has more events than noise makes: by so many, and so many standard
// deviations of the noise.
constexpr double kHeard = 2;
constexpr double kHeard_sigma = 4;

// Directions of the points that stand for a contour.
constexpr int kPoints = 32;
const auto kCircle = [] {
  std::array<std::array<double, 2>, kPoints> circle;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / kPoints;
    circle[static_cast<std::size_t>(i)] = {std::cos(angle), std::sin(angle)};
  }
  return circle;
}();

}  // namespace

Hypothesis::Hypothesis(Origin origin, const ContourFilter::Start& start, double wall_share,
                       double log_odds, std::int64_t time_us, const TrackingContext& context)
    : origin_(origin),
      filter_(context.filter, start, time_us),
      belief_(log_odds),
      wall_share_(wall_share),
      born_us_(time_us),
      decided_us_(time_us),
      heard_us_(time_us),
      start_filter_(filter_) {
  follow_contour(context);
}

void Hypothesis::inherit(const Hypothesis& parent) {
  own_motion = parent.own_motion;
  mark_prior = parent.mark_prior;
  is_newcomer = parent.is_newcomer;
  own_dark_ = parent.own_dark_;
  own_bright_ = parent.own_bright_;
  own_events_ = parent.own_events_;
  own_swept_ = parent.own_swept_;
}

void Hypothesis::merge(const Hypothesis& other) {
  if (other.belief_.odds() > belief_.odds()) belief_ = other.belief_;
  if (other.own_motion.mark() < own_motion.mark()) own_motion = other.own_motion;
  posterior += other.posterior;
  was_main |= other.was_main;
  is_newcomer &= other.is_newcomer;
}

void Hypothesis::follow_contour(const TrackingContext& context) {
  ring_ = context.contour.ring_at(filter_.position(), wall_share_);
  areas_ = EvidenceAreas::of(ring_, seen_);
  filter_.give_slack(side_slack_px(ring_, filter_.position(), context.contour.sensor()));
}

double Hypothesis::damping_s() const {
  const double seen = belief_.visible();
  return 1 / (seen / kSeenDamping_s + (1 - seen) / kUnseenDamping_s);
}

double Hypothesis::density(const GameTraits& game) const {
  return game.knows_density() ? game.density() : (3 + own_events_) / (3 + own_swept_);
}

Region Hypothesis::reach(double seconds) const {
  // By which events may correct the position, and the size change.
  constexpr double kCorrected_px = 8;
  constexpr double kFarthest_px = 1e4;
  const PixelVelocity velocity = filter_.velocity();
  const Pixel middle{filter_.position().x + velocity.x * seconds / 2,
                     filter_.position().y - ring_.rise + velocity.y * seconds / 2};
  const double half_width =
      ring_.half_width() + areas_.reach_px + std::abs(velocity.x) * seconds / 2 + kCorrected_px;
  const double half_height =
      ring_.semi_y + areas_.reach_px + std::abs(velocity.y) * seconds / 2 + kCorrected_px;
  return Region::around(middle, 2 * static_cast<int>(std::min(half_width, kFarthest_px)) + 1,
                        2 * static_cast<int>(std::min(half_height, kFarthest_px)) + 1);
}

void Hypothesis::take(std::span<const TimedEvent> events, const TrackingContext& context) {
  const double reach_x = ring_.half_width() + areas_.reach_px;
  const double reach_y = ring_.semi_y + areas_.reach_px;
  const double damping = damping_s();
  const GameTraits& game = context.game;
  const DecisionParams& params = context.decision;
  const double dark = kToneMass * game.dark_share() + own_dark_;
  const double bright = kToneMass * game.bright_share() + own_bright_;
  const double tone = (bright - dark) / (bright + dark + kToneMass);
  const double density_all = density(game) * game.multiplicity();
  const double clutter = std::max(game.noise_px2_s, clutter_px2_s_) + kLeastClutter_px2_s;
  for (const TimedEvent& event : events) {
    // In between, the position is extrapolated.
    constexpr std::int64_t kPredicted_us = 5;
    const std::int64_t ahead_us = event.time_us - filter_.time_us();
    const PixelVelocity velocity = filter_.velocity();
    const double ahead_s = static_cast<double>(ahead_us) * 1e-6;
    const double dx = event.x - filter_.position().x - ahead_s * velocity.x;
    const double dy = event.y - filter_.position().y - ahead_s * velocity.y;
    if (std::abs(dx) > reach_x || std::abs(dy + ring_.rise) > reach_y) continue;
    if (!event.first && ++repeats_ % stride_ != 0) continue;
    const int count = event.first ? 1 : stride_;
    if (ahead_us >= kPredicted_us) filter_.predict(event.time_us, damping);
    const ContourOffset offset = ring_.offset(dx, dy, filter_.growth_px());
    const double normal_speed =
        offset.normal_x * filter_.velocity().x + offset.normal_y * filter_.velocity().y;
    const double distance = offset.distance_px + context.contour.behind_px(normal_speed);
    if (distance > areas_.reach_px) continue;
    const double contrast = event.on ? normal_speed : -normal_speed;
    const bool tells =
        std::abs(normal_speed) > kTelling_px_s &&
        normal_speed * normal_speed > kTelling_sigma * kTelling_sigma *
                                          filter_.speed_variance(offset.normal_x, offset.normal_y);
    // Except at the image's sides, the size is known: a contour that the filter finds larger is no
    // evidence for a puck.
    const double plain = distance + std::max(filter_.growth_px() - filter_.slack_px(), 0.0);
    const bool on_ring = std::abs(plain) < EvidencePacket::kBand_px;
    if (!on_ring) beside_ += count;
    if (!event.first) {
      if (on_ring) open_.ring_repeats += count;
    } else if (on_ring) {
      open_.ring += 1;
      open_.sectors[static_cast<std::size_t>(offset.sector)] += 1;
      if (tells) {
        (contrast > 0 ? open_.bright : open_.dark) += 1;
        (normal_speed > 0 ? open_.leading : open_.trailing) += 1;
      }
    } else {
      (plain < 0 ? open_.inside : open_.outside) += 1;
    }
    counted_ += count;
    if (tells && (contrast > 0 ? tone : -tone) < -kKnownTone) continue;
    if (is_beyond_gate(distance, offset, params)) continue;
    // Probability that the event is of the contour: as many as its speed, or the error of that,
    // makes there, against all that happens beside it.
    const double variance = filter_.speed_variance(offset.normal_x, offset.normal_y);
    const double speed = std::sqrt(std::max(normal_speed * normal_speed + variance, 0.0));
    const double own = density_all * speed / (2 * EvidencePacket::kBand_px);
    filter_.correct(distance, offset.normal_x, offset.normal_y, count * own / (own + clutter));
  }
}

bool Hypothesis::is_beyond_gate(double distance, const ContourOffset& offset,
                                const DecisionParams& params) const {
  const double squared = distance * distance;
  if (squared < params.gate_px * params.gate_px) return false;
  const double variance = filter_.distance_variance(offset.normal_x, offset.normal_y) + 1;
  return squared >= kLargestGate_px * kLargestGate_px ||
         squared >= params.gate_sigma * params.gate_sigma * variance;
}

bool Hypothesis::decide(std::int64_t time_us, const TrackingContext& context) {
  if (time_us <= decided_us_) return false;
  filter_.predict(time_us, damping_s());
  follow_contour(context);
  const double seconds = static_cast<double>(time_us - decided_us_) * 1e-6;
  decided_us_ = time_us;
  stride_ = 1 + repeats_ / kMostRepeats;
  repeats_ = 0;
  recent_events_ = counted_;
  counted_ = 0;
  open_.seconds += seconds;
  sweep(seconds, context.contour.sensor(), context.game.leading_share());
  const DecisionParams& params = context.decision;
  measure_clutter(seconds);
  const double made = context.game.noise_px2_s * areas_.all() * open_.seconds;
  if (open_.near() - made < params.packet_events && open_.seconds < params.packet_s) return false;
  expected_density_ = density(context.game);
  const Evidence evidence =
      evidence_of(open_, areas_, expected_density_, context.game, context.evidence);
  nats_ = std::clamp(evidence.sum(context.evidence), -params.most_nats, params.most_nats);
  // Less than half a contour, at the image's border, is no evidence for a puck.
  if (nats_ > 0) nats_ *= std::max(2 * seen_ - 1, 0.0);
  if (open_.near() - made > kHeard + kHeard_sigma * std::sqrt(made)) heard_us_ = time_us;
  // What covers the puck must be seen to come.
  constexpr double kBusy_px2 = 0.02;
  const double comes = std::min(
      1.0, (open_.inside + open_.outside) / (kBusy_px2 * (areas_.inside + areas_.outside)));
  belief_.pass(open_.seconds, comes, evidence.told, elsewhere, params.rates);
  belief_.take(nats_);
  if (open_.near() > 0 && evidence.told <= 0) take_back(time_us);
  slow_down(context);
  start_filter_ = filter_;
  const double keep = std::exp(-open_.seconds / kOwnMemory_s);
  own_dark_ = keep * own_dark_ + open_.dark;
  own_bright_ = keep * own_bright_ + open_.bright;
  own_events_ = keep * own_events_ + open_.ring;
  own_swept_ = keep * own_swept_ + open_.swept;
  closed_ = open_;
  open_ = {};
  ++packets_;
  return true;
}

// Events a px² and s beside the contour.
void Hypothesis::measure_clutter(double seconds) {
  const double keep = std::exp(-seconds / kClutterMemory_s);
  const double rate = beside_ / ((areas_.inside + areas_.outside) * seconds + 1e-12);
  clutter_px2_s_ = keep * clutter_px2_s_ + (1 - keep) * rate;
  beside_ = 0;
}

// How much the contour sweeps at the present velocity.
void Hypothesis::sweep(double seconds, SensorSize sensor, double leading_share) {
  const double semi_y = ring_.face_semi_y();
  const PixelVelocity velocity = filter_.velocity();
  int seen = 0;
  for (const auto& [u, v] : kCircle) {
    const Pixel point = ring_.point(u, v);
    if (!is_in_image({filter_.position().x + point.x, filter_.position().y + point.y - ring_.rise},
                     sensor)) {
      continue;
    }
    ++seen;
    const double gx = u / ring_.semi_x;
    const double gy = v / semi_y - ring_.shear * gx;
    const double slope = std::sqrt(gx * gx + gy * gy);
    // Length of the contour that the point stands for: an ellipse's area element is a·b·dθ.
    const double length = ring_.semi_x * semi_y * slope * 2 * std::numbers::pi / kPoints;
    const double nx = gx / slope;
    const double ny = gy / slope;
    const double outwards = nx * velocity.x + ny * velocity.y;
    const double speed = std::abs(outwards);
    const double error = std::sqrt(std::max(filter_.speed_variance(nx, ny), 0.0));
    const double area = length * seconds;
    open_.flux[static_cast<std::size_t>(ContourRing::sector_of(u, v))] +=
        area * (speed * 2 * (outwards > 0 ? leading_share : 1 - leading_share) + error);
    open_.swept += area * speed;
    open_.swept_low += area * std::max(speed - error, 0.0);
    open_.swept_high += area * (speed + error);
  }
  seen_ = std::max(seen, 1) / static_cast<double>(kPoints);
}

// Noise explains all events of the packet: undoes what they corrected.
void Hypothesis::take_back(std::int64_t time_us) {
  filter_ = start_filter_;
  filter_.predict(time_us, damping_s());
}

// Few events are a measurement of the speed: the contour swept little, and is not as far as it was
// predicted to be.
void Hypothesis::slow_down(const TrackingContext& context) {
  if (!context.game.knows_density()) return;
  const double made = context.game.noise_px2_s * areas_.ring * open_.seconds;
  const double own = std::max(open_.ring - made, 0.0);
  if (own >= context.decision.packet_events) return;
  const double most = 2 * (own + 2 * std::sqrt(open_.ring) + 2) / context.game.density();
  if (open_.swept_high <= most) return;
  filter_.slow_down(most / open_.swept_high, open_.seconds, start_filter_.place_variances());
}

}  // namespace puck
