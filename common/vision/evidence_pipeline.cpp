#include "common/vision/evidence_pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/vision/decision_time.h"
#include "common/vision/image_bounds.h"

namespace puck {
namespace {

constexpr std::size_t kMostHypotheses = 16;
constexpr std::size_t kMostMissed = 16'384;
// Events of a decision period that ask for no memory.
constexpr std::size_t kUsualPiece = 16'384;
constexpr std::int64_t kCoast_us = 50'000;

// What moves with the scene is only less likely, so that it is known sooner.
constexpr int kSceneCells = 24;

double share_of(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

}  // namespace

EvidencePipeline::EvidencePipeline(SensorSize sensor, const EvidencePipelineParams& params,
                                   const Region& detection_region, const PuckSizeModel& size_model)
    : sensor_(sensor),
      detection_region_(detection_region.empty() ? Region::all_of(sensor) : detection_region),
      decision_us_(params.decision_us),
      context_{.contour = PuckContour(sensor, size_model, params.calibration, true),
               .filter = params.filter,
               .evidence = params.evidence,
               .decision = params.decision,
               .game = {}},
      // Only what lies on a plane is seen to have a side wall.
      has_wall_(size_model.is_plane() &&
                context_.contour.other_wall_share() != context_.contour.calibrated_wall_share()),
      history_(sensor),
      noise_floor_(sensor),
      background_(sensor, kSceneCells) {
  all_.reserve(kMostHypotheses);
  missed_.reserve(kMostMissed);
  piece_.reserve(kUsualPiece);
}

void EvidencePipeline::take(Timestamp start, std::span<const Event> events) {
  piece_.clear();
  constexpr std::size_t kFetchedAhead = 8;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (i + kFetchedAhead < events.size()) history_.fetch(events[i + kFetchedAhead]);
    const Event& event = events[i];
    const std::int64_t time_us = (start + event.offset_us).us;
    decide_before(time_us);
    now_us_ = std::max(now_us_, time_us);
    noise_floor_.take(event.x, event.y);
    const bool first = history_.is_first(event, time_us);
    if (!puck_.contains(event.x, event.y)) background_.take(event.x, event.y);
    piece_.push_back({time_us, static_cast<float>(event.x), static_cast<float>(event.y),
                      event.polarity != 0, first});
    if (missed_in_.contains(event.x, event.y) && missed_.size() < kMostMissed) {
      missed_.push_back(piece_.back());
    }
  }
  for (Hypothesis& hypothesis : all_) hypothesis.take(piece_, context_);
}

void EvidencePipeline::decide_before(std::int64_t time_us) {
  // Silence is to be noticed before it is over; but not for longer than anything is believed.
  constexpr std::int64_t kLongestSilence_us = 500'000;
  constexpr std::int64_t kSilentStep_us = 10'000;
  const std::int64_t due_us = decision_before(time_us, decision_us_);
  if (due_us <= decided_us_) return;
  std::int64_t step_us = std::max(decided_us_, due_us - kLongestSilence_us) + kSilentStep_us;
  for (; step_us < due_us; step_us += kSilentStep_us) decide(step_us);
  decide(due_us);
}

void EvidencePipeline::decide(std::int64_t time_us) {
  now_us_ = std::max(now_us_, time_us);
  noise_floor_.decide(time_us, true);
  context_.game.noise_px2_s = noise_floor_.per_pixel_us() * 1e6;
  background_.decide(time_us, noise_floor_.per_pixel_us());
  const bool is_puck = teaches();
  std::array<bool, kMostHypotheses> is_heard{};
  for (std::size_t i = 0; i < all_.size(); ++i) is_heard[i] = all_[i].decide(time_us, context_);
  if (is_puck && is_heard[*main_]) {
    context_.game.learn(all_[*main_].packet());
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (is_heard[i]) compare_walls(all_[i]);
    }
  }
  choose(time_us);
  if (!is_seen(time_us)) forget(time_us);
  offer_siblings(time_us);
  plan_search(time_us);
  prune(time_us);
  puck_ = is_sure() ? box_of(all_[*main_]) : Region{};
  decided_us_ = time_us;
}

