#include "common/vision/hypotheses/evidence_pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "common/vision/geometry/image_bounds.h"
#include "common/vision/hypotheses/decision_time.h"

namespace puck {
namespace {

constexpr std::size_t kMostHypotheses = 16;
constexpr std::size_t kMostMissed = 16'384;
// Events of a decision period that ask for no memory.
constexpr std::size_t kUsualPiece = 16'384;
constexpr std::int64_t kCoast_us = 50'000;

double share_of(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

// Whether a hypothesis is about the same object as `there`.
bool is_at(const Hypothesis& hypothesis, const Hypothesis& there) {
  return distance_px(hypothesis.filter().position(), there.filter().position()) <
         0.3 * there.width_px();
}

}  // namespace

EvidencePipeline::EvidencePipeline(SensorSize sensor, const EvidencePipelineParams& params,
                                   const Region& detection_region, const PuckSizeModel& size_model,
                                   const ContourCalibration& calibration)
    : sensor_(sensor),
      detection_region_(detection_region),
      on_packet_(params.on_packet),
      context_{.contour = PuckContour(sensor, size_model, calibration),
               .filter = {},
               .evidence = params.evidence,
               .decision = params.decision,
               .game = {}},
      // Only what lies on a plane is seen to have a side wall.
      has_wall_(size_model.is_plane() &&
                context_.contour.other_wall_share() != context_.contour.calibrated_wall_share()),
      history_(sensor),
      noise_floor_(sensor),
      background_(sensor, params.decision.scene_cells),
      near_(sensor) {
  all_.reserve(kMostHypotheses);
  missed_.reserve(kMostMissed);
  piece_.reserve(kUsualPiece);
}

void EvidencePipeline::take(Timestamp start, std::span<const Event> events) {
  work_off();
  piece_.clear();
  constexpr std::size_t kFetchedAhead = 8;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (i + kFetchedAhead < events.size()) history_.fetch(events[i + kFetchedAhead]);
    const Event& event = events[i];
    const std::int64_t time_us = (start + event.offset_us).us;
    if (time_us > decided_us_ + kDecision_us) decide_before(time_us);
    now_us_ = std::max(now_us_, time_us);
    noise_floor_.take(event.x, event.y);
    const bool first = history_.is_first(event, time_us);
    if (!puck_.contains(event.x, event.y)) background_.take(event.x, event.y);
    const bool is_near = near_.contains(event.x, event.y);
    const bool is_missed = missed_in_.contains(event.x, event.y) && missed_.size() < kMostMissed;
    if (!is_near && !is_missed) continue;
    const TimedEvent timed{time_us, static_cast<float>(event.x), static_cast<float>(event.y),
                           event.polarity != 0, first};
    if (is_near) piece_.push_back(timed);
    if (is_missed) missed_.push_back(timed);
  }
  near_events_ += piece_.size();
  if (main_) all_[*main_].take(piece_, context_);
  is_owed_ = true;
}

// An estimate is the track's; the others get their events before they are looked at.
void EvidencePipeline::work_off() {
  background_.work_off();
  if (!is_owed_) return;
  is_owed_ = false;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (i != main_) all_[i].take(piece_, context_);
  }
}

void EvidencePipeline::decide_before(std::int64_t time_us) {
  // Silence is to be noticed before it is over; but not for longer than anything is believed.
  constexpr std::int64_t kLongestSilence_us = 500'000;
  constexpr std::int64_t kSilentStep_us = 10'000;
  constexpr std::size_t kFewEvents = 16;
  const bool is_rare = is_quiet() && near_events_ < kFewEvents;
  const std::int64_t due_us = decision_before(time_us, is_rare ? kRareDecision_us : kDecision_us);
  // No decision for a time after which events have been taken already.
  if (due_us <= decided_us_ || due_us < now_us_) return;
  std::int64_t step_us = std::max(decided_us_, due_us - kLongestSilence_us) + kSilentStep_us;
  for (; step_us < due_us; step_us += kSilentStep_us) decide(step_us);
  decide(due_us);
}

void EvidencePipeline::decide(std::int64_t time_us) {
  work_off();
  near_events_ = 0;
  now_us_ = std::max(now_us_, time_us);
  noise_floor_.decide(time_us);
  context_.game.noise_px2_s = noise_floor_.per_pixel_us() * 1e6;
  background_.decide(time_us, noise_floor_.per_pixel_us());
  const bool is_puck = teaches();
  std::array<bool, kMostHypotheses> is_heard{};
  for (std::size_t i = 0; i < all_.size(); ++i) is_heard[i] = weigh(all_[i], time_us);
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
  merge(time_us);
  prune(time_us);
  seen_ = main_ ? seen_at(all_[*main_]) : 0;
  puck_ = seen_ > context_.decision.sure ? box_of(all_[*main_]) : Region{};
  spread_ = main_ ? spread_around(all_[*main_]) : Spread{};
  decided_us_ = time_us;
  note_near();
}

