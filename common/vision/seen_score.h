#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/pixel.h"
#include "common/vision/region.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// How much like a puck the main track has looked to searches of late.
class SeenScore {
 public:
  explicit SeenScore(SensorSize sensor) : image_(Region::all_of(sensor)) {}

  /// The track is where a search has found it, with this score; 0: where no search has.
  void begin(double score) { score_ = score; }

  /// A search has been made; the track is at `main` and believes `has_other_wall`. One of the other
  /// opinion on the puck's side wall says nothing of the track. What searches do not see again is
  /// forgotten slowly: a puck that hardly moves is often not among what they find. Beyond the image
  /// none can see it.
  void note(const SearchResult& result, Pixel main, bool has_other_wall);

  /// SearchCandidate::score; 0 if there is none.
  double value() const { return score_; }

 private:
  Region image_;
  double score_ = 0;
};

}  // namespace puck