bool EvidencePipeline::is_seen(std::int64_t time_us) const {
  return main_ && time_us - seen_us_ <= kCoast_us;
}

// What was learned may be of something else.
void EvidencePipeline::forget(std::int64_t time_us) {
  constexpr double kMemory_us = 1e6;
  context_.game.forget(std::min(static_cast<double>(time_us - decided_us_) / kMemory_us, 1.0));
}

// Whether the track is the puck's beyond doubt, and moves.
bool EvidencePipeline::teaches() const {
  constexpr double kTelling_px_s = 60;
  return is_sure() && all_[*main_].filter().speed_px_s() > kTelling_px_s;
}

// Two hypotheses about the same puck, of which one has a side wall that makes events: what is said
// of one packet is said of the whole game.
void EvidencePipeline::compare_walls(const Hypothesis& hypothesis) {
  constexpr std::int64_t kSettled_us = 8'000;
  constexpr double kWorth = 0.2;
  constexpr double kMost = 4;
  const Hypothesis& main = all_[*main_];
  if (hypothesis.wall_share() == main.wall_share() ||
      now_us_ - hypothesis.born_us() < kSettled_us ||
      distance_px(hypothesis.filter().position(), main.filter().position()) >
          0.3 * main.width_px()) {
    return;
  }
  const bool is_other = context_.contour.is_other_wall(hypothesis.wall_share());
  const double nats = kWorth * (hypothesis.nats() - main.nats());
  context_.game.other_wall =
      std::clamp(context_.game.other_wall + (is_other ? nats : -nats), -kMost, kMost);
}

double EvidencePipeline::own_motion_of(const Hypothesis& hypothesis, std::int64_t passed_us) const {
  constexpr double kMemory_us = 5'000;
  constexpr double kTurning_px_s = 15;
  constexpr double kError_px_s = 30;
  constexpr double kErrorShare = 0.25;
  const double keep = std::exp(-static_cast<double>(passed_us) / kMemory_us);
  const double old = keep * hypothesis.own_motion;
  const auto still = background_.still_velocity_at(hypothesis.filter().position());
  if (!still) return old;
  const double turn = std::hypot(still->x, still->y);
  if (turn < kTurning_px_s) return old;
  const PixelVelocity velocity = hypothesis.filter().velocity();
  const double dx = velocity.x - still->x;
  const double dy = velocity.y - still->y;
  const double d = std::hypot(dx, dy) + 1e-9;
  const double variance = std::max(hypothesis.filter().speed_variance(dx / d, dy / d), 0.0);
  const double squared =
      d * d / (variance + kError_px_s * kError_px_s + kErrorShare * kErrorShare * turn * turn);
  const double along = share_of(4 - squared);
  return old + (1 - keep) * (0.3 - 1.3 * along);
}

double EvidencePipeline::odds(const Hypothesis& hypothesis) const {
  const bool is_other = context_.contour.is_other_wall(hypothesis.wall_share());
  const double wall =
      has_wall_ ? 2 * share_of(is_other ? context_.game.other_wall : -context_.game.other_wall) : 1;
  return hypothesis.belief().odds() * wall *
         std::exp(context_.decision.own_motion_nats * hypothesis.own_motion);
}