// For a while nothing has come but noise: there is nothing new to find or to decide, or it is too
// faint to tell.
bool EvidencePipeline::is_quiet() const {
  constexpr std::int64_t kQuiet_us = 100'000;
  return noise_floor_.quiet_us() > kQuiet_us;
}

// Where hypotheses may take events until the next decision.
void EvidencePipeline::note_near() {
  near_.clear();
  for (const Hypothesis& hypothesis : all_) {
    near_.add(hypothesis.reach(static_cast<double>(kRareDecision_us) * 1e-6));
  }
}

// Returns whether a packet of evidence was full.
bool EvidencePipeline::weigh(Hypothesis& hypothesis, std::int64_t time_us) {
  const bool is_full = hypothesis.decide(time_us, context_);
  if (is_full && on_packet_) on_packet_(hypothesis, context_.game);
  return is_full;
}

bool EvidencePipeline::is_seen(std::int64_t time_us) const {
  return main_ && time_us - seen_us_ <= kCoast_us;
}

// What was learned may be of something else.
void EvidencePipeline::forget(std::int64_t time_us) {
  constexpr double kMemory_us = 200'000;
  context_.game.forget(std::min(static_cast<double>(time_us - decided_us_) / kMemory_us, 1.0));
}

// Whether the track is the puck's beyond doubt, and moves.
bool EvidencePipeline::teaches() const {
  constexpr double kTelling_px_s = 60;
  return is_sure() && all_[*main_].filter().speed_px_s() > kTelling_px_s;
}

// Two hypotheses about the same puck, of which one has a side wall that makes events: adds the
// packet's evidence for one of them to the game's log odds.
void EvidencePipeline::compare_walls(const Hypothesis& hypothesis) {
  constexpr double kWorth = 0.2;
  constexpr double kMost = 4;
  const Hypothesis& main = all_[*main_];
  if (hypothesis.wall_share() == main.wall_share() ||
      now_us_ - hypothesis.born_us() < context_.decision.settled_us || !is_at(hypothesis, main)) {
    return;
  }
  const bool is_other = context_.contour.is_other_wall(hypothesis.wall_share());
  const double nats = kWorth * (hypothesis.nats() - main.nats());
  context_.game.other_wall =
      std::clamp(context_.game.other_wall + (is_other ? nats : -nats), -kMost, kMost);
}

// Probability that the object of a hypothesis moves with the scene; none where the scene's motion
// is unknown.
std::optional<double> EvidencePipeline::stands_still(const Hypothesis& hypothesis) const {
  constexpr double kTurning_px_s = 15;
  constexpr double kError_px_s = 30;
  constexpr double kErrorShare = 0.25;
  const double sigma = context_.decision.still_sigma;
  const auto scene = background_.still_velocity_at(hypothesis.filter().position());
  if (!scene && !background_.is_calm()) return std::nullopt;
  const PixelVelocity still = scene.value_or(PixelVelocity{});
  const double turn = std::hypot(still.x, still.y);
  const PixelVelocity velocity = hypothesis.filter().velocity();
  const double dx = velocity.x - still.x;
  const double dy = velocity.y - still.y;
  const double own = std::hypot(dx, dy) + 1e-9;
  const double variance = std::max(hypothesis.filter().speed_variance(dx / own, dy / own), 0.0) +
                          kError_px_s * kError_px_s + kErrorShare * kErrorShare * turn * turn;
  const double still_share = share_of(sigma * sigma - own * own / variance);
  // Beneath a resting camera, only motion is evidence.
  if (turn < kTurning_px_s) return still_share < 0.5 ? std::optional(still_share) : std::nullopt;
  return still_share;
}

// Marks may be anywhere, but a puck that was lost is rather near where it was last seen.
double EvidencePipeline::mark_prior(Pixel found) const {
  if (!was_confirmed_) return 1;
  const DecisionParams& params = context_.decision;
  const double since_s = static_cast<double>(now_us_ - seen_us_) * 1e-6;
  const double distance = params.lost_px + params.lost_px_s * since_s;
  // Area of which the puck's density there is the mean, if it falls exponentially with the
  // distance.
  const double area = 2 * std::numbers::pi * distance * distance *
                      std::exp(std::min(distance_px(found, last_seen_) / distance, 30.0));
  return std::min(seen_mark_ + area / (1.0 * sensor_.width * sensor_.height), 1.0);
}

