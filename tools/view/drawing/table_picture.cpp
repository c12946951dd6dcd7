#include "tools/view/drawing/table_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "tools/view/drawing/canvas.h"
#include "tools/view/drawing/palette.h"
#include "tools/view/drawing/picture_bars.h"

namespace puck {
namespace {

constexpr int kScoreBar_px = 34;
constexpr double kScore_px = 13;
constexpr double kNote_px = 10;
// Of the table's ends: room for the goals.
constexpr double kMargin_m = 0.12;
// Share of the path's colour in its band of uncertainty.
constexpr double kBandShare = 0.3;
// The arrow ends at the position predicted this far ahead.
constexpr double kPuckArrow_s = 0.15;
// Wider bands tell nothing.
constexpr double kWidestBand_m = 0.6;

class TableDrawing {
 public:
  TableDrawing(const ViewTable& table, const PictureWishes& wishes, cv::Mat& picture)
      : table_(table),
        palette_(palette_of(wishes.theme)),
        picture_(picture),
        canvas_(picture),
        legend_(legend_of(table, wishes, picture)),
        part_(0, kScoreBar_px, picture.cols,
              std::max(1, picture.rows - kScoreBar_px - legend_height_px(legend_, picture.cols))) {
    const TableGeometry& g = table.geometry;
    is_upright_ = part_.height > part_.width;
    const double across = is_upright_ ? g.width_m : g.length_m;
    const double down = is_upright_ ? g.length_m : g.width_m;
    scale_ =
        std::min(part_.width / (across + 2 * kMargin_m), part_.height / (down + 2 * kMargin_m));
    middle_ = {part_.x + part_.width / 2.0, part_.y + part_.height / 2.0};
  }

  void draw() {
    draw_surface();
    draw_path();
    draw_robot();
    draw_puck();
    // Above the estimate's thicker line, which it may equal.
    if (table_.truth) ring(*table_.truth, palette_.truth, 1, false);
    // Above marks that leave the table.
    draw_score();
    draw_legend(legend_, palette_, picture_);
  }

 private:
  // Empty where it would take too much of the picture.
  static std::vector<LegendEntry> legend_of(const ViewTable& table, const PictureWishes& wishes,
                                            const cv::Mat& picture) {
    using Sample = LegendEntry::Sample;
    const Palette& palette = palette_of(wishes.theme);
    std::vector<LegendEntry> entries{{Sample::kRing, palette.estimate, "puck"},
                                     {Sample::kLine, palette.trail, "path"},
                                     {Sample::kLine, palette.covariance, "crossing"}};
    if (table.mallet_y_m) entries.push_back({Sample::kRing, palette.darker, "mallet"});
    if (table.truth) entries.push_back({Sample::kRing, palette.truth, "truth"});
    if (!wishes.layers.legend || legend_height_px(entries, picture.cols) > picture.rows / 6) {
      entries.clear();
    }
    return entries;
  }

  cv::Point2d at(TablePoint place) const {
    const double along = (place.x_m - table_.geometry.length_m / 2) * scale_;
    const double left = place.y_m * scale_;
    return is_upright_ ? middle_ - cv::Point2d(left, along) : middle_ + cv::Point2d(along, -left);
  }
  void ring(TablePoint place, const cv::Scalar& colour, int width_px, bool doubtful) {
    const double r = table_.geometry.puck_radius_m * scale_;
    canvas_.ellipse(at(place), {r, r}, 0,
                    {.colour = doubtful ? mixed(palette_.background, colour, 0.6) : colour,
                     .width_px = width_px,
                     .dash_px = doubtful ? 4.0 : 0.0});
  }

  // At the table's upper side.
  void note(const std::string& words, const cv::Scalar& colour) {
    const TableGeometry& g = table_.geometry;
    const double half = (is_upright_ ? g.length_m : g.width_m) / 2 * scale_;
    canvas_.text(words, middle_ - cv::Point2d(0, half - 14), kNote_px, colour,
                 Canvas::Align::kMiddle);
  }

  void draw_surface() {
    const TableGeometry& g = table_.geometry;
    const double half = g.width_m / 2;
    const cv::Scalar line = mixed(palette_.background, palette_.quiet, 0.4);
    canvas_.filled_polygon(
        {at({0, half}), at({g.length_m, half}), at({g.length_m, -half}), at({0, -half})},
        palette_.bar);
    canvas_.line(at({g.length_m / 2, half}), at({g.length_m / 2, -half}), {.colour = line});
    const double r = 0.15 * scale_;
    canvas_.ellipse(at({g.length_m / 2, 0}), {r, r}, 0, {.colour = line});
    canvas_.rectangle(at({0, half}), at({g.length_m, -half}),
                      {.colour = palette_.quiet, .width_px = 3});
    const double goal = g.goal_width_m / 2;
    for (const double x : {0.0, g.length_m}) {
      canvas_.line(at({x, goal}), at({x, -goal}), {.colour = palette_.background, .width_px = 7});
    }
    canvas_.line(at({g.robot_line_x_m, g.robot_line_half_m}),
                 at({g.robot_line_x_m, -g.robot_line_half_m}),
                 {.colour = palette_.quiet, .dash_px = 4});
  }

