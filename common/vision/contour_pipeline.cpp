#include "common/vision/contour_pipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace puck {
namespace {

// So many of each kind at most.
constexpr std::ptrdiff_t kMostTwins = 4;
constexpr std::ptrdiff_t kMostWitnesses = 8;
constexpr std::ptrdiff_t kMostWallTwins = 1;
constexpr std::ptrdiff_t kMostFound = 36;
constexpr std::size_t kMostChallengers = kMostTwins + kMostWitnesses + kMostWallTwins + kMostFound;

// Without a good track for so long the filter slows down, since it follows nothing.
constexpr std::int64_t kBlindAfter_us = 40'000;

constexpr std::int64_t kTwinPeriod_us = 2'000;
constexpr std::int64_t kTwinLife_us = 8'000;
constexpr std::int64_t kTwinAge_us = 1'500;
constexpr std::int64_t kWitnessPeriod_us = 1'000;
constexpr std::int64_t kWallTwinPeriod_us = 60'000;
constexpr std::int64_t kWallTwinLife_us = 40'000;
constexpr std::int64_t kWallTwinAge_us = 15'000;
constexpr double kWallSigma_px = 1;
constexpr double kWallSigma_px_s = 100;
constexpr std::int64_t kWitnessAge_us = 900;
constexpr double kWitnessSigma_px = 4;
constexpr double kWitnessSigma_px_s = 1'000;
constexpr double kAgreement_widths = 0.25;
constexpr double kAstray_widths = 0.5;
constexpr std::int64_t kAstrayFor_us = 20'000;

constexpr double kDoubtful = 0.6;
constexpr double kBad = 0.3;
constexpr std::int64_t kSearchPeriod_us = 5'000;
constexpr std::int64_t kWideSearchPeriod_us = 40'000;
// A sound track is not questioned from afar; one that only holds up, now and then.
constexpr double kSound = 0.85;
constexpr std::int64_t kGuardSearchPeriod_us = 100'000;
constexpr std::int64_t kCalmSearchPeriod_us = 500'000;
constexpr std::int64_t kRestingSearchPeriod_us = 1'000'000;
// No other puck could be three times as strong as this.
constexpr double kLively = 300;
// What is known of the puck's events is learned from a track of this quality.
constexpr double kLearnable = 0.7;
// Trust grows while a track is sound and wanes while it is not. Below this, the track may well be
// something else, and gives way to anything that looks better.
constexpr std::int64_t kTrusted_us = 200'000;
constexpr std::int64_t kMostTrust_us = 1'000'000;
// A track that has not been sound for so long gives way to an evident puck, trusted or not.
constexpr std::int64_t kUnsoundFor_us = 150'000;
constexpr std::int64_t kNoSearch_us = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kFirstSearchPeriod_us = 20'000;
constexpr std::int64_t kSearchLife_us = 60'000;
// Of a puck of good contrast the correlation's score is above this, of all else below.
constexpr double kEvidentScore = 0.65;
// How long an evident puck is waited for before anything less is believed.
constexpr std::int64_t kPatience_us = 150'000;
constexpr double kSearchRadius_px = 20;
constexpr double kSearchGrowth_px_us = 1.5e-3;
constexpr double kTakeoverRadius_px = 12;
constexpr double kFarthestTakeover_px = 60;

// A challenger that has come so near to the main track is the same track.
constexpr double kSame_px = 2;
constexpr double kSame_px_s = 100;

// The image of a fixed mark moves more slowly than this while the head turns as it does in play; a
// track that has been faster for so long has proved to be the puck's.
constexpr double kOwnMotion_px_s = 300;
constexpr std::int64_t kProvenAfter_us = 30'000;

constexpr double kSlow_px_s = 60;
constexpr std::int64_t kSoundFirst_us = 20'000;
constexpr std::int64_t kWeaklyFoundFor_us = 20'000;
constexpr double kBeyondImage_px = 15;
// A puck whose centre has been outside the image for so long, unseen, has left.
constexpr std::int64_t kLeaving_us = 10'000;

// The filter takes an edge's passing for as many events as a pixel makes of it, each as far off as
// a single one; what the lag leaves grows with the speed; the size model and the pixels leave a
// floor.
constexpr double kLagSigma_s = 80e-6;
constexpr double kFloor_px = 0.04;

std::array<double, 16> honest_covariance(const ContourFilter& filter,
                                         const PuckSignature& signature) {
  const double share =
      signature.knows_multiplicity() ? 1 / std::max(signature.multiplicity(), 1.0) : 1;
  std::array<double, 16> covariance = filter.covariance();
  for (double& value : covariance) value *= share;
  const double lag_x = kLagSigma_s * filter.velocity().x;
  const double lag_y = kLagSigma_s * filter.velocity().y;
  covariance[0] += lag_x * lag_x + kFloor_px * kFloor_px;
  covariance[1] += lag_x * lag_y;
  covariance[4] += lag_x * lag_y;
  covariance[5] += lag_y * lag_y + kFloor_px * kFloor_px;
  return covariance;
}

std::ptrdiff_t most_of(Challenger::Kind kind) {
  switch (kind) {
    case Challenger::Kind::kTwin:
      return kMostTwins;
    case Challenger::Kind::kWitness:
      return kMostWitnesses;
    case Challenger::Kind::kWall:
      return kMostWallTwins;
    case Challenger::Kind::kSearch:
      break;
  }
  return kMostFound;
}

std::int64_t life_us(Challenger::Kind kind) {
  switch (kind) {
    case Challenger::Kind::kTwin:
    case Challenger::Kind::kWitness:
      return kTwinLife_us;
    case Challenger::Kind::kWall:
      return kWallTwinLife_us;
    case Challenger::Kind::kSearch:
      break;
  }
  return kSearchLife_us;
}

// What the search found by mistake makes room for others.
bool is_hopeless(const Challenger& challenger, std::int64_t time_us) {
  if (challenger.kind() != Challenger::Kind::kSearch) return false;
  const std::int64_t age_us = challenger.age_us(time_us);
  const double quality = challenger.track().quality();
  return (age_us > 10'000 && quality < 0.2) || (age_us > 25'000 && quality < 0.5);
}

double distance(Pixel a, Pixel b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

ContourPipeline::ContourPipeline(SensorSize sensor, const ContourPipelineParams& params,
                                 const Region& detection_region, const PuckSizeModel& size_model)
    : sensor_(sensor),
      params_(params),
      detection_region_(detection_region.empty()
                            ? Region::all_of(sensor)
                            : detection_region.intersect(Region::all_of(sensor))),
      context_{PuckContour(sensor, size_model, params.calibration, params.ingredients.shear),
               params.filter,
               params.ingredients,
               {}},
      history_(sensor),
      events_needed_(Region::all_of(sensor)) {
  context_.filter.follows_size = params.ingredients.size_state;
  challengers_.reserve(kMostChallengers);
}

void ContourPipeline::take(Timestamp start, std::span<const Event> events) {
  for (const Event& event : events) {
    const std::int64_t time_us = (start + event.offset_us).us;
    decide_before(time_us);
    take_event(event, time_us);
  }
}

void ContourPipeline::take_event(const Event& event, std::int64_t time_us) {
  now_us_ = std::max(now_us_, time_us);
  const bool first = history_.is_first(event, time_us);
  if (main_) witness_.take(event.x, event.y);
  const ContourEvent seen{time_us, static_cast<double>(event.x), static_cast<double>(event.y),
                          event.polarity != 0, first};
  const double worth = main_ ? main_->take(seen, context_) : 0;
  for (Challenger& challenger : challengers_) challenger.take(seen, worth, context_);
}

// Events at a multiple of the period belong to the decision at that time.
void ContourPipeline::decide_before(std::int64_t time_us) {
  const std::int64_t due_us = (time_us - 1) / params_.decision_us * params_.decision_us;
  if (due_us > decided_us_) decide(due_us);
}

void ContourPipeline::decide(std::int64_t time_us) {
  now_us_ = std::max(now_us_, time_us);
  if (main_) {
    judge_main(time_us);
    check_stop(time_us);
    check_leaving();
    consult_witness(time_us);
    bear_twin(time_us);
    bear_wall_twin(time_us);
  }
  judge_challengers(time_us);
  judge_state(time_us);
  plan_search(time_us);
  plan_events();
  decided_us_ = time_us;
}

void ContourPipeline::judge_main(std::int64_t time_us) {
  main_->decide(time_us, time_us - good_us_ > kBlindAfter_us, context_);
  const PuckSignature::Sample sample = main_->take_sample();
  if (resting_) {
    main_->park();
  }
  // What is known of a puck at rest holds while it cannot be seen.
  const bool is_sound = main_->quality() > kSound;
  if (is_sound) sound_us_ = time_us;
  if (is_sound || !resting_) {
    const std::int64_t passed_us = time_us - decided_us_;
    trust_us_ =
        std::clamp<std::int64_t>(trust_us_ + (is_sound ? passed_us : -passed_us), 0, kMostTrust_us);
  }
  context_.is_trusted = trust_us_ > kTrusted_us;
  moving_us_ = is_sound && main_->filter().speed_px_s() > kOwnMotion_px_s
                   ? moving_us_ + time_us - decided_us_
                   : 0;
  if (moving_us_ > kProvenAfter_us) is_proven_ = true;
  if (trust_us_ == 0) is_proven_ = false;
  if (trust_us_ == 0) context_.signature = {};
  if (!main_->is_good()) return;
  good_us_ = time_us;
  if (main_->shape_quality() > kLearnable) context_.signature.learn(sample, time_us - decided_us_);
}

bool ContourPipeline::is_quiet() const { return main_->evidence().near_events() < 6; }

// A moving puck makes events. When it should have made a good many since the last and nothing else
// has happened around it, it has stopped where it was.
void ContourPipeline::check_stop(std::int64_t time_us) {
  if (!context_.ingredients.stopping || context_.signature.density() <= 0) return;
  const double silent_us = static_cast<double>(time_us - main_->last_ring_us());
  const double missing =
      main_->expected_events(context_.signature) * silent_us / RingEvidence::kMemory_us;
  if (missing > 12 && silent_us > 3'000 && main_->clutter_since_ring() < 0.2 * missing) {
    main_->stop_at(main_->last_ring_position(), time_us, context_);
  }
}

void ContourPipeline::check_leaving() {
  const Pixel position = main_->filter().position();
  const Pixel inside{
      std::clamp(position.x, -kBeyondImage_px, sensor_.width - 1 + kBeyondImage_px),
      std::clamp(position.y, -kBeyondImage_px, sensor_.height - 1 + kBeyondImage_px)};
  if (!(inside == position)) main_->stop_at(inside, now_us_, context_);
}

bool ContourPipeline::witness_agrees() const {
  const Pixel position = main_->filter().position();
  return distance(witness_.position(), position) <
         kAgreement_widths * context_.contour.size_at(position).width;
}

void ContourPipeline::consult_witness(std::int64_t time_us) {
  const Pixel position = main_->filter().position();
  const double width = context_.contour.size_at(position).width;
  witness_.set_size(context_.contour.size_at(witness_.position()));
  witness_.note();
  if (witness_agrees()) {
    agreed_us_ = time_us;
    return;
  }
  if (!context_.ingredients.witness) return;
  if (main_->is_good() && distance(witness_.position(), position) > kAstray_widths * width &&
      time_us - agreed_us_ > kAstrayFor_us) {
    witness_.put(position);
    return;
  }
  if (context_.signature.is_faint() || time_us - witness_us_ < kWitnessPeriod_us) return;
  witness_us_ = time_us;
  ContourFilter::Start start;
  start.position = witness_.position();
  start.velocity = witness_.velocity();
  start.sigma_px = kWitnessSigma_px;
  start.sigma_px_s = kWitnessSigma_px_s;
  start.growth_px = main_->filter().growth_px();
  start.growth_variance_px2 = main_->filter().growth_variance_px2();
  challenge(Challenger::Kind::kWitness, start, time_us, main_->wall_share());
}

void ContourPipeline::bear_twin(std::int64_t time_us) {
  if (!context_.ingredients.twins || time_us - twin_us_ < kTwinPeriod_us) return;
  twin_us_ = time_us;
  ContourFilter::Start start;
  start.position = main_->filter().position();
  start.growth_px = main_->filter().growth_px();
  start.growth_variance_px2 = main_->filter().growth_variance_px2();
  challenge(Challenger::Kind::kTwin, start, time_us, main_->wall_share());
}

// Whether the puck's side wall makes events depends on its light, so that the other opinion is
// heard now and then.
void ContourPipeline::bear_wall_twin(std::int64_t time_us) {
  if (!context_.ingredients.wall || time_us - wall_twin_us_ < kWallTwinPeriod_us) return;
  wall_twin_us_ = time_us;
  const double calibrated = context_.contour.calibrated_wall_share();
  const double share =
      main_->wall_share() == calibrated ? context_.contour.other_wall_share() : calibrated;
  ContourFilter::Start start;
  start.position = main_->filter().position();
  start.velocity = main_->filter().velocity();
  start.sigma_px = kWallSigma_px;
  start.sigma_px_s = kWallSigma_px_s;
  challenge(Challenger::Kind::kWall, shifted_for_wall(start, main_->wall_share(), share), time_us,
            share);
}

// A ring that fits is in the same place whatever is thought of the wall; the puck's centre is not.
ContourFilter::Start ContourPipeline::shifted_for_wall(ContourFilter::Start start, double from,
                                                       double to) const {
  const double width = context_.contour.size_at(start.position).width;
  start.position.y += (to - from) * width / 2;
  return start;
}

void ContourPipeline::challenge(Challenger::Kind kind, const ContourFilter::Start& start,
                                std::int64_t time_us, double wall_share, double search_score) {
  const auto of_kind = std::count_if(challengers_.begin(), challengers_.end(),
                                     [&](const Challenger& other) { return other.kind() == kind; });
  if (of_kind < most_of(kind)) {
    challengers_.emplace_back(kind, context_, start, time_us, wall_share, search_score);
  }
}

void ContourPipeline::judge_challengers(std::int64_t time_us) {
  for (Challenger& challenger : challengers_) challenger.decide(time_us, context_);
  if (!main_) {
    confirm_first(time_us);
    return;
  }
  for (std::size_t i = 0; i < challengers_.size(); ++i) {
    if (takes_over(challengers_[i], time_us)) {
      enthrone(i, time_us);
      return;
    }
  }
  dismiss_hopeless(time_us);
  const ContourFilter& main = main_->filter();
  std::erase_if(challengers_, [&](const Challenger& challenger) {
    const ContourFilter& filter = challenger.track().filter();
    return challenger.age_us(time_us) > life_us(challenger.kind()) ||
           (challenger.kind() != Challenger::Kind::kWall &&
            distance(filter.position(), main.position()) < kSame_px &&
            std::hypot(filter.velocity().x - main.velocity().x,
                       filter.velocity().y - main.velocity().y) < kSame_px_s);
  });
}

void ContourPipeline::dismiss_hopeless(std::int64_t time_us) {
  std::erase_if(challengers_, [&](const Challenger& challenger) {
    const bool is_over =
        challenger.kind() == Challenger::Kind::kSearch &&
        (challenger.age_us(time_us) > kSearchLife_us || is_hopeless(challenger, time_us));
    if (is_over) refuted_.add(challenger.track().filter().position(), time_us);
    return is_over;
  });
}

bool ContourPipeline::takes_over(Challenger& challenger, std::int64_t time_us) {
  const std::int64_t age_us = challenger.age_us(time_us);
  switch (challenger.kind()) {
    case Challenger::Kind::kTwin:
      return age_us > kTwinAge_us && challenger.leads();
    case Challenger::Kind::kWitness:
      return age_us > kWitnessAge_us && challenger.leads();
    case Challenger::Kind::kWall:
      return age_us > kWallTwinAge_us && challenger.leads() && challenger.track().is_good();
    case Challenger::Kind::kSearch:
      break;
  }
  return challenger.convincing_for_us(is_convincing(challenger, time_us), time_us) >= 3'000;
}

bool ContourPipeline::is_convincing(const Challenger& challenger, std::int64_t time_us) const {
  const ContourTrack& track = challenger.track();
  const std::int64_t age_us = challenger.age_us(time_us);
  const double main_strength = main_->strength();
  if (age_us > 10'000 && track.quality() > 0.75 && track.strength() > 40 &&
      track.strength() > 3 * std::max(main_strength, 5.0)) {
    return true;
  }
  if (!is_proven_ && moves_by_itself(challenger, time_us) &&
      track.quality() > main_->quality() - 0.1) {
    return true;
  }
  if (is_evident(challenger, time_us) && track.quality() > main_->quality() + 0.1 &&
      (!context_.is_trusted || time_us - sound_us_ > kUnsoundFor_us)) {
    return true;
  }
  if (!context_.is_trusted && age_us > 15'000 && track.quality() > 0.8 && track.strength() > 20 &&
      (track.quality() > main_->quality() + 0.12 || track.strength() > 2 * main_strength)) {
    return true;
  }
  if (context_.ingredients.witness && witness_agrees() && context_.signature.knows_multiplicity() &&
      !context_.signature.is_faint()) {
    return false;
  }
  const double reach_px =
      std::min(kFarthestTakeover_px,
               kTakeoverRadius_px + kSearchGrowth_px_us * static_cast<double>(time_us - good_us_));
  // The farther away, the better it must look.
  const double distance_px = distance(track.filter().position(), main_->filter().position());
  const double least_quality = 0.5 + 0.3 * distance_px / kFarthestTakeover_px;
  if (age_us <= 6'000 || track.quality() <= least_quality || track.strength() <= 10 ||
      track.quality() <= main_->quality() + 0.1 || distance_px > reach_px) {
    return false;
  }
  if (main_->quality() < 0.35 && main_strength < std::max(15.0, track.strength() / 2)) return true;
  return track.strength() > 1.3 * main_strength && challenger.leads();
}

// To the correlation it looks like nothing but a puck, and its events do not say otherwise.
bool ContourPipeline::is_evident(const Challenger& challenger, std::int64_t time_us) const {
  const ContourTrack& track = challenger.track();
  return challenger.search_score() > kEvidentScore && challenger.age_us(time_us) > 5'000 &&
         track.quality() > 0.65 && track.strength() > 10;
}

// Nothing that is fixed to the table moves so fast in the image, however the head turns.
bool ContourPipeline::moves_by_itself(const Challenger& challenger, std::int64_t time_us) const {
  const ContourTrack& track = challenger.track();
  return challenger.age_us(time_us) > 12'000 && track.quality() > 0.75 && track.strength() > 25 &&
         track.evidence().cover() > 0.35 && track.filter().speed_px_s() > kOwnMotion_px_s;
}

// While nothing is known, what is not evident must look like a puck in every respect, and longer.
void ContourPipeline::confirm_first(std::int64_t time_us) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < challengers_.size(); ++i) {
    Challenger& challenger = challengers_[i];
    const ContourTrack& track = challenger.track();
    const bool convinces =
        is_evident(challenger, time_us) || moves_by_itself(challenger, time_us) ||
        (time_us - searching_since_us_ > kPatience_us && challenger.age_us(time_us) > 20'000 &&
         track.quality() > 0.8 && track.strength() > 30 && track.filter().growth_px() < 0.6 &&
         track.evidence().cover() > 0.4);
    if (challenger.convincing_for_us(convinces, time_us) >= 3'000 &&
        (!best || track.quality() > challengers_[*best].track().quality())) {
      best = i;
    }
  }
  if (best) {
    enthrone(*best, time_us);
    return;
  }
  dismiss_hopeless(time_us);
}