// Whether the track has made no events for longer than a packet of evidence lasts.
bool EvidencePipeline::is_silent() const {
  return main_ &&
         static_cast<double>(now_us_ - all_[*main_].heard_us()) * 1e-6 > context_.decision.packet_s;
}

double EvidencePipeline::odds(const Hypothesis& hypothesis) const {
  const bool is_other = context_.contour.is_other_wall(hypothesis.wall_share());
  const double wall =
      has_wall_ ? 2 * share_of(is_other ? context_.game.other_wall : -context_.game.other_wall) : 1;
  const DecisionParams& params = context_.decision;
  const double mark_odds = params.mark_odds + params.mark_odds_each * context_.game.marks;
  double newcomer_odds = 0;
  if (hypothesis.is_newcomer && is_silent()) {
    const double age_s = static_cast<double>(now_us_ - hypothesis.born_us()) * 1e-6;
    newcomer_odds = params.newcomer_odds * std::exp(-age_s / params.newcomer_s);
  }
  return wall / (1 / hypothesis.belief().odds() + hypothesis.mark() * mark_odds + newcomer_odds);
}

// There is one puck, or none.
void EvidencePipeline::choose(std::int64_t time_us) {
  const DecisionParams& params = context_.decision;
  const double seconds = static_cast<double>(time_us - decided_us_) * 1e-6;
  double sum = 1;  // of none
  for (Hypothesis& hypothesis : all_) {
    if (const auto still = stands_still(hypothesis)) {
      hypothesis.own_motion.pass(seconds, *still, params.slip);
    }
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
  if (!main_ && best && seen_at(all_[*best]) > params.confirm) {
    main_ = best;
    was_confirmed_ = true;
    left_image_.reset();
  }
  note_seen_elsewhere();
  if (!main_) return;
  Hypothesis& main = all_[*main_];
  count_marks(time_us);
  main.was_main = true;
  main.is_newcomer = false;
  if (main.belief().is_covered()) return;
  last_seen_ = main.filter().position();
  seen_mark_ = main.mark();
  seen_us_ = time_us;
}

// While the puck moves by itself, other objects that look like it and stand still are marks of the
// scene.
void EvidencePipeline::count_marks(std::int64_t time_us) {
  constexpr double kLooksLikeIt = 50;  // odds
  constexpr double kMoved = 0.01;
  constexpr double kStill = 0.4;
  const Hypothesis& main = all_[*main_];
  if (main.own_motion.mark() > kMoved || main.posterior < 0.9) return;
  for (Hypothesis& other : all_) {
    if (other.is_counted_mark || other.belief().odds() < kLooksLikeIt ||
        other.own_motion.mark() < kStill ||
        time_us - other.born_us() < context_.decision.settled_us ||
        distance_px(other.filter().position(), main.filter().position()) < main.width_px()) {
      continue;
    }
    other.is_counted_mark = true;
    context_.game.marks += 1;
  }
}

// Probability that the puck is the track, visible, and away from each hypothesis.
void EvidencePipeline::note_seen_elsewhere() {
  const double seen = main_ ? (1 - all_[*main_].own_motion.mark()) * seen_at(all_[*main_]) : 0;
  for (Hypothesis& hypothesis : all_) {
    const bool is_there =
        main_ && distance_px(all_[*main_].filter().position(), hypothesis.filter().position()) <=
                     0.5 * all_[*main_].width_px();
    hypothesis.elsewhere = is_there ? 0 : seen;
  }
}

bool EvidencePipeline::is_sure() const {
  return main_ && seen_at(all_[*main_]) > context_.decision.sure;
}

// Probability that the puck is visible at the place of a hypothesis.
double EvidencePipeline::seen_at(const Hypothesis& there) const {
  double here = 0;
  for (const Hypothesis& hypothesis : all_) {
    if (is_at(hypothesis, there)) {
      here += hypothesis.posterior * hypothesis.belief().seen_share();
    }
  }
  return here;
}

// Of the hypotheses about the same object, any of which may be right.
EvidencePipeline::Spread EvidencePipeline::spread_around(const Hypothesis& track) const {
  Spread spread;
  double sum = 1e-9;
  const Pixel place = track.filter().position();
  for (const Hypothesis& other : all_) {
    if (!is_at(other, track)) continue;
    const double dx = other.filter().position().x - place.x;
    const double dy = other.filter().position().y - place.y;
    sum += other.posterior;
    spread.xx += other.posterior * dx * dx;
    spread.xy += other.posterior * dx * dy;
    spread.yy += other.posterior * dy * dy;
  }
  return {spread.xx / sum, spread.xy / sum, spread.yy / sum};
}

// Of (x, y, vx, vy). While the puck is seen, its variance is the filter's over the number of events
// that a pixel makes of an edge: comparison with the truth has shown it. To that come the lag's
// error, and the spread of the hypotheses.
std::array<double, 16> EvidencePipeline::covariance_of(const Hypothesis& track,
                                                       const ContourFilter& now) const {
  const DecisionParams& params = context_.decision;
  std::array<double, 16> covariance = now.covariance();
  if (!track.belief().is_covered()) {
    for (double& value : covariance) value /= context_.game.multiplicity();
  }
  const double lag_x = params.lag_sigma_s * now.velocity().x;
  const double lag_y = params.lag_sigma_s * now.velocity().y;
  const double least = params.place_sigma_px * params.place_sigma_px;
  covariance[0] += lag_x * lag_x + least + spread_.xx;
  covariance[1] += lag_x * lag_y + spread_.xy;
  covariance[4] += lag_x * lag_y + spread_.xy;
  covariance[5] += lag_y * lag_y + least + spread_.yy;
  return covariance;
}

Hypothesis* EvidencePipeline::add(const Hypothesis& hypothesis, std::int64_t time_us) {
  if (all_.size() >= kMostHypotheses) {
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (i == main_ || time_us - all_[i].born_us() < context_.decision.settled_us) continue;
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

// How far the puck may have gone since it was last seen.
double EvidencePipeline::reach_px(std::int64_t time_us) const {
  const DecisionParams& params = context_.decision;
  return params.reach_px + params.reach_px_s * static_cast<double>(time_us - seen_us_) * 1e-6;
}

void EvidencePipeline::plan_search(std::int64_t time_us) {
  constexpr std::int64_t kNearPeriod_us = 5'000;
  constexpr std::int64_t kWidePeriod_us = 20'000;
  constexpr std::int64_t kQuietPeriod_us = 500'000;
  constexpr double kReaches = 4;
  if (!missed_in_.empty() ||
      time_us < searched_us_ + (is_quiet() ? kQuietPeriod_us : kNearPeriod_us) ||
      (is_sure() && !is_silent() && !on_packet_)) {
    return;
  }
  searched_us_ = time_us;
  const Region image = Region::all_of(sensor_);
  wanted_ = {.fresh_only = true};
  const bool is_wide = !main_ || time_us >= next_wide_us_;
  if (is_wide) {
    next_wide_us_ = time_us + kWidePeriod_us;
    wanted_.region = was_confirmed_ ? image : detection_region_;
  } else {
    const double radius = kReaches * reach_px(time_us);
    const int side = 2 * static_cast<int>(std::min(radius, 1e4)) + 1;
    wanted_.region = Region::around(last_seen_, side, side).intersect(image);
  }
  if (has_wall_) {
    // The side wall may have been learned from something else than the puck: some searches assume
    // the other one.
    constexpr double kKnown = 2;
    constexpr unsigned kTried = 4;
    const double other = context_.game.other_wall;
    const bool tries_other = ++searches_ % kTried == 0;
    searched_other_wall_ =
        std::abs(other) > kKnown ? (other > 0) != tries_other : !searched_other_wall_;
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
  work_off();
  missed_in_ = {};
  const std::size_t most = main_ ? 4 : 8;
  const double share = context_.contour.wall_share(result.request.other_wall);
  // Live, the snapshot may be newer than the events that were taken. Of too many missed events the
  // last are not known.
  const std::int64_t born_us =
      missed_.size() < kMostMissed ? std::min(result.time.us, now_us_) : now_us_;
  std::size_t tried = 0;
  for (const SearchCandidate& candidate : result.candidates) {
    if (tried >= most) break;
    const bool is_known = std::any_of(all_.begin(), all_.end(), [&](const Hypothesis& other) {
      return other.wall_share() == share &&
             distance_px(other.filter().position_at(result.time.us), candidate.position) <
                 std::max(2.5, 0.15 * other.width_px());
    });
    if (is_known) continue;
    ++tried;
    double log_odds = context_.decision.found + context_.decision.found_per_score * candidate.score;
    // The one puck was there: elsewhere it is only as far as it may have gone, or that was wrong.
    if (main_) {
      log_odds += std::log(
          std::exp(-distance_px(candidate.position, last_seen_) / reach_px(now_us_)) + 0.02);
    }
    const ContourFilter::Start start{
        .position = candidate.position, .sigma_px = 3, .sigma_px_s = context_.decision.found_px_s};
    Hypothesis hypothesis(Hypothesis::Origin::kSearch, start, share,
                          std::clamp(log_odds, -9.0, 1.0), born_us, context_);
    // Beneath a resting camera, only moving objects make events.
    if (background_.is_calm()) hypothesis.own_motion.moved();
    hypothesis.mark_prior = mark_prior(candidate.position);
    if (Hypothesis* added = add(hypothesis, now_us_)) catch_up(*added);
  }
  missed_.clear();
  note_near();
}

// What a search found was there when its snapshot was taken.
void EvidencePipeline::catch_up(Hypothesis& hypothesis) {
  const std::span<const TimedEvent> missed(missed_);
  std::size_t from = 0;
  while (from < missed.size() && missed[from].time_us <= hypothesis.born_us()) ++from;
  while (from < missed.size()) {
    const std::int64_t due_us = decision_before(missed[from].time_us, kDecision_us);
    if (due_us > hypothesis.decided_us()) weigh(hypothesis, due_us);
    std::size_t to = from + 1;
    while (to < missed.size() && missed[to].time_us <= due_us + kDecision_us) ++to;
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

// Merges hypotheses of the same state into the older one, whose speed has the smaller error.
void EvidencePipeline::merge(std::int64_t time_us) {
  constexpr double kSame_px = 2;
  constexpr double kSame_px_s = 100;
  constexpr double kSameShare = 0.1;
  for (std::size_t young = all_.size(); young-- > 1;) {
    if (time_us - all_[young].born_us() < context_.decision.settled_us) continue;
    for (std::size_t old = 0; old < young; ++old) {
      const ContourFilter& a = all_[old].filter();
      const ContourFilter& b = all_[young].filter();
      if (all_[old].wall_share() != all_[young].wall_share() ||
          distance_px(a.position(), b.position()) >= kSame_px ||
          std::hypot(a.velocity().x - b.velocity().x, a.velocity().y - b.velocity().y) >=
              kSame_px_s + kSameShare * a.speed_px_s()) {
        continue;
      }
      all_[old].merge(all_[young]);
      if (main_ == young) main_ = old;
      remove(young);
      break;
    }
  }
}

void EvidencePipeline::prune(std::int64_t time_us) {
  constexpr double kHopeless = 1e-3;
  const DecisionParams& params = context_.decision;
  constexpr std::int64_t kExplored_us = 100'000;
  for (std::size_t i = all_.size(); i-- > 0;) {
    const Hypothesis& hypothesis = all_[i];
    const std::int64_t age_us = time_us - hypothesis.born_us();
    bool gone = is_outside(hypothesis);
    if (gone && i == main_) left_image_ = nearest_in_image(hypothesis.filter().position(), sensor_);
    gone |= on_packet_ && age_us > kExplored_us;
    if (i != main_) {
      gone |= age_us > params.settled_us && hypothesis.belief().odds() < kHopeless;
      gone |= time_us - hypothesis.heard_us() >
              (hypothesis.was_main ? params.resting_us : params.silent_us);
      if (!hypothesis.was_main && hypothesis.packets() > 4) {
        gone |= hypothesis.origin() != Hypothesis::Origin::kSearch && age_us > params.silent_us;
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
  estimate.region = Region::all_of(sensor_);
  estimate.left_image = left_image_;
  estimate.state = was_confirmed_ ? TrackState::kLost : TrackState::kSearching;
  if (!is_seen(time_us)) return estimate;
  const Hypothesis& main = all_[*main_];
  ContourFilter filter = main.filter();
  filter.predict(time_us, main.damping_s());
  estimate.state = TrackState::kTracking;
  estimate.position = filter.position();
  estimate.velocity = filter.velocity();
  estimate.covariance = covariance_of(main, filter);
  estimate.size = context_.contour.size_at(filter.position());
  estimate.score = std::clamp(seen_, 0.0, 1.0);
  estimate.coasting = main.belief().is_covered();
  estimate.resting = !estimate.coasting && time_us - main.heard_us() > kCoast_us;
  return estimate;
}

}  // namespace puck
