#include "common/calibration/flight_finder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace puck {
namespace {

constexpr std::int64_t kGapUs = 30'000;
// The velocity is compared over this time before and after a moment.
constexpr std::int64_t kLookUs = 25'000;
constexpr std::size_t kFewestLooked = 3;
// Smallest change of the velocity that is not noise: m/s, and as a share of the speed.
constexpr double kChangeMS = 0.2;
constexpr double kChangeOfSpeed = 0.05;
// A change nearer to a rail than this, plus the distance between two points, is a bounce.
constexpr double kBesideRailM = 0.01;
constexpr std::int64_t kLongestUs = 800'000;
constexpr std::int64_t kShortestUs = 100'000;
constexpr std::int64_t kApartUs = 4'000;
constexpr std::size_t kFewestPoints = 8;
constexpr double kSlowestMS = 0.2;

using Points = std::span<const TrackPoint>;

double seconds(Timestamp from, Timestamp to) { return static_cast<double>(to - from) * 1e-6; }

double distance_m(const TablePoint& a, const TablePoint& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

// Slope of the regression line through the points.
TableVelocity slope_of(Points points) {
  const auto n = static_cast<double>(points.size());
  double t = 0;
  double tt = 0;
  double x = 0;
  double y = 0;
  double tx = 0;
  double ty = 0;
  for (const TrackPoint& point : points) {
    const double at = seconds(points.front().t, point.t);
    t += at;
    tt += at * at;
    x += point.position.x_m;
    y += point.position.y_m;
    tx += at * point.position.x_m;
    ty += at * point.position.y_m;
  }
  const double spread = n * tt - t * t;
  return {(n * tx - t * x) / spread, (n * ty - t * y) / spread};
}

class Finder {
 public:
  Finder(Points track, const TableGeometry& table) : track_(track), table_(table) {}

  std::vector<Flight> find() {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < track_.size(); ++i) {
      if (i > begin && track_[i].t - track_[i - 1].t > kGapUs) {
        take(begin, i);
        begin = i;
      }
      if (i > begin && track_[i].t - track_[begin].t > kLongestUs) {
        take(begin, i);
        begin = i;
      }
      if (is_in_mouth(track_[i].position) || is_hit(i)) {
        take(begin, i);
        begin = i + 1;
      }
    }
    take(begin, track_.size());
    return std::move(flights_);
  }

 private:
  // Where goal posts or the open goal may be in the puck's way.
  bool is_in_mouth(const TablePoint& at) const {
    const double to_end_m = std::min(at.x_m, table_.length_m - at.x_m);
    return to_end_m < table_.puck_radius_m + kBesideRailM &&
           std::abs(at.y_m) < table_.goal_width_m / 2 + table_.puck_radius_m;
  }

  double to_rail_m(const TablePoint& at) const {
    return std::min({at.x_m, table_.length_m - at.x_m, table_.width_m / 2 - std::abs(at.y_m)});
  }

  bool is_beside_rail(Points points) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double step_m = i > 0 ? distance_m(points[i - 1].position, points[i].position) : 0.0;
      if (to_rail_m(points[i].position) < table_.puck_radius_m + kBesideRailM + step_m) return true;
    }
    return false;
  }

  bool is_hit(std::size_t at) {
    while (track_[at].t - track_[first_].t > kLookUs) ++first_;
    last_ = std::max(last_, at);
    while (last_ + 1 < track_.size() && track_[last_ + 1].t - track_[at].t <= kLookUs) ++last_;
    const Points before = track_.subspan(first_, at - first_ + 1);
    const Points after = track_.subspan(at, last_ - at + 1);
    if (before.size() < kFewestLooked || after.size() < kFewestLooked) return false;
    if (is_beside_rail(track_.subspan(first_, last_ - first_ + 1))) return false;
    const TableVelocity was = slope_of(before);
    const TableVelocity is = slope_of(after);
    const double speed = std::max(std::hypot(was.x_m_s, was.y_m_s), std::hypot(is.x_m_s, is.y_m_s));
    return std::hypot(is.x_m_s - was.x_m_s, is.y_m_s - was.y_m_s) >
           kChangeMS + kChangeOfSpeed * speed;
  }

  void take(std::size_t begin, std::size_t end) {
    if (end <= begin || track_[end - 1].t - track_[begin].t < kShortestUs) return;
    Flight flight;
    double way_m = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (!flight.empty()) {
        if (track_[i].t - flight.back().t < kApartUs) continue;
        way_m += distance_m(flight.back().position, track_[i].position);
      }
      flight.push_back(track_[i]);
    }
    const double lasted_s = seconds(flight.front().t, flight.back().t);
    if (flight.size() < kFewestPoints || way_m < kSlowestMS * lasted_s) return;
    flights_.push_back(std::move(flight));
  }

  Points track_;
  const TableGeometry& table_;
  std::size_t first_ = 0;  // Index of the first point under consideration.
  std::size_t last_ = 0;
  std::vector<Flight> flights_;
};

}  // namespace

std::vector<Flight> find_flights(const std::vector<TrackPoint>& track, const TableGeometry& table) {
  std::vector<Flight> flights;
  const Points all = track;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= track.size(); ++i) {
    if (i < track.size() && track[i].t > track[i - 1].t) continue;
    for (Flight& flight : Finder(all.subspan(begin, i - begin), table).find()) {
      flights.push_back(std::move(flight));
    }
    begin = i;
  }
  return flights;
}

}  // namespace puck