void ContourPipeline::enthrone(std::size_t index, std::int64_t time_us) {
  const Challenger::Kind kind = challengers_[index].kind();
  const bool is_near =
      main_ && distance(main_->filter().position(),
                        challengers_[index].track().filter().position()) < kFarthestTakeover_px;
  const bool is_weak = !is_near && !is_evident(challengers_[index], time_us) &&
                       !moves_by_itself(challengers_[index], time_us);
  main_ = challengers_[index].track();
  challengers_.clear();
  // A twin is only likely to be right, so that the clock since the last good track runs on.
  if (kind != Challenger::Kind::kTwin) good_us_ = time_us;
  if (kind == Challenger::Kind::kSearch) {
    trust_us_ /= 2;
    found_us_ = time_us;
    was_weakly_found_ = is_weak;
    is_proven_ = false;
    moving_us_ = 0;
    witness_.put(main_->filter().position());
    agreed_us_ = time_us;
  }
}

void ContourPipeline::judge_state(std::int64_t time_us) {
  if (!main_) return;
  const Pixel position = main_->filter().position();
  const bool in_image = position.x >= 0 && position.x <= sensor_.width - 1 && position.y >= 0 &&
                        position.y <= sensor_.height - 1;
  // What the search found may rest only after it has been seen to be a puck.
  const bool was_sound = sound_us_ - found_us_ > kSoundFirst_us;
  resting_ =
      is_quiet() && was_sound && main_->filter().speed_px_s() < kSlow_px_s && witness_agrees();
  // What was found far away and was neither evident nor moved by itself is not said to be the puck
  // before it looks like one beyond doubt.
  const bool is_believed = !was_weakly_found_ || sound_us_ - found_us_ > kWeaklyFoundFor_us;
  if (in_image && is_believed &&
      (main_->is_good() || (resting_ && state_ == TrackState::kTracking))) {
    held_us_ = time_us;
    left_image_.reset();
  }
  if (time_us - held_us_ <= (in_image ? params_.coast_us : kLeaving_us)) {
    state_ = TrackState::kTracking;
    return;
  }
  if (!in_image && !left_image_) {
    left_image_ = Pixel{std::clamp(position.x, 0.0, sensor_.width - 1.0),
                        std::clamp(position.y, 0.0, sensor_.height - 1.0)};
  }
  state_ = TrackState::kLost;
}

