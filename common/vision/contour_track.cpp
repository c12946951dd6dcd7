#include "common/vision/contour_track.h"

#include <algorithm>
#include <cmath>

#include "common/vision/noise_floor.h"
#include "common/vision/side_view.h"

namespace puck {
namespace {

// Below this speed along its normal, px/s, an edge's sign says nothing.
constexpr double kSignedSpeed_px_s = 40;
constexpr double kSurelySigned_sigma = 1.5;
// A contrast sign nearer to 0 than this decides nothing.
constexpr double kClearSign = 0.3;
// What lies farther off than this does not correct the track.
constexpr double kGate_sigma = 3;
constexpr double kSmallestGate_px = 2;
constexpr double kLargestGate_px = 5;
// Penalties of the quality.
constexpr double kTooDense = 3;
constexpr double kLarge_px = 0.6;
constexpr double kTooLarge_px = 0.8;
constexpr double kTooLargeFactor = 0.6;
// … while it is not known that the track is the puck's.
constexpr double kStrangerTooLargeFactor = 0.4;
// Brightness makes a puck look larger by no more than this; nothing is known of that at this
// strength, all at twice that.
constexpr double kBloom_px = 0.5;
constexpr double kBloomStrength = 30;
// The last events of an edge come when it has moved on. Of pucks of good contrast that came into
// view at 4,500 to 8,000 px/s the contour looked 0.5 to 0.9 px too small for 20 ms.
constexpr double kSmearFrom_px_s = 1'000;
constexpr double kSmear_s = 1.5e-4;
constexpr double kMostSmear_px = 0.6;
// A contour that is larger by all that the filter can follow may be larger by anything; so may one
// that is nearly as large.
constexpr double kLeastFollowed_px = 0.1;
// Slow edges make fewer events for the same way.
constexpr double kLeastSpeed_px_s = 150;
constexpr double kSignMemory_us = 40'000;
constexpr double kSureOfSign = 20 * kSignedSpeed_px_s;
constexpr double kMixedSigns = 0.3;
constexpr double kPureSigns = 0.75;
constexpr double kSurePuckSign = 0.9;
// A puck at rest stays where it is, whatever a few stray events say.
constexpr double kParkedSigma_px = 0.4;
constexpr double kParkedSigma_px_s = 60;
// … fewer than so many more on the ring than chance puts there.
constexpr double kStray = 2;
// … and than noise does now and then.
constexpr double kStraySigmas = 2;
// How well a search sees where the puck is.
constexpr double kSearchSigma_px = 1.5;
// How far the ring's centre may move before the ring's shape is made anew.
constexpr double kSamePlace_px = 0.5;

// From 0, of both signs, to 1, of one.
double purity_of(double contrast) {
  return std::clamp((contrast - kMixedSigns) / (kPureSigns - kMixedSigns), 0.0, 1.0);
}

}  // namespace

ContourTrack::ContourTrack(const ContourContext& context, const ContourFilter::Start& start,
                           std::int64_t time_us, double wall_share)
    : filter_(context.filter, start, time_us),
      turning_px_s_(context.contour.turning_px_s()),
      wall_share_(wall_share),
      decided_us_(time_us),
      last_ring_us_(time_us),
      last_ring_position_(start.position) {
  follow_contour(context);
}

void ContourTrack::follow_contour(const ContourContext& context) {
  ring_made_at_ = filter_.position();
  // The wall's height may be known better by now.
  if (context.contour.is_other_wall(wall_share_)) wall_share_ = context.contour.other_wall_share();
  ring_ = context.contour.ring_at(ring_made_at_, wall_share_);
  if (context.ingredients.wall && context.ingredients.wall_edge) {
    const bool is_other = context.contour.is_other_wall(wall_share_);
    wall_edge_ = {ring_,
                  context.contour.ring_at(ring_made_at_, context.contour.wall_share(!is_other))};
    areas_ = wall_edge_.areas();
  } else {
    areas_ = RingEvidence::areas_of(ring_);
  }
  if (filter_.speed_px_s() > turning_px_s_) has_moved_ = true;
  // With a faint puck clutter would pass for one that is larger.
  const bool counts = context.ingredients.image_sides && context.may_be_aside &&
                      context.signature.remembers_contrast();
  const SideView view =
      counts ? side_view_of(ring_, ring_made_at_, context.contour.sensor()) : SideView{};
  filter_.give_slack(view.slack_px);
  areas_.sectors = view.sectors;
  areas_.may_have_print = context.ingredients.face_print && has_moved_ && !context.is_plain;
}

double ContourTrack::take(const ContourEvent& event, const ContourContext& context) {
  const double dt = static_cast<double>(event.time_us - filter_.time_us()) * 1e-6;
  const PixelVelocity velocity = filter_.velocity();
  const double dx = event.x - (filter_.position().x + dt * velocity.x);
  const double dy = event.y - (filter_.position().y + dt * velocity.y);
  const double reach = RingEvidence::kReach_px + 1;
  if (std::abs(dy + ring_.rise) > ring_.semi_y + reach ||
      std::abs(dx) > ring_.half_width() + reach) {
    return 0;
  }
  const auto along_normal = [&](const ContourOffset& place) {
    return place.normal_x * velocity.x + place.normal_y * velocity.y;
  };
  // The event shows where the contour was a little earlier.
  const auto offset_from = [&](const ContourRing& ring) {
    ContourOffset place = ring.offset(dx, dy, filter_.growth_px());
    if (context.ingredients.lag) {
      place.distance_px += context.contour.behind_px(along_normal(place));
    }
    return place;
  };
  const ContourOffset offset = offset_from(ring_);
  const double normal_speed = along_normal(offset);
  const double distance = std::abs(offset.distance_px);
  if (offset.distance_px > RingEvidence::kReach_px) return 0;

  // A hot pixel says nothing about a puck at rest, however often it fires.
  const bool repeats = context.ingredients.settling &&
                       recent_pixels_.repeats(static_cast<int>(event.x), static_cast<int>(event.y));
  if (repeats && is_parked_) return 0;
  const double sign = contrast_sign(context);
  // Asked for last, as it takes longest.
  const auto is_surely_signed = [&] {
    return normal_speed * normal_speed >
           kSurelySigned_sigma * kSurelySigned_sigma *
               filter_.speed_variance(offset.normal_x, offset.normal_y);
  };
  const bool wrong_sign = context.ingredients.polarity && std::abs(sign) > kClearSign &&
                          std::abs(normal_speed) > kSignedSpeed_px_s &&
                          (event.on ? normal_speed : -normal_speed) * sign < 0 &&
                          is_surely_signed();
  if (distance <= RingEvidence::kRing_px) {
    sample_.count(event.on, normal_speed, event.first);
    // A first track's speed, by which alone it is judged, is not known yet.
    if (!context.is_first || is_surely_signed()) {
      signed_speed_ += event.on ? normal_speed : -normal_speed;
      absolute_speed_ += std::abs(normal_speed);
    }
  }
  if (!event.first && context.ingredients.first_events && context.signature.is_faint()) return 0;

  if (repeats) evidence_.add_repeat();
  if (distance > RingEvidence::kRing_px && wall_edge_.is_known() &&
      std::abs(offset_from(wall_edge_.ring()).distance_px) <= RingEvidence::kRing_px) {
    evidence_.add_wall(offset.distance_px < 0);
    return 0;
  }
  double worth = 0;
  if (distance > RingEvidence::kRing_px) {
    ++clutter_since_ring_;
    if (offset.distance_px < 0) {
      worth = evidence_.add_inside(areas_);
      sample_.inside_per_px2 += 1 / areas_.inside;
    } else {
      worth = evidence_.add_outside(areas_);
    }
  } else if (wrong_sign) {
    evidence_.add_wrong_sign();
    worth = -1;
  } else {
    worth = evidence_.add_ring(offset.sector, context.ingredients.sector_saturation);
    sample_.ring_per_px2 += 1 / areas_.ring;
    last_ring_us_ = event.time_us;
    clutter_since_ring_ = 0;
  }
  if (wrong_sign) return worth;
  // An edge of the print is not one of the contour that the track has yet to be drawn to.
  if (offset.distance_px < -RingEvidence::kRing_px && evidence_.shows_print(areas_)) return worth;
  const double variance = filter_.distance_variance(offset.normal_x, offset.normal_y);
  const double gate_px2 =
      std::clamp(kGate_sigma * kGate_sigma * (variance + 1), kSmallestGate_px * kSmallestGate_px,
                 kLargestGate_px * kLargestGate_px);
  if (distance * distance >= gate_px2) return worth;
  if (is_parked_ && evidence_.strength(areas_) < kStray + kStraySigmas * std::sqrt(ring_noise_)) {
    return worth;
  }
  filter_.predict(event.time_us, blind_);
  filter_.correct(offset.distance_px, offset.normal_x, offset.normal_y);
  if (distance <= RingEvidence::kRing_px) {
    ++recent_events_;
    last_ring_position_ = filter_.position();
  }
  const Pixel now = filter_.position();
  if (std::abs(now.x - ring_made_at_.x) > kSamePlace_px ||
      std::abs(now.y - ring_made_at_.y) > kSamePlace_px) {
    follow_contour(context);
  }
  return worth;
}

void ContourTrack::decide(std::int64_t time_us, bool blind, const ContourContext& context) {
  blind_ = blind;
  is_parked_ = false;
  filter_.predict(time_us, blind);
  follow_contour(context);
  const auto passed_us = static_cast<double>(time_us - decided_us_);
  decided_us_ = time_us;
  if (filter_.speed_px_s() > kLeastSpeed_px_s) {
    sample_.swept_px2 += swept_px2_per_s() * passed_us * 1e-6;
    sample_.events += static_cast<double>(recent_events_);
  }
  recent_events_ = 0;
  evidence_.fade(std::exp(-passed_us / RingEvidence::kMemory_us));
  const double keep = std::exp(-passed_us / kSignMemory_us);
  signed_speed_ *= keep;
  absolute_speed_ *= keep;
  const double noise_per_px2 = context.noise_per_pixel_us * RingEvidence::kMemory_us;
  const double growth_px = filter_.growth_px();
  ring_noise_ = noise_per_px2 * areas_.ring;
  inside_noise_ = noise_per_px2 * ring_.inside_area(RingEvidence::kRing_px - growth_px);
  near_noise_ = noise_per_px2 * ring_.reach_area(RingEvidence::kReach_px + growth_px);
  strength_ = evidence_.strength(areas_);
  bloom_px_ = bloom_px(context);
  smear_px_ = smear_px(context);
  const double penalty = shape_penalty(context);
  quality_ = penalty * evidence_.quality(areas_);
  clarity_ = penalty * evidence_.quality(areas_, noise_per_px2);
  shape_quality_ = quality_;
  printed_quality_ = quality_;
  if (!areas_.may_have_print) {
    RingAreas printed = areas_;
    printed.may_have_print = true;
    printed_quality_ = penalty * evidence_.quality(printed);
  }
  if (!context.ingredients.size_penalty) return;
  const double expected = expected_events(context.signature);
  if (expected > 0 && filter_.speed_px_s() > kLeastSpeed_px_s &&
      evidence_.ring_events() > kTooDense * expected) {
    const double excess = evidence_.ring_events() / (kTooDense * expected);
    quality_ /= excess * excess;
    clarity_ /= excess * excess;
    printed_quality_ /= excess * excess;
  }
}

double ContourTrack::shape_penalty(const ContourContext& context) const {
  double penalty = context.ingredients.purity ? purity(context) : 1;
  if (context.ingredients.size_penalty) {
    const double excess_px = (unexplained_growth_px() - kLarge_px) / (kTooLarge_px - kLarge_px);
    const double factor = context.is_trusted ? kTooLargeFactor : kStrangerTooLargeFactor;
    penalty *= 1 - (1 - factor) * std::clamp(excess_px, 0.0, 1.0);
  }
  return penalty;
}

// The blurred edge of what is bright passes the sensor's thresholds well outside the middle of it,
// where there is little light yet, and the brighter it is, with the more events. Until the puck is
// known to be bright, a bright mallet that is as much too large must not pass for it.
double ContourTrack::bloom_px(const ContourContext& context) const {
  if (!context.ingredients.bloom || context.signature.contrast_sign() < kClearSign) return 0;
  const double most_px =
      kBloom_px * purity_of(own_contrast()) * std::clamp(strength_ / kBloomStrength - 1, 0.0, 1.0);
  const double growth_px = filter_.growth_px();
  const double follows = (filter_.largest_growth_px() - growth_px) / kLeastFollowed_px;
  return std::clamp(growth_px, 0.0, most_px * std::clamp(follows, 0.0, 1.0));
}

double ContourTrack::smear_px(const ContourContext& context) const {
  if (!context.ingredients.smear) return 0;
  return std::clamp(kSmear_s * (filter_.speed_px_s() - kSmearFrom_px_s), 0.0, kMostSmear_px);
}

double ContourTrack::unexplained_growth_px() const {
  const double growth_px = filter_.growth_px() - bloom_px_;
  return growth_px - std::clamp(growth_px, -smear_px_, filter_.slack_px());
}

TrackLooks ContourTrack::looks() const {
  return {.position = filter_.position(),
          .speed_px_s = filter_.speed_px_s(),
          .turning_px_s = turning_px_s_,
          .slide = filter_.slide(),
          .growth_px = unexplained_growth_px(),
          .quality = quality_,
          .agreement = evidence_.agreement(areas_),
          .clarity = clarity_,
          .printed_quality = printed_quality_,
          .strength = strength_,
          .cover = evidence_.cover(areas_),
          .near_events = beyond_noise(evidence_.near_events(), near_noise_),
          .inside_events = beyond_noise(evidence_.inside_events(), inside_noise_)};
}

void ContourTrack::park() {
  is_parked_ = true;
  filter_.park(kParkedSigma_px, kParkedSigma_px_s);
}

void ContourTrack::carry_to(Pixel position, PixelVelocity velocity, const ContourContext& context) {
  filter_.carry(position, velocity, kParkedSigma_px, kParkedSigma_px_s);
  last_ring_position_ = position;
  follow_contour(context);
}

void ContourTrack::correct_place(double dx, double dy, const ContourContext& context) {
  filter_.correct_place(dx, dy, kSearchSigma_px);
  last_ring_position_ = filter_.position();
  follow_contour(context);
}

void ContourTrack::stop_at(Pixel position, std::int64_t time_us, const ContourContext& context) {
  const ContourFilter::Start start = filter_.start_at(position);
  filter_.predict(time_us, true);
  filter_.restart(start);
  follow_contour(context);
  // Of a puck of good contrast what little goes on around it keeps it from being taken to rest.
  if (context.signature.is_faint()) forget_evidence();
}

void ContourTrack::forget_evidence() {
  evidence_ = {};
  quality_ = clarity_ = printed_quality_ = shape_quality_ = strength_ = 0;
}

// A disc of one tone has one sign where it advances and the other one where it recedes.
double ContourTrack::purity(const ContourContext& context) const {
  if (absolute_speed_ < kSureOfSign) return 1;
  const double known = context.is_trusted ? context.signature.contrast_sign() : 0;
  const double contrast = own_contrast();
  return purity_of(std::abs(known) > kSurePuckSign ? contrast * (known > 0 ? 1 : -1)
                                                   : std::abs(contrast));
}

double ContourTrack::own_contrast() const {
  return absolute_speed_ < kSureOfSign ? 0 : signed_speed_ / absolute_speed_;
}

// The puck's, or, while it is not known for sure, that of the track's own events.
double ContourTrack::contrast_sign(const ContourContext& context) const {
  if (context.is_trusted) return context.signature.contrast_sign();
  return own_contrast();
}

// Both edges of the disc sweep what lies across their motion.
double ContourTrack::swept_px2_per_s() const {
  const PixelVelocity velocity = filter_.velocity();
  return 4 * std::hypot(ring_.semi_x * velocity.y, ring_.semi_y * velocity.x);
}

double ContourTrack::expected_events(const PuckSignature& signature) const {
  return signature.density() * swept_px2_per_s() * RingEvidence::kMemory_us * 1e-6;
}

PuckSignature::Sample ContourTrack::take_sample() {
  const PuckSignature::Sample sample = sample_;
  sample_ = {};
  return sample;
}

}  // namespace puck
