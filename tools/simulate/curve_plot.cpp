#include "tools/simulate/curve_plot.h"

#include <algorithm>
#include <limits>

#include "common/plot/chart.h"

namespace puck {

void CurvePlot::save(const std::filesystem::path& path) const {
  double least_x = std::numeric_limits<double>::infinity();
  double most_x = 0;
  double least_y = 0;
  double most_y = 1e-9;
  for (const Curve& curve : curves_) {
    for (const Curve::Point& point : curve.points) {
      least_x = std::min(least_x, point.x);
      most_x = std::max(most_x, point.x);
      least_y = std::min(least_y, point.y);
      most_y = std::max(most_y, point.y);
    }
  }
  Axis y = axis_from_zero("", most_y);
  y.from = least_y;
  Chart chart(
      title_,
      log_x_ ? logarithmic_axis(x_label_, least_x, most_x) : axis_from_zero(x_label_, most_x), y);
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    std::vector<Chart::Point> line;
    for (const Curve::Point& point : curves_[i].points) line.push_back({point.x, point.y});
    chart.line(line, series_ink(i));
    chart.legend(curves_[i].name, series_ink(i));
  }
  chart.save(path);
}

}  // namespace puck