std::int64_t ContourPipeline::wide_search_period_us() const {
  if (state_ == TrackState::kLost) return kFirstSearchPeriod_us;
  if (resting_) return kRestingSearchPeriod_us;
  if (main_->quality() < kBad || !context_.is_trusted) return kWideSearchPeriod_us;
  if (main_->quality() < kSound) return kGuardSearchPeriod_us;
  if (main_->strength() > kLively) return kNoSearch_us;
  return is_proven_ ? kCalmSearchPeriod_us : kGuardSearchPeriod_us;
}

void ContourPipeline::plan_search(std::int64_t time_us) {
  if (searching_ || !search_.empty()) return;
  const Region image = Region::all_of(sensor_);
  if (!main_) {
    if (time_us < next_search_us_) return;
    next_search_us_ = time_us + kFirstSearchPeriod_us;
    if (searching_since_us_ < 0) searching_since_us_ = time_us;
    search_ = detection_region_;
    return;
  }
  const double quality = main_->quality();
  if (context_.ingredients.wide_search && time_us - wide_searched_us_ >= wide_search_period_us()) {
    wide_searched_us_ = time_us;
    search_ = image;
    return;
  }
  if (context_.ingredients.search && !resting_ && quality < kDoubtful &&
      time_us >= next_search_us_) {
    next_search_us_ = time_us + kSearchPeriod_us;
    const double radius_px = std::min(
        200.0, kSearchRadius_px + kSearchGrowth_px_us * static_cast<double>(time_us - good_us_));
    const int side = 2 * static_cast<int>(radius_px) + 1;
    search_ = Region::around(main_->filter().position(), side, side).intersect(image);
  }
}

