#pragma once

#include <filesystem>
#include <vector>

#include "common/calibration/flight_finder.h"
#include "common/io/table_file.h"

namespace puck {

/// Where the puck was on the table, from what was recorded of a game:
///  - a log with ESTIMATE, or
///  - a CSV, when the name ends in .csv: of the table, with the columns t_us,x_m,y_m, or of the
///  image,
///    with t_us,x,y. sensor_us is taken for t_us; rows that say by visible, in_play or validity
///    that the puck was not there are left out. So the exports of TRAJECTORY and TRUTH are taken,
///    and the truth of a simulated recording.
/// What is of the image is carried over by the table's homography: the camera must stand at home.
/// Throws CsvError or LogFileError, or std::invalid_argument when the log has a head that turns or
/// no puck.
std::vector<TrackPoint> read_recorded_track(const std::filesystem::path& path,
                                            const TableCalibration& table);

}  // namespace puck
