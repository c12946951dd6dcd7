#include "common/io/annotation_file.h"

#include <array>
#include <cmath>
#include <string>

#include "common/io/csv_file.h"
#include "common/io/number_limits.h"

namespace puck {
namespace {

constexpr double kSmallestSizePx = 0.1;

constexpr std::array<CsvColumn, 5> kAnnotationColumns{{
    {"t_us", {}, std::nullopt, 0, kLatestUs},
    {"x"},
    {"y"},
    {"width", "w", std::nullopt, kSmallestSizePx, kLargestSizePx},
    {"height", "h", std::nullopt, kSmallestSizePx, kLargestSizePx},
}};

}  // namespace

std::vector<Annotation> read_annotation_file(const std::filesystem::path& path) {
  std::vector<Annotation> rows;
  for (const CsvRow& row : read_csv(path, kAnnotationColumns)) {
    // A fraction of a µs indicates a time in seconds, or another column.
    if (row.values[0] != std::floor(row.values[0])) {
      throw_csv_error(path, row.line, "t_us must be a whole number of µs");
    }
    Annotation annotation;
    annotation.time = {std::llround(row.values[0])};
    annotation.centre = {row.values[1], row.values[2]};
    annotation.size = {row.values[3], row.values[4]};
    rows.push_back(annotation);
  }
  return rows;
}

void write_annotation_file(const std::filesystem::path& path, std::span<const Annotation> rows) {
  std::string text;
  for (const Annotation& row : rows) {
    const std::array<double, 4> values{row.centre.x, row.centre.y, row.size.width, row.size.height};
    text += std::to_string(row.time.us) + ",";
    append_csv_row(text, values);
  }
  write_csv(path, "t_us,x,y,width,height", text);
}

}  // namespace puck
