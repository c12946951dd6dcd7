#include "common/io/truth_file.h"

#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "common/io/csv_file.h"
#include "common/io/number_limits.h"
#include "common/io/parse_number.h"
#include "common/io/trimmed.h"

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

// Values separated by blanks, without a comma: `t y0 y1 x0 x1`.
bool holds_boxes(const std::filesystem::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    return content.find(',') == std::string_view::npos &&
           std::isdigit(static_cast<unsigned char>(content.front())) != 0;
  }
  return false;
}

std::vector<double> numbers_in(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    double number = 0;
    if (!parse_number(word, number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<TruthRow> read_boxes(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<TruthRow> rows;
  std::vector<std::pair<double, std::size_t>> times;  // As they stand there, and their lines.
  bool is_seconds = false;
  std::size_t line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    const std::vector<double> box = numbers_in(line);
    // NaN fails these tests, too.
    if (box.size() != 5 || !(box[0] >= 0) || !(box[1] <= box[2]) || !(box[3] <= box[4]) ||
        !(box[2] - box[1] <= kLargestSizePx) || !(box[4] - box[3] <= kLargestSizePx)) {
      throw_csv_error(path, line_number,
                      "expected a box as five numbers t y0 y1 x0 x1, with t from 0 (in s with a "
                      "decimal point, or in µs), y0 <= y1 and x0 <= x1");
    }
    const std::string_view time = content.substr(0, content.find_first_of(" \t"));
    is_seconds = is_seconds || time.find('.') != std::string_view::npos;
    times.emplace_back(box[0], line_number);
    TruthRow row;
    row.centre = {(box[3] + box[4]) / 2, (box[1] + box[2]) / 2};
    row.size = {box[4] - box[3], box[2] - box[1]};
    rows.push_back(row);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [time, line] = times[i];
    const double t_us = is_seconds ? time * 1e6 : time;
    if (t_us > kLatestUs) throw_csv_error(path, line, "t is too large");
    rows[i].time = {std::llround(t_us)};
    if (i > 0 && rows[i].time <= rows[i - 1].time) {
      throw_csv_error(path, line, "t must be larger than in the box before");
    }
  }
  return rows;
}

}  // namespace

std::vector<TruthRow> read_truth_file(const std::filesystem::path& path) {
  if (holds_boxes(path)) return read_boxes(path);
  std::vector<TruthRow> rows;
  for (const CsvRow& row : read_csv(path, kTruthColumns)) {
    TruthRow truth;
    if (row.values[0] != std::floor(row.values[0])) {
      throw_csv_error(
          path, row.line,
          "t_us must be a whole number of µs; are the times in seconds or milliseconds?");
    }
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
