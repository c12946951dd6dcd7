#include "tools/calibrate/motion_command.h"

#include <cstdio>
#include <vector>

#include "common/calibration/motion_fit.h"
#include "common/io/calibration_text.h"
#include "common/io/table_file.h"
#include "tools/calibrate/recorded_track.h"

namespace puck {
namespace {

void print(const MotionFit& fit, const std::vector<Flight>& flights) {
  double seconds = 0;
  for (const Flight& flight : flights) {
    seconds += static_cast<double>(flight.back().t - flight.front().t) * 1e-6;
  }
  std::printf("%zu flights, %.1f s: the fit rests on %zu of them, with %zu bounces\n",
              flights.size(), seconds, fit.flights, fit.bounces);
  const auto row = [](const char* name, double value, double error) {
    std::printf("%-17s %9.5f +- %.5f\n", name, value, error);
  };
  const MotionConstants& error = fit.standard_error;
  row("damping_per_s", fit.constants.damping_per_s, error.damping_per_s);
  row("rail_restitution", fit.constants.rail_restitution, error.rail_restitution);
  row("rail_grip", fit.constants.rail_grip, error.rail_grip);
  std::printf("the places lie %.2f mm rms from the fitted flights\n", 1e3 * fit.rms_m);
}

}  // namespace

void calibrate_motion(const MotionCommand& command, const std::string& typed) {
  const TableCalibration table = read_table_file(command.table);
  const std::vector<Flight> flights =
      find_flights(read_recorded_track(command.track, table), table.geometry);
  const MotionFit fit = fit_motion(flights, table.geometry);
  std::string text = without_table(read_calibration_text(command.table), "motion");
  text += motion_text(fit.constants, typed);
  write_calibration_text(command.output, text);
  print(fit, flights);
}

}  // namespace puck
