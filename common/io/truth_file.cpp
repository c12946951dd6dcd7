#include "common/io/truth_file.h"

#include <array>
#include <cmath>
#include <string>

#include "common/io/csv_file.h"
#include "common/io/number_limits.h"

namespace puck {
namespace {

constexpr std::array<CsvColumn, 6> kTruthColumns{{
    {"t_us", {}, std::nullopt, 0, kLatestUs},
    {"x"},
    {"y"},
    {"width", "w", std::nullopt, 0, kLargestSizePx},
    {"height", "h", std::nullopt, 0, kLargestSizePx},
    {"visible", {}, 1.0, 0, 1},
}};

}  // namespace

std::vector<TruthRow> read_truth_file(const std::filesystem::path& path) {
  std::vector<TruthRow> rows;
  for (const CsvRow& row : read_csv(path, kTruthColumns)) {
    TruthRow truth;
    truth.time = {std::llround(row.values[0])};
    truth.centre = {row.values[1], row.values[2]};
    truth.size = {row.values[3], row.values[4]};
    truth.visible = row.values[5];
    if (!rows.empty() && truth.time <= rows.back().time) {
      throw_csv_error(path, row.line, "t_us must be larger than in the row before");
    }
    rows.push_back(truth);
  }
  return rows;
}

void write_truth_file(const std::filesystem::path& path, std::span<const TruthRow> rows) {
  std::string text;
  for (const TruthRow& row : rows) {
    const std::array<double, 5> values{row.centre.x, row.centre.y, row.size.width, row.size.height,
                                       row.visible};
    text += std::to_string(row.time.us) + ",";
    append_csv_row(text, values);
  }
  write_csv(path, "t_us,x,y,width,height,visible", text);
}

}  // namespace puck
