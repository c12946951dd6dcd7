#include "common/vision/contour_pipeline.h"

#include <algorithm>
#include <cmath>

#include "common/vision/candidate_order.h"
#include "common/vision/decision_time.h"
#include "common/vision/honest_covariance.h"
#include "common/vision/image_bounds.h"
#include "common/vision/puck_detector.h"
#include "common/vision/sighting.h"
#include "common/vision/silent_trust.h"
#include "common/vision/stopping.h"
#include "common/vision/takeover.h"
#include "common/vision/track_region.h"

namespace puck {
namespace {

// Without a good track for so long the filter slows down, since it follows nothing.
constexpr std::int64_t kBlindAfter_us = 40'000;
// A track that has not been sound for so long may be of something else.
constexpr std::int64_t kDoubtfulAfter_us = 20'000;
// What is known of the puck's events is learned from a track of this quality.
constexpr double kLearnable = 0.7;
// Of what is worse than this a search may find the puck in the very place where the track is.
constexpr double kPoor = 0.6;
// Steps in which the height of its wall, in widths, is followed, and is searched for.
constexpr double kWallStep = 0.003;
constexpr double kSearchedWallStep = 0.015;
// How far around the puck events may be its own.
constexpr int kPuckMargin_px = 6;
// How far the events of a puck may lie beyond where its centre is searched for.
constexpr int kSearchMargin_px = 40;
// How many events ahead what is remembered of a pixel is fetched.
constexpr std::size_t kFetchedAhead = 8;

}  // namespace

ContourPipeline::ContourPipeline(SensorSize sensor, const ContourPipelineParams& params,
                                 const Region& detection_region, const PuckSizeModel& size_model)
    : sensor_(sensor),
      params_(params),
      context_{PuckContour(sensor, size_model, params.calibration, params.ingredients.shear),
               params.filter,
               params.ingredients,
               {}},
      history_(sensor),
      standing_(sensor, params.coast_us),
      search_plan_(sensor, detection_region),
      seen_score_(sensor),
      background_(sensor),
      noise_floor_(sensor),
      side_watch_(sensor),
      events_needed_(Region::all_of(sensor)),
      near_(events_needed_),
      measures_noise_(params.ingredients.noise_floor) {
  context_.filter.follows_size = params.ingredients.size_state;
  context_.is_first = true;
  found_.candidates.reserve(PuckDetector::kMostDetections);
}

void ContourPipeline::take(Timestamp start, std::span<const Event> events) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (i + kFetchedAhead < events.size()) history_.fetch(events[i + kFetchedAhead]);
    const std::int64_t time_us = (start + events[i].offset_us).us;
    decide_before(time_us);
    take_event(events[i], time_us);
  }
}

void ContourPipeline::take_event(const Event& event, std::int64_t time_us) {
  now_us_ = std::max(now_us_, time_us);
  const bool first = history_.is_first(event, time_us);
  if (first) search_plan_.take(event.x, event.y);
  if (measures_noise_) noise_floor_.take(event.x, event.y);
  if (watches_background_ && !puck_.contains(event.x, event.y)) {
    background_.take(event.x, event.y);
  }
  if (!near_.contains(event.x, event.y)) return;
  const ContourEvent seen{time_us,
                          static_cast<double>(event.x),
                          static_cast<double>(event.y),
                          event.polarity != 0,
                          first,
                          background_.is_still(event.x, event.y)};
  // A puck of good contrast has so many events that it would only lose by leaving some out.
  if (seen.still && context_.signature.is_faint()) return;
  if (main_) witness_.take(event.x, event.y);
  left_behind_.take(seen.x, seen.y);
  wall_height_.take(seen);
  const double worth = main_ ? main_->take(seen, context_) : 0;
  twins_.take(worth);
  challengers_.take(seen, worth, context_);
  missed_.take(seen, worth);
}

void ContourPipeline::decide_before(std::int64_t time_us) {
  const std::int64_t due_us = decision_before(time_us, params_.decision_us);
  if (due_us > decided_us_) decide(due_us);
}