void ContourPipeline::plan_events() {
  const Region image = Region::all_of(sensor_);
  if (!main_) {
    events_needed_ = image;
    return;
  }
  double left = witness_.position().x, right = left;
  double top = witness_.position().y, bottom = top;
  double width = context_.contour.size_at(witness_.position()).width;
  const auto include = [&](const ContourTrack& track) {
    const Pixel position = track.filter().position();
    left = std::min(left, position.x);
    right = std::max(right, position.x);
    top = std::min(top, position.y);
    bottom = std::max(bottom, position.y);
    width = std::max(width, context_.contour.size_at(position).width);
  };
  include(*main_);
  for (const Challenger& challenger : challengers_) include(challenger.track());
  const int margin = static_cast<int>(1.2 * width + 30);
  events_needed_ = Region{static_cast<int>(left), static_cast<int>(top),
                          static_cast<int>(right - left) + 1, static_cast<int>(bottom - top) + 1}
                       .inflated(margin)
                       .intersect(image);
}

Region ContourPipeline::search_wanted() {
  const Region wanted = search_;
  if (!wanted.empty()) searching_ = true;
  search_ = {};
  return wanted;
}

void ContourPipeline::take(const SearchResult& result) {
  searching_ = false;
  for (const SearchCandidate& candidate : result.candidates) {
    ContourFilter::Start start;
    start.position = candidate.position;
    if (main_ && distance(candidate.position, main_->filter().position()) < kSame_px) continue;
    const bool known =
        std::any_of(challengers_.begin(), challengers_.end(), [&](const Challenger& challenger) {
          return challenger.kind() == Challenger::Kind::kSearch &&
                 distance(candidate.position, challenger.track().filter().position()) <
                     2 * kSame_px;
        });
    if (known || refuted_.contains(candidate.position, now_us_)) continue;
    if (candidate.score > kEvidentScore) make_room();
    const double calibrated = context_.contour.calibrated_wall_share();
    challenge(Challenger::Kind::kSearch, start, now_us_, calibrated, candidate.score);
    if (!context_.ingredients.wall) continue;
    const double other = context_.contour.other_wall_share();
    challenge(Challenger::Kind::kSearch, shifted_for_wall(start, calibrated, other), now_us_, other,
              candidate.score);
  }
}

