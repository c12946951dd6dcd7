#pragma once

#include <filesystem>
#include <vector>

#include "common/calibration/flight_finder.h"
#include "common/io/table_file.h"

namespace puck {

/// Reads the puck's track on the table from a recorded game:
///  - a log with ESTIMATE, or
///  - a .csv file with the columns t_us,x_m,y_m on the table, or t_us,x,y in the image; sensor_us
///    may stand for t_us. Exports of TRAJECTORY and TRUTH and simulated truth files fit.
/// Rows in which visible, in_play or validity rules the puck out are skipped. Image positions are
/// mapped by the table's homography: the camera must be in its home pose. Throws CsvError or
/// LogFileError, or std::invalid_argument for a log with a turning head or without a puck.
std::vector<TrackPoint> read_recorded_track(const std::filesystem::path& path,
                                            const TableCalibration& table);

}  // namespace puck