void ContourPipeline::decide(std::int64_t time_us) {
  now_us_ = std::max(now_us_, time_us);
  noise_floor_.decide(time_us, measures_noise_);
  context_.noise_per_pixel_us = noise_floor_.per_pixel_us();
  if (watches_background_) background_.decide(time_us, context_.noise_per_pixel_us);
  if (main_) {
    judge_main(time_us);
    if (!scene_rest_.is_held()) stop_if_silent(*main_, context_, time_us);
    // While the head turns, a faint puck makes events at rest, too; of others it is not known that
    // the head turns.
    if (!head_turns() && settling_.settle(*main_, context_, trust_.was_covered(), time_us)) {
      witness_.put(main_->filter().position(), time_us);
    }
    watch_exit(time_us);
    return_if_left_behind(time_us);
    if (held_rest_.is_held() || scene_rest_.is_held()) {
      witness_.put(main_->filter().position(), time_us);
    } else {
      witness_.consult(*main_, context_, time_us, challengers_);
    }
    if (held_rest_.is_held()) {
      challengers_.dismiss_born();
    } else {
      twins_.bear_at_rest(*main_, context_, time_us, challengers_);
    }
    twins_.bear_of_other_wall(*main_, context_, time_us, challengers_);
  }
  challengers_.decide(time_us, context_);
  if (main_) {
    challenge_main(time_us);
  } else {
    find_first(time_us);
  }
  if (main_) {
    const TrackLooks looks = main_->looks();
    standing_.judge(looks, witness_.is_near(looks.position, context_), head_turns(), trust_,
                    time_us);
  }
  plan_search(time_us);
  plan_events(time_us);
  watch_sides(time_us);
  decided_us_ = time_us;
}

void ContourPipeline::judge_main(std::int64_t time_us) {
  const std::int64_t passed_us = time_us - decided_us_;
  main_->decide(time_us, trust_.since_good_us(time_us) > kBlindAfter_us, context_);
  const PuckSignature::Sample sample = main_->take_sample();
  held_rest_.hold(*main_, standing_, context_, time_us);
  if (held_rest_.is_held()) {
    scene_rest_.forget();
  } else {
    scene_rest_.hold(*main_, background_, context_, time_us);
  }
  if (scene_rest_.is_held() && standing_.state() == TrackState::kTracking && trust_.is_believed()) {
    standing_.note_seen(time_us);
  }
  if (keeps_still()) {
    main_->park();
    if (standing_.has_settled(time_us)) witness_.draw_to(main_->filter().position(), passed_us);
  }
  trust_.judge(main_->looks(), seen_score_.value(), is_unseen(time_us), time_us, passed_us);
  context_.is_trusted = trust_.is_trusted();
  context_.is_plain = shows_plain_face();
  if (trust_.is_exhausted()) forget_looks();
  if (main_->is_good() && main_->shape_quality() > kLearnable) {
    context_.signature.learn(sample, passed_us);
    if (context_.ingredients.faint_memory && trust_.is_surely_puck()) {
      context_.signature.confirm(passed_us);
    }
  }
  if (shows_wall()) {
    sought_wall_.learn(context_.contour.is_other_wall(main_->wall_share()), passed_us);
  }
  learn_wall_height(passed_us);
}

void ContourPipeline::watch_sides(std::int64_t time_us) {
  std::optional<Pixel> puck = standing_.left_image();
  if (!puck && main_ && trust_.is_surely_puck()) puck = main_->filter().position();
  side_watch_.note(puck, time_us);
  context_.may_be_aside = side_watch_.may_be_aside(time_us);
}

// What was learned of the puck may be of something else.
void ContourPipeline::forget_looks() {
  context_.signature.forget();
  wall_height_ = {};
  searched_wall_share_ = 0;
  context_.contour.forget_other_wall_share();
}

void ContourPipeline::watch_exit(std::int64_t time_us) {
  const ContourFilter& filter = main_->filter();
  const bool is_surely_puck =
      trust_.is_surely_puck() && trust_.since_good_us(time_us) < kDoubtfulAfter_us;
  const bool has_left = way_back_.reach(time_us).has_value();
  if (has_left && is_surely_puck && main_->is_good() && is_in_image(filter.position(), sensor_)) {
    way_back_.forget();
  }
  if (!stop_beyond_image(*main_, context_, sensor_, now_us_)) return;
  if (!context_.ingredients.way_back) return;
  // What spoke for it in the image must not keep it from being looked for where it comes back.
  main_->forget_evidence();
  if (!is_surely_puck || has_left) return;
  way_back_.note_left(filter.position(), time_us);
  // Those that have gone out with it would now look better than it does.
  challengers_.dismiss_outside(sensor_);
}

