#include "common/io/joint_pairs_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "common/io/csv_file.h"
#include "common/io/number_limits.h"
#include "common/io/trimmed.h"
#include "common/motion/joint_table.h"

namespace puck {
namespace {

constexpr double kMostM = 10;
constexpr std::size_t kMostJoints = JointTable::kMostJoints;

}  // namespace

std::vector<JointPair> read_joint_pairs(const std::filesystem::path& path) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kMostJoints; ++k)
    names.push_back("joint_" + std::to_string(k) + "_deg");
  std::vector<CsvColumn> columns{{"y_m", {}, std::nullopt, -kMostM, kMostM}};
  columns.push_back({names[0], {}, std::nullopt, -kMostJointDeg, kMostJointDeg});
  for (std::size_t k = 1; k < kMostJoints; ++k) {
    columns.push_back({names[k], {}, kMissing, -kMostJointDeg, kMostJointDeg});
  }
  std::vector<JointPair> pairs;
  for (const CsvRow& row : read_csv(path, columns)) {
    const auto first = row.values.begin() + 1;
    const auto last = std::find_if(first, row.values.end(), [](double v) { return std::isnan(v); });
    if (std::any_of(last, row.values.end(), [](double v) { return !std::isnan(v); })) {
      throw_csv_error(path, row.line,
                      "the column " + names[static_cast<std::size_t>(last - first)] +
                          " is missing before another joint's");
    }
    pairs.push_back({row.values[0], {first, last}});
  }
  return pairs;
}

std::vector<JointPair> read_authors_joint_table(const std::filesystem::path& path, RobotPart part) {
  constexpr std::size_t kColumns = 17;
  errno = 0;
  std::ifstream file(path);
  if (!file) throw CsvError(path.string() + ": cannot be opened: " + std::strerror(errno));
  std::vector<JointPair> pairs;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (trimmed(line).empty()) continue;
    std::istringstream words(line);
    std::vector<double> values;
    for (double value = 0; words >> value;) values.push_back(value);
    if (!words.eof() || values.size() != kColumns) {
      throw_csv_error(path, number,
                      "expected 17 numbers: y, 3 of the torso, 7 of the arm, 6 of the head");
    }
    if (!(std::abs(values[0]) <= kMostM) ||
        !std::all_of(values.begin() + 1, values.end(),
                     [](double deg) { return std::abs(deg) <= kMostJointDeg; })) {
      throw_csv_error(path, number, "y must be within 10 m, joints within 720 deg");
    }
    const auto at = [&](std::ptrdiff_t column) { return values.begin() + column; };
    JointPair pair{values[0], {}};
    switch (part) {
      case RobotPart::kTorso:
        pair.deg.assign(at(1), at(4));
        std::reverse(pair.deg.begin(), pair.deg.end());
        break;
      case RobotPart::kArm:
        pair.deg.assign(at(4), at(11));
        break;
      case RobotPart::kHead:
        pair.deg.assign(at(11), at(17));
        break;
    }
    pairs.push_back(pair);
  }
  if (pairs.empty()) throw_csv_error(path, number, "no rows");
  return pairs;
}

}  // namespace puck