// There is one puck, or none.
void EvidencePipeline::choose(std::int64_t time_us) {
  const DecisionParams& params = context_.decision;
  double sum = 1;  // of none
  for (Hypothesis& hypothesis : all_) {
    hypothesis.own_motion = own_motion_of(hypothesis, time_us - decided_us_);
    hypothesis.posterior = odds(hypothesis);
    sum += hypothesis.posterior;
  }
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    all_[i].posterior /= sum;
    if (!best || all_[i].posterior > all_[*best].posterior) best = i;
  }
  if (main_ && best != main_ &&
      all_[*best].posterior > params.replace * (all_[*main_].posterior + all_[*best].posterior)) {
    main_ = best;
  } else if (main_ && all_[*main_].belief().odds() < params.lose_odds) {
    main_.reset();
  }
  if (!main_ && best && all_[*best].posterior > params.confirm) {
    main_ = best;
    was_confirmed_ = true;
    left_image_.reset();
  }
  for (Hypothesis& hypothesis : all_) hypothesis.elsewhere = seen_elsewhere(hypothesis);
  if (!main_) return;
  Hypothesis& main = all_[*main_];
  main.was_main = true;
  if (main.belief().seen_share() < 0.5) return;
  seen_at_ = main.filter().position();
  seen_us_ = time_us;
}

double EvidencePipeline::seen_elsewhere(const Hypothesis& hypothesis) const {
  double seen = 0;
  for (const Hypothesis& other : all_) {
    if (distance_px(other.filter().position(), hypothesis.filter().position()) >
        0.5 * other.width_px()) {
      seen += other.posterior * other.belief().seen_share();
    }
  }
  return seen;
}

bool EvidencePipeline::is_sure() const { return main_ && seen_here() > context_.decision.sure; }

// Probability that the puck is seen about where the track is.
double EvidencePipeline::seen_here() const {
  const Hypothesis& main = all_[*main_];
  double here = 0;
  for (const Hypothesis& hypothesis : all_) {
    if (distance_px(hypothesis.filter().position(), main.filter().position()) <
        0.3 * main.width_px()) {
      here += hypothesis.posterior * hypothesis.belief().seen_share();
    }
  }
  return here;
}

Hypothesis* EvidencePipeline::add(const Hypothesis& hypothesis, std::int64_t time_us) {
  constexpr std::int64_t kProtected_us = 5'000;
  if (all_.size() >= kMostHypotheses) {
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (i == main_ || time_us - all_[i].born_us() <= kProtected_us) continue;
      if (!worst || all_[i].belief().odds() < all_[*worst].belief().odds()) worst = i;
    }
    if (!worst || all_[*worst].belief().odds() > hypothesis.belief().odds()) return nullptr;
    remove(*worst);
  }
  all_.push_back(hypothesis);
  return &all_.back();
}

void EvidencePipeline::remove(std::size_t index) {
  all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(index));
  if (!main_) return;
  if (*main_ == index) {
    main_.reset();
  } else if (*main_ > index) {
    --*main_;
  }
}

void EvidencePipeline::offer_siblings(std::int64_t time_us) {
  if (!main_) return;
  const DecisionParams& params = context_.decision;
  const Hypothesis main = all_[*main_];
  if (time_us >= next_manoeuvre_us_ && main.recent_events() > 3) {
    next_manoeuvre_us_ = time_us + params.manoeuvre_us;
    ContourFilter::Start start = main.filter().start_at(main.filter().position());
    start.sigma_px_s = params.manoeuvre_px_s;
    Hypothesis sibling(Hypothesis::Origin::kManoeuvre, start, main.wall_share(),
                       std::log(main.belief().visible_odds()) - params.manoeuvre_nats, time_us,
                       context_);
    sibling.inherit(main);
    add(sibling, time_us);
  }
  constexpr std::int64_t kWallPeriod_us = 50'000;
  if (has_wall_ && time_us >= next_wall_us_ && main.belief().visible() > 0.5) {
    next_wall_us_ = time_us + kWallPeriod_us;
    const bool is_other = context_.contour.is_other_wall(main.wall_share());
    const double share = context_.contour.wall_share(!is_other);
    ContourFilter::Start start{.position = context_.contour.centre_with_wall(
                                   main.filter().position(), main.wall_share(), share),
                               .velocity = main.filter().velocity(),
                               .sigma_px = 2,
                               .sigma_px_s = 300};
    Hypothesis sibling(Hypothesis::Origin::kWall, start, share,
                       std::log(main.belief().visible_odds()), time_us, context_);
    sibling.inherit(main);
    add(sibling, time_us);
  }
}

