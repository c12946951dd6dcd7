#include "tools/evaluate/scoring.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace puck {
namespace {

constexpr std::int64_t kSlackUs = 100'000;

std::string span_text(Timestamp first, Timestamp last) {
  char text[80];
  std::snprintf(text, sizeof text, "from %.3f to %.3f s", static_cast<double>(first.us) * 1e-6,
                static_cast<double>(last.us) * 1e-6);
  return text;
}

}  // namespace

Scoring::Scoring(const EvaluateOptions& options, std::vector<TruthRow> truth, SensorSize sensor)
    : at_marks_alone_(options.score_at_marks), no_puck_(options.no_puck) {
  if (options.scoring == "paper" && options.as_fast_as_possible) {
    throw std::invalid_argument("--scoring paper needs ticks: not --as-fast-as-possible");
  }
  if (options.scoring == "paper" && (options.accuracy.settle_us || options.has_truth_gap)) {
    throw std::invalid_argument(
        "--settle-ms and --truth-gap-ms belong to --scoring ours: the paper's rules have neither");
  }
  if (no_puck_ && options.as_fast_as_possible) {
    throw std::invalid_argument("--no-puck needs ticks: not --as-fast-as-possible");
  }
  if (truth.empty()) {
    if (at_marks_alone_) throw std::invalid_argument("--score-at-marks needs --truth");
    if (options.scoring == "paper") throw std::invalid_argument("--scoring paper needs --truth");
    return;
  }
  TruthTrack track(std::move(truth));
  if (at_marks_alone_) {
    for (const TruthRow& row : track.rows()) marks_.push_back(row.time);
  }
  if (options.scoring == "paper") {
    paper_.emplace(std::move(track));
  } else {
    ours_.emplace(std::move(track), sensor, options.accuracy);
  }
}

void Scoring::add(const EvaluatedTick& tick) {
  ++ticks_;
  if (tick.estimate.state == TrackState::kTracking) ++tracking_;
  if (at_marks_alone_ && !tick.is_mark) return;
  if (ours_) ours_->add(tick.tick, tick.estimate);
  if (paper_) paper_->add(tick.tick, tick.estimate);
}

void Scoring::write_to(EvaluationReport& report) const {
  if (ours_) {
    report.accuracy = ours_->report();
    report.errors = report.accuracy;
    report.scoring = "ours";
    report.said_and_wrong_percent = report.accuracy->said_and_wrong_percent;
  }
  if (paper_) {
    report.paper = paper_->report();
    report.errors = report.paper;
    report.scoring = "paper";
  }
  if (no_puck_ && ticks_ > 0) {
    report.said_and_wrong_percent =
        100 * static_cast<double>(tracking_) / static_cast<double>(ticks_);
  }
}

std::vector<ScoredEstimate> Scoring::samples() const {
  if (paper_) return paper_->samples();
  return ours_ ? ours_->samples() : std::vector<ScoredEstimate>{};
}

std::vector<std::string> Scoring::warnings(const EvaluationReport& report) const {
  const RunSummary& run = report.run;
  std::vector<std::string> lines;
  if (truth() == nullptr) return lines;
  const std::string spans = "the truth goes " + span_text(truth()->first(), truth()->last()) +
                            ", the events " + span_text(run.first, run.last);
  if (report.accuracy && report.accuracy->truth_gap_percent > 0) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "%.1f %% of the ticks within the truth do not count, as its rows are too far "
                  "apart (%.0f ms at most): see --truth-gap-ms and --score-at-marks",
                  report.accuracy->truth_gap_percent, static_cast<double>(longest_gap_us()) / 1000);
    lines.emplace_back(text);
  }
  if (is_of_another_time(run)) {
    lines.push_back(spans + ": they do not overlap; truth must be on the recording's own clock");
  } else if (report.errors->estimates == 0) {
    lines.push_back(spans +
                    ": not one tick counts; is the puck ever visible, and is it the right truth?");
  } else if (truth()->first() - run.first > kSlackUs || run.last - truth()->last() > kSlackUs) {
    lines.push_back(spans + ": only the ticks that the truth covers count");
  }
  return lines;
}

bool Scoring::is_of_another_time(const RunSummary& run) const {
  return truth() != nullptr && run.events > 0 &&
         (truth()->last() < run.first || truth()->first() > run.last);
}

std::int64_t Scoring::longest_gap_us() const {
  const std::vector<TruthRow>& rows = truth()->rows();
  std::int64_t longest_us = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    longest_us = std::max(longest_us, rows[i].time - rows[i - 1].time);
  }
  return longest_us;
}

}  // namespace puck
