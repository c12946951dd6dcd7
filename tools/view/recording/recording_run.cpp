#include "tools/view/recording/recording_run.h"

#include <algorithm>
#include <cstddef>

#include "tools/view/drawing/track_marks.h"

namespace puck {
namespace {

constexpr const char* kNoLoggedTable = "no table: the log holds no trajectory and no game so far";
constexpr const char* kNoTracks = "no tracker: choose one to see its puck on the table";

Timestamp tick_from(Timestamp time, std::int64_t period_us) {
  return {(time.us + period_us - 1) / period_us * period_us};
}

}  // namespace

RecordingRun::RecordingRun(const OpenedRecording& recording)
    : recording_(recording), events_(recording.open_events()) {
  if (recording.is_log()) logged_.emplace(recording.path(), recording.prefix());
  chosen_.fill(kNoTracker);
  start(recording.first());
}

void RecordingRun::choose(int side, const std::string& name) {
  recording_.setup_of(name);
  const auto at = static_cast<std::size_t>(side);
  if (chosen_[at] == name) return;
  chosen_[at] = name;
  losses_[at].clear();
  examined_[at].clear();
}

bool RecordingRun::keep_surface(int side) {
  const auto at = static_cast<std::size_t>(side);
  if (keeps_surface_[at]) return false;
  keeps_surface_[at] = true;
  surfaces_[at].emplace(recording_.sensor(), sides_[at]->surface_params());
  return true;
}

void RecordingRun::start(Timestamp target) {
  ++run_;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    sides_[i] = std::make_unique<SideRun>(recording_, chosen_[i]);
    surfaces_[i].reset();
    if (keeps_surface_[i]) surfaces_[i].emplace(recording_.sensor(), sides_[i]->surface_params());
  }
  events_->rewind();
  cutter_.emplace(*events_);
  if (logged_) logged_->rewind();
  counted_from_ = std::max(target, first());
  from_ = std::max(first(), counted_from_ - kWarmUp_us);
  now_ = from_;
  next_tick_ = tick_from(from_, kTick_us);
  pending_.events.clear();
  newest_.reset(recording_.sensor());
  sample_events_ = 0;
  samples_.clear();
}

RecordingRun::Progress RecordingRun::step(Timestamp until) {
  const std::optional<Timestamp> next = cutter_->next_time();
  if (next && *next < from_) {
    cutter_->take_until(from_ - 1, piece_);
    return Progress::kAdvanced;
  }
  // The trackers still get the events since the last tick, and a log may go on without events.
  if (!next && pending_.empty() && !(logged_ && logged_->has_more(now_))) return Progress::kEnded;
  const Timestamp target = std::min(until, next_tick_);
  if (next && *next <= target) {
    cutter_->take_until(target, piece_);
    take(piece_);
    return Progress::kAdvanced;
  }
  now_ = target;
  if (target == next_tick_) {
    tick(target);
    next_tick_ = target + kTick_us;
  }
  return target == until ? Progress::kReached : Progress::kAdvanced;
}

void RecordingRun::take(const EventPacket& piece) {
  newest_.update(piece);
  for (auto& surface : surfaces_) {
    if (surface) surface->update(piece);
  }
  if (pending_.empty()) pending_.start = piece.time_of(piece.events.front());
  for (Event event : piece.events) {
    event.offset_us = static_cast<std::uint32_t>(piece.time_of(event) - pending_.start);
    pending_.events.push_back(event);
  }
}

void RecordingRun::tick(Timestamp tick) {
  if (logged_) logged_->advance_to(tick);
  const std::optional<PuckEstimate> none;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    SideRun& side = *sides_[i];
    if (!pending_.empty()) side.update(pending_);
    side.tick(tick, logged_ ? logged_->estimate() : none);
    if (tick < counted_from_ || side.track().name.empty()) continue;
    examined_[i].add(tick, tick);
    if (side.is_lost().value_or(false)) losses_[i].add(tick, tick);
  }
  sample_events_ += static_cast<std::int64_t>(pending_.events.size());
  pending_.events.clear();
  if (tick.us % ChartSample::kPeriod_us == 0) add_sample(tick);
}

void RecordingRun::add_sample(Timestamp tick) {
  while (!samples_.empty() && tick - samples_.front().time > ChartSample::kKept_us) {
    samples_.pop_front();
  }
  ChartSample& sample = samples_.emplace_back();
  sample.time = tick;
  sample.events_per_s = static_cast<double>(sample_events_) * (1e6 / ChartSample::kPeriod_us);
  sample_events_ = 0;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const std::optional<PuckEstimate>& estimate = sides_[i]->track().estimate;
    if (!estimate) continue;
    sample.tracks[i] = {.position = estimate->position,
                        .error_px = sides_[i]->error_px(),
                        .score = estimate->score,
                        .state = estimate->state,
                        .is_doubtful = is_doubtful(*estimate)};
  }
  if (const auto truth = truth_at(tick)) sample.truth = truth->centre;
}

std::optional<TruthRow> RecordingRun::truth_at(Timestamp time) const {
  if (recording_.truth() == nullptr) return std::nullopt;
  return recording_.truth()->at(time, recording_.truth_gap_us());
}

void RecordingRun::fill(const PictureWishes& wishes, ViewScene& scene) const {
  const auto side = static_cast<std::size_t>(std::clamp(wishes.side, 0, kViewSides - 1));
  scene.sensor = recording_.sensor();
  scene.time = now_;
  scene.seconds = static_cast<double>(now_ - first()) * 1e-6;
  scene.no_backdrop.clear();
  if (wishes.view == PictureWishes::View::kTable) {
    fill_table(side, scene);
    return;
  }
  if (wishes.backdrop == PictureWishes::Backdrop::kEvents) {
    scene.events = newest_;
  } else if (wishes.backdrop == PictureWishes::Backdrop::kHeatMap &&
             recording_.size_model() == nullptr) {
    scene.no_backdrop = "no heat map without a size model: give one with --size-model";
  } else if (surfaces_[side]) {
    surfaces_[side]->snapshot(Region::all_of(scene.sensor), snapshot_);
    scene.surface = snapshot_.grey;
  } else {
    scene.no_backdrop = "the surface is being built";
  }
  for (std::size_t i = 0; i < sides_.size(); ++i) scene.tracks[i] = sides_[i]->track();
  scene.truth = truth_at(now_);
}

void RecordingRun::fill_table(std::size_t side, ViewScene& scene) const {
  scene.table.reset();
  const ViewTable* logged = logged_ && logged_->table() ? &*logged_->table() : nullptr;
  const ViewTable* own = sides_[side]->table();
  if (own == nullptr) {
    if (logged != nullptr) {
      scene.table = *logged;
    } else {
      scene.no_table = recording_.no_table().empty() ? kNoTracks : recording_.no_table();
      if (recording_.is_log()) scene.no_table = kNoLoggedTable;
    }
    return;
  }
  scene.table = *own;
  if (logged != nullptr) {
    // What the trackers do not tell.
    scene.table->mallet_y_m = logged->mallet_y_m;
    scene.table->truth = logged->truth;
  } else if (const auto truth = truth_at(now_); truth && is_visible(*truth)) {
    scene.table->truth = recording_.table()->table_from_image.to_table(truth->centre);
  }
}

}  // namespace puck