// Where the annotations show the wall, or it was calibrated, its height is known.
void ContourPipeline::learn_wall_height(std::int64_t passed_us) {
  PuckContour& contour = context_.contour;
  if (!context_.ingredients.wall || !context_.ingredients.wall_height ||
      contour.other_wall_share() >= 0) {
    return;
  }
  const bool is_puck = trust_.is_surely_puck() && main_->is_good();
  wall_height_.watch(is_puck ? &*main_ : nullptr, contour, passed_us);
  const std::optional<double> height = wall_height_.share();
  if (height && std::abs(*height + contour.other_wall_share()) > kWallStep) {
    contour.correct_other_wall_share(-*height);
    if (std::abs(*height + searched_wall_share_) > kSearchedWallStep) {
      searched_wall_share_ = -*height;
    }
  }
}

void ContourPipeline::return_if_left_behind(std::int64_t time_us) {
  const LeftBehind::Situation now{
      .is_sure = trust_.is_surely_puck() && standing_.state() == TrackState::kTracking,
      .is_resting = standing_.is_resting(),
      .sensor = sensor_};
  if (left_behind_.bring_back(*main_, now, context_, time_us)) held_rest_.seize(context_, time_us);
  if (left_behind_.is_there()) standing_.note_seen(time_us);
}

bool ContourPipeline::is_unseen(std::int64_t time_us) const {
  return standing_.is_resting() || (context_.ingredients.silent_trust &&
                                    is_silent_puck(main_->looks(), trust_.since_good_us(time_us)));
}

// A faint puck's track is seldom sound; of others a mallet's may be good for a moment.
bool ContourPipeline::shows_wall() const {
  if (!trust_.is_trusted() || !trust_.is_proven()) return false;
  const TrackLooks looks = main_->looks();
  return context_.signature.may_be_faint() ? looks.is_good()
                                           : looks.quality > TrackTrust::kSound && looks.is_fast();
}

// Another puck may lie or come elsewhere while this one rests or is lost; and of a faint one hardly
// anything would be left while what passes over it counts as clutter.
bool ContourPipeline::shows_plain_face() const {
  const PuckSignature& signature = context_.signature;
  return context_.ingredients.plain_face && context_.is_trusted &&
         standing_.state() == TrackState::kTracking && !standing_.is_resting() &&
         signature.has_plain_face() && signature.had_contrast();
}

void ContourPipeline::challenge_main(std::int64_t time_us) {
  const TrackLooks looks = main_->looks();
  const Defence defence{.looks = looks,
                        .is_trusted = context_.is_trusted,
                        .is_proven = trust_.is_proven(),
                        .may_be_overtaken = context_.ingredients.overtaking,
                        .knows_pucks = context_.ingredients.recognition,
                        .is_resting = keeps_still(),
                        .lies_in_scene = scene_rest_.is_held(),
                        .is_lost = standing_.state() != TrackState::kTracking,
                        .was_covered = trust_.was_covered(),
                        .is_witnessed = witness_.vouches(looks.position, context_),
                        .may_be_faint = rest_may_be_wrong(),
                        .had_contrast = context_.signature.had_contrast(),
                        .way_back = way_back_.reach(time_us),
                        .score = seen_score_.value(),
                        .since_good_us = trust_.since_good_us(time_us),
                        .since_sound_us = trust_.since_sound_us(time_us)};
  if (const Challenger* successor = challengers_.successor(defence, claim_context(), time_us)) {
    enthrone(*successor, time_us);
    return;
  }
  challengers_.dismiss_hopeless(time_us, head_rests());
  challengers_.dismiss_idle(main_->filter(), time_us);
}

// A hand that has drawn the map may stay on it for a moment, so that the background is asked only
// where it must be.
bool ContourPipeline::head_turns() const {
  return consults_background_ && background_.head_turns();
}

bool ContourPipeline::head_rests() const { return watches_closely_ && background_.head_rests(); }

ClaimContext ContourPipeline::claim_context() const {
  const ContourIngredients& ingredients = context_.ingredients;
  const bool asks_for_turn =
      ingredients.own_motion && ingredients.background && consults_background_;
  return {.head_rests = ingredients.slow_movers && head_rests(),
          .at_once = ingredients.at_once,
          .face_print = ingredients.face_print,
          .scene_rests = ingredients.scene_rests,
          .head_may_turn = asks_for_turn && !background_.head_rests(),
          .background = asks_for_turn ? &background_ : nullptr};
}

