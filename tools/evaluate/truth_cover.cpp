#include "tools/evaluate/truth_cover.h"

#include <cstdint>
#include <cstdio>

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

std::optional<std::string> truth_warning(const AccuracyScore& score, const RunSummary& run) {
  const TruthTrack& truth = score.truth();
  const std::string spans = "the truth goes " + span_text(truth.first(), truth.last()) +
                            ", the events " + span_text(run.first, run.last);
  if (score.samples().empty()) {
    return spans + ": not one tick counts; is the puck ever seen, and is it the right truth?";
  }
  if (truth.first() - run.first > kSlackUs || run.last - truth.last() > kSlackUs) {
    return spans + ": only the ticks that the truth covers count";
  }
  return std::nullopt;
}

}  // namespace puck
