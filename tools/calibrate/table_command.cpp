#include "tools/calibrate/table_command.h"

#include <cstdio>
#include <vector>

#include "common/calibration/homography_fit.h"
#include "common/io/correspondence_file.h"
#include "common/io/table_file.h"

namespace puck {

void calibrate_table(const std::filesystem::path& correspondences,
                     const std::filesystem::path& output, const std::string& typed) {
  const std::vector<Correspondence> rows = read_correspondence_file(correspondences);
  const HomographyFit fit = fit_homography(rows);
  write_table_file(output, {fit.homography, TableGeometry{}}, typed);
  std::printf("%zu correspondences\n", rows.size());
  std::printf("residual        rms       max\n");
  std::printf("image, px  %8.3f  %8.3f\n", fit.rms_px, fit.max_px);
  std::printf("table, mm  %8.3f  %8.3f\n", fit.rms_m * 1e3, fit.max_m * 1e3);
  if (rows.size() == 4) {
    std::printf("four correspondences always fit: mark more to see how good they are\n");
  }
}

}  // namespace puck
