#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "tools/calibrate/arm_command.h"
#include "tools/calibrate/evidence_command.h"
#include "tools/calibrate/hot_pixels_command.h"
#include "tools/calibrate/lag_command.h"
#include "tools/calibrate/motion_command.h"
#include "tools/calibrate/size_command.h"
#include "tools/calibrate/table_command.h"
#include "tools/command_line/event_file_options.h"
#include "tools/command_line/number_range.h"

namespace puck {
namespace {

// For a comment in the output.
std::string typed_command(int argc, char** argv) {
  std::string command = std::filesystem::path(argv[0]).filename();
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

// A mistyped --output must not overwrite the annotations or the recording.
void refuse_to_overwrite(const std::filesystem::path& input, const std::filesystem::path& output) {
  std::error_code none;  // A missing file counts as different.
  if (!std::filesystem::equivalent(input, output, none)) return;
  throw std::runtime_error(output.string() +
                           ": --output would overwrite the input; name another file");
}

void add_arm_options(CLI::App& command, ArmFitCommand& arm) {
  MotionLimits& limits = arm.fit.limits;
  const auto add = [&](const char* name, double& value, const char* what) {
    command.add_option(name, value, what)->check(CLI::Range(1e-3, 1e9))->capture_default_str();
  };
  add("--max-velocity", limits.velocity,
      "limit of every joint, deg/s; the output file has one value a joint");
  add("--max-acceleration", limits.acceleration, "deg/s^2");
  add("--max-jerk", limits.jerk, "deg/s^3");
  command
      .add_option("--margin", arm.fit.margin_deg,
                  "range of a joint beyond its measured angles, deg")
      ->check(CLI::Range(0.0, 90.0))
      ->capture_default_str();
  command
      .add_option("--intervals", arm.fit.intervals,
                  "intervals of the spline; 0: chosen from the number of pairs")
      ->check(CLI::Range(0, 900));
  command.add_option("--centre", arm.centre_m, "y in the pairs that is the middle of the line, m")
      ->check(CLI::Range(-10.0, 10.0));
  command.add_flag("--mirror", arm.mirror,
                   "y in the pairs grows to the robot's right instead of its left");
  command.add_option("--part", arm.part, "part of the robot to read from the authors' table")
      ->check(CLI::IsMember({"torso", "arm", "head"}))
      ->capture_default_str();
}

void add_evidence_options(CLI::App& command, EvidenceCommand& evidence) {
  command
      .add_option("recordings", evidence.recordings,
                  "recordings of games, of any format in docs/formats.md")
      ->required();
  command
      .add_option("--truth", evidence.truths,
                  "one for each recording, in their order: CSV: t_us,x,y,width,height[,visible]")
      ->required();
  command
      .add_option("--size-model", evidence.size_models,
                  "TOML made by puck-calibrate size or lag: one for each recording, or one for all")
      ->required();
  constexpr double kLongest_ms = 1e6;
  command
      .add_option("--truth-gap-ms", evidence.truth_gaps_ms,
                  "nothing is learned between rows of the truth that are farther apart: one value "
                  "for each recording, or one for all")
      ->check(number_range(0, kLongest_ms))
      ->capture_default_str();
  command
      .add_option("--weight", evidence.weights,
                  "how much a recording counts: one value for each, or one for all")
      ->check(number_range(1e-3, 1e3))
      ->capture_default_str();
  command.add_option("--lookalikes", evidence.with_lookalikes,
                     "of the recordings, those with other things that look exactly like the puck, "
                     "such as round marks on the table: only the puck is learned from them");
  add_event_file_options(command, evidence.file);
}

int run(int argc, char** argv) {
  CLI::App app("Calibrates a camera, a table and a robot arm from measurements.", "puck-calibrate");
  app.set_version_flag("--version", PUCK_VERSION);
  app.require_subcommand(1);
  std::filesystem::path input;
  std::filesystem::path output;

  SizeCommand size;
  CLI::App* size_app =
      app.add_subcommand("size", "Fits the puck's size as a function of its position in the image");
  size_app->add_option("annotations", input, "CSV: t_us,x,y,width,height")->required();
  size_app->add_option("--width", size.sensor.width,
                       "width of the sensor, px; needed to report the coverage");
  size_app->add_option("--height", size.sensor.height, "of the sensor, px");

  TableCommand table;
  CLI::App* table_app =
      app.add_subcommand("table", "Fits the homography from the image to the table");
  table_app->add_option("correspondences", input, "CSV: x_px,y_px,x_m,y_m")->required();
  table_app
      ->add_option("--puck-height", table.puck_height_m,
                   "thickness of the puck, m, if the correspondences lie on the playing surface")
      ->check(CLI::Range(0.0, 0.1));
  table_app
      ->add_option("--width", table.sensor.width,
                   "width of the sensor, px; its centre is taken as the principal point")
      ->check(CLI::Range(1, 10'000));
  table_app->add_option("--height", table.sensor.height, "of the sensor, px")
      ->check(CLI::Range(1, 10'000));
  table_app
      ->add_option("--principal-point", table.principal_point,
                   "X,Y of the principal point, px, if it is not the centre of the sensor")
      ->delimiter(',');
  table_app->add_option("--focal", table.focal_px, "focal length, px; fitted if not given");
  table_app
      ->add_option("--pivot", table.pivot_m,
                   "X,Y,Z of the point where the head's axes meet, m, in the frame of the "
                   "camera at its home pose: right, down, forwards")
      ->delimiter(',');

  LagCommand lag;
  CLI::App* lag_app = app.add_subcommand(
      "lag", "Fits the sensor's lag and the offset of the event contour from the annotated size");
  lag_app->add_option("recording", input, "of any format in docs/formats.md")->required();
  lag_app->add_option("--truth", lag.truth, "CSV: t_us,x,y,width,height[,visible]")->required();
  lag_app->add_option("--size-model", lag.size_model, "TOML made by puck-calibrate size")
      ->required();
  add_event_file_options(*lag_app, lag.file);

  EvidenceCommand evidence;
  CLI::App* evidence_app = app.add_subcommand(
      "evidence", "Fits what preset default has learned of pucks to recordings with truth");
  add_evidence_options(*evidence_app, evidence);

  HotPixelsCommand hot;
  CLI::App* hot_app =
      app.add_subcommand("hot-pixels", "Finds hot pixels and writes a mask of them");
  hot_app->add_option("recording", input, "of any format in docs/formats.md")->required();
  add_event_file_options(*hot_app, hot.file);

  ArmFitCommand arm;
  CLI::App* arm_app =
      app.add_subcommand("arm", "Fits the arm's joint angles along the robot's line");
  add_arm_options(*arm_app, arm);
  arm_app
      ->add_option("pairs", input,
                   "CSV: y_m,joint_0_deg,joint_1_deg,...; or, when it ends in .tsv, the authors' "
                   "table")
      ->required();

  MotionCommand motion;
  CLI::App* motion_app =
      app.add_subcommand("motion", "Fits the puck's damping and its bounces on a table");
  motion_app
      ->add_option("track", input,
                   "log of a game; or a .csv file: t_us,x_m,y_m on the table, or t_us,x,y in "
                   "the image")
      ->required();
  motion_app->add_option("--table", motion.table, "TOML made by puck-calibrate table")->required();

  for (CLI::App* command :
       {size_app, table_app, lag_app, evidence_app, hot_app, arm_app, motion_app}) {
    command->add_option("--output", output, "TOML file to write")->required();
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  const std::string typed = typed_command(argc, argv);
  try {
    refuse_to_overwrite(input, output);
    if (lag_app->parsed()) refuse_to_overwrite(lag.truth, output);
    for (const auto* files : {&evidence.recordings, &evidence.truths, &evidence.size_models}) {
      for (const auto& file : *files) refuse_to_overwrite(file, output);
    }
    if (size_app->parsed()) {
      size.annotations = input;
      size.output = output;
      calibrate_size(size, typed);
    } else if (lag_app->parsed()) {
      lag.recording = input;
      lag.output = output;
      calibrate_lag(lag, typed);
    } else if (evidence_app->parsed()) {
      evidence.output = output;
      calibrate_evidence(evidence, typed);
    } else if (hot_app->parsed()) {
      hot.recording = input;
      hot.output = output;
      calibrate_hot_pixels(hot, typed);
    } else if (motion_app->parsed()) {
      motion.track = input;
      motion.output = output;
      calibrate_motion(motion, typed);
    } else if (arm_app->parsed()) {
      arm.pairs = input;
      arm.output = output;
      calibrate_arm(arm, typed);
    } else {
      table.correspondences = input;
      table.output = output;
      calibrate_table(table, typed);
    }
  } catch (const std::invalid_argument& error) {
    // The fits do not know the name of their input file.
    std::fprintf(stderr, "puck-calibrate: %s: %s\n", input.c_str(), error.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-calibrate: %s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) { return puck::run(argc, argv); }