// A faint puck falls silent while it moves, too.
bool ContourPipeline::rest_may_be_wrong() const {
  return context_.ingredients.faint_rests ? context_.signature.may_be_faint()
                                          : context_.signature.is_faint();
}

// It may be at the puck, and yet of a wrong size that it does not get rid of.
bool ContourPipeline::is_tried_afresh() const {
  return context_.ingredients.afresh && !keeps_still() && main_->quality() < kPoor;
}

void ContourPipeline::find_first(std::int64_t time_us) {
  const std::int64_t searched_us = search_plan_.searched_us(time_us);
  if (const Challenger* first = challengers_.first(claim_context(), searched_us, time_us)) {
    enthrone(*first, time_us);
    return;
  }
  challengers_.dismiss_hopeless(time_us, false);
}

void ContourPipeline::enthrone(const Challenger& challenger, std::int64_t time_us) {
  // A twin is only likely to be right, so that the clock since the last good track runs on.
  const Challenger::Kind kind = challenger.kind();
  if (kind != Challenger::Kind::kTwin) trust_.note_takeover(time_us);
  if (kind == Challenger::Kind::kSearch) {
    const auto reach = way_back_.reach(time_us);
    if (reach && !reach->contains(challenger.track().filter().position())) way_back_.forget();
    const auto deposed = main_ ? std::optional(main_->looks()) : std::nullopt;
    trust_.note_found(is_weakly_found(claim_of(challenger, claim_context(), time_us), deposed),
                      time_us);
    witness_.put(challenger.track().filter().position(), time_us);
  }
  // Twins are where the track is.
  if (kind == Challenger::Kind::kSearch || kind == Challenger::Kind::kWitness) {
    seen_score_.begin(challenger.found().score);
  }
  main_ = challenger.track();
  context_.is_first = false;
  held_rest_.forget();
  scene_rest_.forget();
  settling_.forget();
  // What the search found may be the puck all the same, while twins of a wrong track go on
  // succeeding one another.
  if (kind == Challenger::Kind::kSearch) {
    challengers_.clear();
    missed_.end();
  } else {
    challengers_.dismiss_born();
  }
  // What the search found may be another puck than the one that rested; and where one rests depends
  // on what its wall is taken to be.
  if (kind == Challenger::Kind::kSearch || kind == Challenger::Kind::kWall) left_behind_.forget();
}

void ContourPipeline::plan_search(std::int64_t time_us) {
  if (!main_) {
    search_plan_.plan_first(time_us);
    return;
  }
  search_plan_.plan(
      {.main = main_->looks(),
       .is_lost = standing_.state() == TrackState::kLost,
       .is_resting = standing_.is_resting(),
       .is_trusted = context_.is_trusted,
       .is_proven = trust_.is_proven(),
       .may_rest_elsewhere =
           (context_.ingredients.overtaking && (trust_.was_covered() || !trust_.is_proven())) ||
           (context_.ingredients.faint_rests && context_.signature.may_be_faint()),
       .may_be_faint = context_.signature.may_be_faint(),
       .since_good_us = trust_.since_good_us(time_us),
       .unsound_us = trust_.unsound_us()},
      context_.ingredients, time_us);
}

void ContourPipeline::plan_events(std::int64_t time_us) {
  const Region image = Region::all_of(sensor_);
  const bool awaits = standing_.state() == TrackState::kLost && search_plan_.is_still(time_us);
  // A puck of good contrast is followed without it; but what stands still must be known by the time
  // that a mark may be taken for it.
  consults_background_ = !main_ || !context_.is_trusted || context_.signature.is_faint();
  const bool is_doubtful = trust_.since_sound_us(time_us) > kDoubtfulAfter_us;
  const bool is_wanted = consults_background_ || context_.ingredients.early_background;
  watches_closely_ = consults_background_ || is_doubtful;
  watches_background_ = context_.ingredients.background && is_wanted &&
                        (watches_closely_ || !background_.may_nap(time_us));
  if (!is_wanted) background_.forget();
  near_ = !main_ || awaits ? image
                           : region_of_tracks(*main_, challengers_, witness_.position(),
                                              context_.contour, sensor_);
  near_ = near_.united(left_behind_.region()).intersect(image);
  // What is found will have events to catch up on, as many as are kept.
  const Region searched = search_plan_.searched();
  if (!searched.empty() && missed_.has_room()) {
    near_ = near_.united(searched.inflated(kSearchMargin_px)).intersect(image);
  }
  events_needed_ = watches_background_ ? image : near_;
  measures_noise_ = context_.ingredients.noise_floor && events_needed_ == image;
  puck_ = {};
  if (main_ && main_->is_good()) {
    const Pixel position = main_->filter().position();
    const PuckSize size = context_.contour.size_at(position);
    puck_ = Region::around(position, static_cast<int>(size.width), static_cast<int>(size.height))
                .inflated(kPuckMargin_px);
  }
}

