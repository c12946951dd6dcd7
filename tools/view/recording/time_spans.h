#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/timestamp.h"
#include "tools/view/interface/view_state.h"

namespace puck {

/// A set of times, as spans in their order that neither touch nor overlap. One thread.
class TimeSpans {
 public:
  using Span = ViewTimeline::Span;

  /// Spans with a gap of at most `join_us` become one.
  explicit TimeSpans(std::int64_t join_us) : join_us_(join_us) {}

  void add(Timestamp begin, Timestamp end);
  void clear() { spans_.clear(); }

  /// The first span that begins after `time`.
  std::optional<Span> after(Timestamp time) const;
  /// The last span that begins before `time`.
  std::optional<Span> before(Timestamp time) const;
  /// End of the span that contains `time`; `time` itself if none does.
  Timestamp end_around(Timestamp time) const;

  const std::vector<Span>& spans() const { return spans_; }

 private:
  std::int64_t join_us_;
  std::vector<Span> spans_;
};

}  // namespace puck