void EvidencePipeline::plan_search(std::int64_t time_us) {
  constexpr std::int64_t kNearPeriod_us = 5'000;
  constexpr std::int64_t kWidePeriod_us = 20'000;
  constexpr double kNear_px = 60;
  constexpr double kNear_px_us = 1.5e-3;
  if (!missed_in_.empty() || is_sure() || time_us < next_search_us_) return;
  next_search_us_ = time_us + kNearPeriod_us;
  const Region image = Region::all_of(sensor_);
  wanted_ = {.fresh_only = true};
  const bool is_wide = !main_ || time_us >= next_wide_us_;
  if (is_wide) {
    next_wide_us_ = time_us + kWidePeriod_us;
    wanted_.region = was_confirmed_ ? image : detection_region_;
  } else {
    const double radius = kNear_px + kNear_px_us * static_cast<double>(time_us - seen_us_);
    const int side = 2 * static_cast<int>(std::min(radius, 1e4)) + 1;
    wanted_.region = Region::around(seen_at_, side, side).intersect(image);
  }
  if (has_wall_) {
    constexpr double kKnown = 2;
    const double other = context_.game.other_wall;
    searched_other_wall_ = std::abs(other) > kKnown ? other > 0 : !searched_other_wall_;
    wanted_.other_wall = searched_other_wall_;
  }
}

SearchRequest EvidencePipeline::search_wanted() {
  SearchRequest request = wanted_;
  wanted_ = {};
  if (request.region.empty()) return request;
  constexpr int kMargin_px = 80;
  missed_in_ = request.region.inflated(kMargin_px);
  missed_.clear();
  return request;
}

void EvidencePipeline::take(const SearchResult& result) {
  missed_in_ = {};
  const std::size_t most = main_ ? 4 : 8;
  const double since_s = static_cast<double>(now_us_ - seen_us_) * 1e-6;
  const double share = context_.contour.wall_share(result.request.other_wall);
  // Live, the snapshot may be newer than the events that were taken. Of too many missed events the
  // last are not known.
  const std::int64_t born_us =
      missed_.size() < kMostMissed ? std::min(result.time.us, now_us_) : now_us_;
  std::size_t tried = 0;
  for (const SearchCandidate& candidate : result.candidates) {
    if (tried >= most) break;
    const bool is_known = std::any_of(all_.begin(), all_.end(), [&](const Hypothesis& other) {
      return distance_px(other.filter().position_at(result.time.us), candidate.position) <
             std::max(2.5, 0.15 * other.width_px());
    });
    if (is_known) continue;
    ++tried;
    double log_odds = context_.decision.found + context_.decision.found_per_score * candidate.score;
    // The one puck was there: elsewhere it is only as far as it may have gone, or that was wrong.
    if (main_) {
      const double reach = 15 + 2000 * since_s;
      log_odds += std::log(std::exp(-distance_px(candidate.position, seen_at_) / reach) + 0.02);
    }
    const ContourFilter::Start start{
        .position = candidate.position, .sigma_px = 3, .sigma_px_s = context_.decision.found_px_s};
    const Hypothesis hypothesis(Hypothesis::Origin::kSearch, start, share,
                                std::clamp(log_odds, -9.0, 1.0), born_us, context_);
    if (Hypothesis* added = add(hypothesis, now_us_)) catch_up(*added);
  }
  missed_.clear();
}

// What a search found was there when its snapshot was taken.
void EvidencePipeline::catch_up(Hypothesis& hypothesis) {
  const std::span<const TimedEvent> missed(missed_);
  std::size_t from = 0;
  while (from < missed.size() && missed[from].time_us <= hypothesis.born_us()) ++from;
  while (from < missed.size()) {
    const std::int64_t due_us = decision_before(missed[from].time_us, decision_us_);
    if (due_us > hypothesis.decided_us()) hypothesis.decide(due_us, context_);
    std::size_t to = from + 1;
    while (to < missed.size() && missed[to].time_us <= due_us + decision_us_) ++to;
    hypothesis.take(missed.subspan(from, to - from), context_);
    from = to;
  }
}