  void draw_score() {
    cv::rectangle(picture_, {0, 0, picture_.cols, kScoreBar_px}, palette_.bar, cv::FILLED);
    const double middle = picture_.cols / 2.0;
    const double y = kScoreBar_px / 2.0;
    char score[40];
    std::snprintf(score, sizeof score, "%d : %d", table_.goals_for, table_.goals_against);
    const double half = Canvas::text_width(score, kScore_px) / 2 + 14;
    canvas_.text(score, {middle, y}, kScore_px, palette_.words, Canvas::Align::kMiddle);
    canvas_.text("robot", {middle - half, y}, kNote_px, palette_.quiet, Canvas::Align::kRight);
    canvas_.text("opponent", {middle + half, y}, kNote_px, palette_.quiet);
    if (picture_.cols < 480) return;
    canvas_.text(table_.phase, {12, y}, kNote_px, palette_.words);
    char saves[60];
    std::snprintf(saves, sizeof saves, "%d of %d shots saved", table_.saves, table_.shots);
    canvas_.text(saves, {picture_.cols - 12.0, y}, kNote_px, palette_.quiet, Canvas::Align::kRight);
  }

  // One standard deviation of the position after a time, in its worst direction.
  double sigma_m(double t_s) const {
    const Matrix4& p = table_.puck.covariance;
    Matrix2 at = p.topLeftCorner<2, 2>() + t_s * t_s * p.bottomRightCorner<2, 2>() +
                 t_s * (p.topRightCorner<2, 2>() + p.bottomLeftCorner<2, 2>());
    const double middle = (at(0, 0) + at(1, 1)) / 2;
    const double spread = std::hypot((at(0, 0) - at(1, 1)) / 2, at(0, 1));
    return std::sqrt(std::max(0.0, middle + spread));
  }

  void draw_path() {
    if (table_.validity == ViewTable::Validity::kNone || table_.path.size() < 2) return;
    const cv::Scalar band = mixed(palette_.bar, palette_.trail, kBandShare);
    std::vector<cv::Point2d> line;
    for (std::size_t i = 0; i < table_.path.size(); ++i) {
      const PathPoint& point = table_.path[i];
      line.push_back(at(point.position));
      const double r = std::min(2 * sigma_m(point.t_s), kWidestBand_m) * scale_;
      canvas_.filled_circle(line.back(), r, band);
      if (i == 0) continue;
      const cv::Point2d way = line[i] - line[i - 1];
      const double length = std::hypot(way.x, way.y);
      if (!(length > 0)) continue;
      const cv::Point2d across(-way.y / length, way.x / length);
      const double before = std::min(2 * sigma_m(table_.path[i - 1].t_s), kWidestBand_m) * scale_;
      canvas_.filled_polygon({line[i - 1] + across * before, line[i] + across * r,
                              line[i] - across * r, line[i - 1] - across * before},
                             band);
    }
    canvas_.polyline(line, false, {.colour = palette_.trail, .width_px = 2, .dash_px = 6});
  }

  void draw_robot() {
    const TableGeometry& g = table_.geometry;
    if (table_.target_y_m) {
      const cv::Point2d target = at({g.robot_line_x_m, *table_.target_y_m});
      const Stroke stroke{.colour = palette_.brighter, .width_px = 2};
      canvas_.line(target - cv::Point2d(7, 0), target + cv::Point2d(7, 0), stroke);
      canvas_.line(target - cv::Point2d(0, 7), target + cv::Point2d(0, 7), stroke);
    }
    if (table_.mallet_y_m) {
      const cv::Point2d mallet = at({g.robot_line_x_m, *table_.mallet_y_m});
      const double r = g.mallet_radius_m * scale_;
      canvas_.ellipse(mallet, {r, r}, 0, {.colour = palette_.darker, .width_px = 3});
      canvas_.filled_circle(mallet, r * 0.4, palette_.darker);
    }
    if (!table_.crossing) return;
    const Intercept& crossing = *table_.crossing;
    const double x = crossing.x_m;
    const Stroke stroke{.colour = palette_.covariance, .width_px = 3};
    const double sigma = std::min(crossing.sigma_y_m, kWidestBand_m);
    canvas_.line(at({x, crossing.y_m + 2 * sigma}), at({x, crossing.y_m - 2 * sigma}), stroke);
    canvas_.filled_circle(at({x, crossing.y_m}), 4, palette_.covariance);
    char words[60];
    std::snprintf(words, sizeof words, "crosses in %.2f s", crossing.in_s);
    note(words, palette_.covariance);
  }

  void draw_puck() {
    if (table_.validity == ViewTable::Validity::kNone) {
      note("no track on the table", palette_.doubt);
      return;
    }
    const bool coasts = table_.validity == ViewTable::Validity::kCoasting;
    const PuckState& puck = table_.puck.state;
    ring(puck.position, palette_.estimate, 2, coasts);
    const TablePoint ahead{puck.position.x_m + puck.velocity.x_m_s * kPuckArrow_s,
                           puck.position.y_m + puck.velocity.y_m_s * kPuckArrow_s};
    canvas_.arrow(at(puck.position), at(ahead), 9,
                  {.colour = palette_.estimate, .width_px = 2, .dash_px = coasts ? 6.0 : 0.0});
    if (coasts) {
      canvas_.label("coasting", at(puck.position) + cv::Point2d(14, -16), kNote_px, palette_.doubt,
                    palette_.bar);
    }
  }

  const ViewTable& table_;
  const Palette& palette_;
  cv::Mat& picture_;
  Canvas canvas_;
  std::vector<LegendEntry> legend_;
  cv::Rect part_;
  double scale_ = 1;
  bool is_upright_ = false;
  cv::Point2d middle_;
};

}  // namespace

void draw_table(const ViewScene& scene, const PictureWishes& wishes, cv::Mat& picture) {
  if (scene.table) {
    TableDrawing(*scene.table, wishes, picture).draw();
    return;
  }
  Canvas(picture).paragraph(scene.no_table, {picture.cols / 2.0, picture.rows / 2.0},
                            picture.cols - 2 * kNote_px, kNote_px, palette_of(wishes.theme).quiet);
}

}  // namespace puck
