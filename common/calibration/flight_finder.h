#pragma once

#include <vector>

#include "common/events/timestamp.h"
#include "common/table/table_geometry.h"
#include "common/table/table_point.h"

namespace puck {

/// Where a puck was on the table, measured.
struct TrackPoint {
  Timestamp t;
  TablePoint position;
};

/// Places at growing times, between which only gliding and bounces at the rails moved the puck.
using Flight = std::vector<TrackPoint>;

/// The flights in a track: it is cut at gaps, at times that go back, in and before the goals'
/// mouths where the posts are, and wherever the velocity changes away from the rails, which is a
/// mallet's doing. What a mallet does right beside a rail is not told from a bounce. Flights are at
/// most 0.8 s long, move at 0.2 m/s or more on average, and have a point every 4 ms or less often.
std::vector<Flight> find_flights(const std::vector<TrackPoint>& track, const TableGeometry& table);

}  // namespace puck
