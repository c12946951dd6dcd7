#include "common/io/correspondence_file.h"

#include <array>
#include <string>

#include "common/io/csv_file.h"

namespace puck {
namespace {

constexpr std::array<CsvColumn, 4> kCorrespondenceColumns{{{"x_px"}, {"y_px"}, {"x_m"}, {"y_m"}}};

}  // namespace

std::vector<Correspondence> read_correspondence_file(const std::filesystem::path& path) {
  std::vector<Correspondence> rows;
  for (const CsvRow& row : read_csv(path, kCorrespondenceColumns)) {
    rows.push_back({{row.values[0], row.values[1]}, {row.values[2], row.values[3]}});
  }
  return rows;
}

void write_correspondence_file(const std::filesystem::path& path,
                               std::span<const Correspondence> rows) {
  std::string text;
  for (const Correspondence& row : rows) {
    const std::array<double, 4> values{row.image.x, row.image.y, row.table.x_m, row.table.y_m};
    append_csv_row(text, values);
  }
  write_csv(path, "x_px,y_px,x_m,y_m", text);
}

}  // namespace puck
