// Tables and calibrations in files: the first byte chooses the kind. A file that was read and
// written again must read the same.
#include <array>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "common/io/annotation_file.h"
#include "common/io/config.h"
#include "common/io/contour_calibration_file.h"
#include "common/io/correspondence_file.h"
#include "common/io/csv_file.h"
#include "common/io/joint_pairs_file.h"
#include "common/io/joint_table_file.h"
#include "common/io/pixel_mask_file.h"
#include "common/io/size_model_file.h"
#include "common/io/table_file.h"
#include "common/io/truth_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

using Path = std::filesystem::path;

/// Reads a file of its kind, and writes its content to another.
using Copy = void (*)(const Path& from, const Path& to);

void write_text(const Path& path, const std::string& text) { std::ofstream(path) << text; }

std::string text_of(const Path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string csv_of(const std::vector<JointPair>& pairs) {
  std::ostringstream csv;
  csv.precision(std::numeric_limits<double>::max_digits10);
  csv << "y_m";
  for (std::size_t k = 0; k < pairs.front().deg.size(); ++k) csv << ",joint_" << k << "_deg";
  for (const JointPair& pair : pairs) {
    require(pair.deg.size() == pairs.front().deg.size(), "each row has as many joints");
    csv << '\n' << pair.y_m;
    for (const double deg : pair.deg) csv << ',' << deg;
  }
  csv << '\n';
  return csv.str();
}

constexpr std::array<Copy, 10> kKinds{
    [](const Path& from, const Path& to) { write_truth_file(to, read_truth_file(from)); },
    [](const Path& from, const Path& to) { write_annotation_file(to, read_annotation_file(from)); },
    [](const Path& from, const Path& to) {
      write_correspondence_file(to, read_correspondence_file(from));
    },
    [](const Path& from, const Path& to) {
      write_size_model_file(to, read_size_model_file(from), "");
    },
    [](const Path& from, const Path& to) { write_table_file(to, read_table_file(from), ""); },
    [](const Path& from, const Path& to) {
      write_pixel_mask_file(to, read_pixel_mask_file(from), "");
    },
    [](const Path& from, const Path& to) {
      const auto calibration = read_contour_calibration(from);
      write_text(to, contour_calibration_text(calibration.value_or(ContourCalibration{}), ""));
    },
    [](const Path& from, const Path& to) {
      write_joint_table_file(to, read_joint_table_file(from), "");
    },
    [](const Path& from, const Path& to) { write_text(to, csv_of(read_joint_pairs(from))); },
    [](const Path& from, const Path& to) {
      read_authors_joint_table(from, RobotPart::kArm);
      // Only our own program writes such tables.
      write_text(to, text_of(from));
    }};

bool copy(Copy kind, const Path& from, const Path& to) {
  try {
    kind(from, to);
    return true;
  } catch (const CsvError& error) {
    require_one_line(error.what());
  } catch (const ConfigError& error) {
    require_one_line(error.what());
  }
  return false;
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const puck::Copy kind = puck::kKinds[data[0] % puck::kKinds.size()];
  puck::MemoryFile input;
  puck::MemoryFile first;
  puck::MemoryFile second;
  const auto& first_path = first.write(nullptr, 0);
  const auto& second_path = second.write(nullptr, 0);
  if (!puck::copy(kind, input.write(data + 1, size - 1), first_path)) return 0;
  puck::require(puck::copy(kind, first_path, second_path), "what is written can be read");
  puck::require(puck::text_of(first_path) == puck::text_of(second_path),
                "what is written is read as the same");
  return 0;
}