SearchRequest ContourPipeline::search_wanted() {
  SearchRequest request{.region = search_plan_.give_out(),
                        .fresh_only = context_.ingredients.fresh_search};
  if (request.region.empty()) return request;
  missed_.begin(request.region.inflated(kSearchMargin_px));
  if (context_.ingredients.wall && context_.ingredients.wall_search) {
    const PuckSignature& signature = context_.signature;
    request.other_wall =
        sought_wall_.next({.is_early = !main_ && search_plan_.searched_us(now_us_) < kPatience_us,
                           .is_trusted = context_.is_trusted,
                           .may_be_faint = signature.may_be_faint()});
    request.other_wall_share = searched_wall_share_;
  }
  return request;
}

void ContourPipeline::take(const SearchResult& result) {
  search_plan_.note_answer();
  found_ = result;
  if (context_.ingredients.sighting_trails) {
    trails_.take(found_, context_.contour, background_, head_rests());
  }
  // Of a puck of good contrast its events tell more; and before there is a track, what moves is a
  // hand rather than the puck.
  if (!main_ || !rest_may_be_wrong()) {
    for (SearchCandidate& candidate : found_.candidates) candidate.trail = {};
  }
  std::optional<Pixel> main;
  if (main_) {
    main = main_->filter().position_at(found_.time.us);
    seen_score_.note(found_, *main, context_.contour.is_other_wall(main_->wall_share()));
    correct_by(*main);
  }
  const bool keeps_clear =
      context_.ingredients.clear_rings && main_ &&
      (!context_.signature.knows_multiplicity() || context_.signature.may_be_faint());
  put_still_last(found_, background_, context_.contour, keeps_clear ? kClearRingScore : 1);
  put_followed_first(found_);
  const bool is_conjecture = found_.request.other_wall && sought_wall_.is_conjecture();
  challengers_.add_found({.result = found_,
                          .is_conjecture = is_conjecture,
                          .main = main_ && is_tried_afresh() ? std::nullopt : main,
                          .missed = missed_.events(),
                          .can_catch_up = missed_.are_kept(),
                          .time_us = now_us_,
                          .period_us = params_.decision_us,
                          .decided_us = decided_us_},
                         context_);
  missed_.end();
}

// `main`: where the track was when the search's snapshot was taken.
void ContourPipeline::correct_by(Pixel main) {
  if (!context_.ingredients.sightings || keeps_still() || scene_rest_.is_held() ||
      main_->is_good()) {
    return;
  }
  const auto seen = sighting_near(main, main_->wall_share(), found_, context_.contour);
  if (!seen) return;
  main_->correct_place(seen->place.x - main.x, seen->place.y - main.y, context_);
  if (!seen->is_sure) return;
  trust_.note_seen(now_us_);
  if ((standing_.state() == TrackState::kTracking || seen->is_certain) && trust_.is_believed()) {
    standing_.note_seen(now_us_);
  }
}

PuckEstimate ContourPipeline::step(const SurfaceSnapshot& snapshot) {
  const std::int64_t time_us = std::max(now_us_, snapshot.newest_event.us);
  decide_before(time_us);
  PuckEstimate estimate;
  estimate.state = standing_.state();
  estimate.newest_event = {time_us};
  estimate.events_applied = snapshot.events_applied;
  estimate.region = events_needed_;
  estimate.left_image = standing_.left_image();
  if (standing_.state() != TrackState::kTracking || !main_) return estimate;

  ContourFilter filter = main_->filter();
  filter.predict(time_us, false);
  estimate.position = filter.position();
  estimate.velocity = filter.velocity();
  estimate.covariance = honest_covariance(filter, context_.signature);
  estimate.size = context_.contour.size_at(filter.position());
  estimate.score = std::clamp(main_->quality(), 0.0, 1.0);
  estimate.resting = standing_.is_resting();
  estimate.coasting = !main_->is_good() && !standing_.is_resting();
  return estimate;
}

}  // namespace puck