// What is evident must not wait until others have been tried.
void ContourPipeline::make_room() {
  const auto found = [](const Challenger& challenger) {
    return challenger.kind() == Challenger::Kind::kSearch;
  };
  while (std::count_if(challengers_.begin(), challengers_.end(), found) > kMostFound - 2) {
    const auto worst = std::min_element(
        challengers_.begin(), challengers_.end(), [&](const Challenger& a, const Challenger& b) {
          return found(a) && (!found(b) || a.search_score() < b.search_score());
        });
    challengers_.erase(worst);
  }
}

PuckEstimate ContourPipeline::step(const SurfaceSnapshot& snapshot) {
  const std::int64_t time_us = std::max(now_us_, snapshot.newest_event.us);
  decide_before(time_us);
  PuckEstimate estimate;
  estimate.state = state_;
  estimate.newest_event = {time_us};
  estimate.events_applied = snapshot.events_applied;
  estimate.region = events_needed_;
  estimate.left_image = left_image_;
  if (state_ != TrackState::kTracking || !main_) return estimate;

  ContourFilter filter = main_->filter();
  filter.predict(time_us, false);
  estimate.position = filter.position();
  estimate.velocity = filter.velocity();
  estimate.covariance = honest_covariance(filter, context_.signature);
  estimate.size = context_.contour.size_at(filter.position());
  estimate.score = std::clamp(main_->quality(), 0.0, 1.0);
  estimate.resting = resting_;
  estimate.coasting = !main_->is_good() && !resting_;
  return estimate;
}

}  // namespace puck
