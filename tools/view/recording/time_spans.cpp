#include "tools/view/recording/time_spans.h"

#include <algorithm>

namespace puck {

void TimeSpans::add(Timestamp begin, Timestamp end) {
  // The spans from `first` up to `last` join the new one.
  const auto first =
      std::lower_bound(spans_.begin(), spans_.end(), begin,
                       [&](const Span& span, Timestamp t) { return span.end + join_us_ < t; });
  auto last = first;
  for (; last != spans_.end() && last->begin <= end + join_us_; ++last) {
    begin = std::min(begin, last->begin);
    end = std::max(end, last->end);
  }
  if (first == last) {
    spans_.insert(first, {begin, end});
    return;
  }
  *first = {begin, end};
  spans_.erase(first + 1, last);
}

std::optional<TimeSpans::Span> TimeSpans::after(Timestamp time) const {
  const auto found = std::upper_bound(spans_.begin(), spans_.end(), time,
                                      [](Timestamp t, const Span& span) { return t < span.begin; });
  if (found == spans_.end()) return std::nullopt;
  return *found;
}

std::optional<TimeSpans::Span> TimeSpans::before(Timestamp time) const {
  const auto beyond =
      std::lower_bound(spans_.begin(), spans_.end(), time,
                       [](const Span& span, Timestamp t) { return span.begin < t; });
  if (beyond == spans_.begin()) return std::nullopt;
  return *(beyond - 1);
}

Timestamp TimeSpans::end_around(Timestamp time) const {
  const auto beyond =
      std::upper_bound(spans_.begin(), spans_.end(), time,
                       [](Timestamp t, const Span& span) { return t < span.begin; });
  if (beyond == spans_.begin()) return time;
  return std::max(time, (beyond - 1)->end);
}

}  // namespace puck
