#pragma once

#include <vector>

#include "common/events/timestamp.h"
#include "common/table/table_geometry.h"
#include "common/table/table_point.h"

namespace puck {

/// A measured position of a puck on the table.
struct TrackPoint {
  Timestamp t;
  TablePoint position;
};

/// Positions at increasing times between which only gliding and rail bounces moved the puck.
using Flight = std::vector<TrackPoint>;

/// The flights in a track. It is cut at gaps, at times that go back, in and before the goals'
/// mouths, and wherever the velocity changes away from the rails, which only a mallet causes. A
/// mallet's hit right beside a rail is not distinguished from a bounce. Flights are at most 0.8 s
/// long, have a mean speed of 0.2 m/s or more, and points at least 4 ms apart.
std::vector<Flight> find_flights(const std::vector<TrackPoint>& track, const TableGeometry& table);

}  // namespace puck