// Whose events are not of what stands still.
Region EvidencePipeline::box_of(const Hypothesis& hypothesis) const {
  constexpr int kMargin_px = 8;
  const PuckSize size = context_.contour.size_at(hypothesis.filter().position());
  return Region::around(hypothesis.filter().position(), static_cast<int>(size.width),
                        static_cast<int>(size.height))
      .inflated(kMargin_px);
}

bool EvidencePipeline::is_outside(const Hypothesis& hypothesis) const {
  const Pixel place = hypothesis.filter().position();
  const double x = 0.3 * hypothesis.width_px();
  const double y = 0.6 * hypothesis.ring().semi_y;
  return place.x < -x || place.y < -y || place.x > sensor_.width + x ||
         place.y > sensor_.height + y;
}

void EvidencePipeline::prune(std::int64_t time_us) {
  constexpr std::int64_t kHopelessAfter_us = 8'000;
  constexpr double kHopeless = 1e-3;
  constexpr std::int64_t kSilent_us = 20'000;
  constexpr std::int64_t kSilentMain_us = 3'000'000;
  for (std::size_t i = all_.size(); i-- > 0;) {
    const Hypothesis& hypothesis = all_[i];
    const std::int64_t age_us = time_us - hypothesis.born_us();
    bool gone = is_outside(hypothesis);
    if (gone && i == main_) left_image_ = nearest_in_image(hypothesis.filter().position(), sensor_);
    if (i != main_) {
      gone |= age_us > kHopelessAfter_us && hypothesis.belief().odds() < kHopeless;
      gone |= time_us - hypothesis.heard_us() > (hypothesis.was_main ? kSilentMain_us : kSilent_us);
      if (!hypothesis.was_main && hypothesis.packets() > 4) {
        gone |= hypothesis.origin() == Hypothesis::Origin::kManoeuvre && age_us > 16'000;
        gone |= hypothesis.origin() == Hypothesis::Origin::kWall && age_us > 40'000;
      }
      for (std::size_t j = 0; j < all_.size() && !gone && age_us >= 3'000; ++j) {
        if (i == j) continue;
        const Hypothesis& other = all_[j];
        const PixelVelocity a = hypothesis.filter().velocity();
        const PixelVelocity b = other.filter().velocity();
        const bool is_same =
            distance_px(hypothesis.filter().position(), other.filter().position()) < 2 &&
            std::hypot(a.x - b.x, a.y - b.y) < 100 + 0.1 * other.filter().speed_px_s() &&
            hypothesis.wall_share() == other.wall_share();
        gone = is_same && (j == main_ || other.belief().odds() > hypothesis.belief().odds());
      }
    }
    if (gone) remove(i);
  }
}

PuckEstimate EvidencePipeline::step(const SurfaceSnapshot& snapshot) {
  const std::int64_t time_us = std::max(now_us_, snapshot.newest_event.us);
  decide_before(time_us);
  PuckEstimate estimate;
  estimate.newest_event = {time_us};
  estimate.events_applied = snapshot.events_applied;
  estimate.region = events_needed();
  estimate.left_image = left_image_;
  estimate.state = was_confirmed_ ? TrackState::kLost : TrackState::kSearching;
  if (!is_seen(time_us)) return estimate;
  const Hypothesis& main = all_[*main_];
  ContourFilter filter = main.filter();
  filter.predict(time_us, context_.filter.damping_s);
  estimate.state = TrackState::kTracking;
  estimate.position = filter.position();
  estimate.velocity = filter.velocity();
  estimate.covariance = filter.covariance();
  estimate.size = context_.contour.size_at(filter.position());
  estimate.score = std::clamp(seen_here(), 0.0, 1.0);
  estimate.coasting = main.belief().seen_share() < 0.5;
  estimate.resting = !estimate.coasting && time_us - main.heard_us() > kCoast_us;
  return estimate;
}

}  // namespace puck
