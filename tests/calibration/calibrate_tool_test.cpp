#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <sys/wait.h>

#include "common/io/table_file.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"
#include "common/simulation/physics_params.h"
#include "common/simulation/simulated_table.h"
#include "puck/head_state_t.hpp"
#include "puck/puck_estimate_t.hpp"
#include "tests/calibration/flown_game.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/support/sanitizers.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

// Runs puck-calibrate in a folder of its own, which is removed afterwards.
class Tool {
 public:
  Tool() {
    std::string name = (fs::temp_directory_path() / "puck_calibrate_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Tool() { fs::remove_all(folder_); }
  Tool(const Tool&) = delete;
  Tool& operator=(const Tool&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }
  fs::path path(const std::string& name) const { return folder_ / name; }
  // Output and errors land in the file `said`.
  int run(const std::string& arguments) const { return run("puck-calibrate", arguments); }
  int run(const std::string& program, const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() + "' && '" + program_path(program) +
                                "' " + arguments + " > said 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  fs::path folder_;
};

TEST_CASE("puck-calibrate size writes a size model and prints its residuals") {
  const Tool tool;
  tool.write("a.csv", "t_us,x,y,width,height\n0,100,100,20,10\n1,300,100,20,10\n2,100,300,40,30\n");
  CHECK(tool.run("size a.csv --output size.toml") == 0);
  CHECK(contains(tool.read("said"), "3 annotations"));
  const std::string written = tool.read("size.toml");
  CHECK(contains(written, "[size_model]"));
  CHECK(contains(written, "puck-calibrate size a.csv --output size.toml"));
}

TEST_CASE("puck-calibrate size names malformed cells by line and implausible rows by number") {
  const Tool tool;
  tool.write("blank.csv", "t_us,x,y,width,height\n0,1,,20,10\n");
  CHECK(tool.run("size blank.csv --output size.toml") == 1);
  CHECK(contains(tool.read("said"), "blank.csv:2: y must be a number, got \"\""));
  tool.write("order.csv", "t_us,x,y,width,height\n100.5,100,20,10,0\n");
  CHECK(tool.run("size order.csv --output size.toml") == 1);
  CHECK(contains(tool.read("said"), "order.csv:2: height must be from 0.1"));
  std::string rows = "t_us,x,y,width,height\n";
  for (int i = 0; i < 20; ++i) {
    const int x = 30 * i;
    const int y = 20 * (i % 5) + 100;
    rows += std::to_string(i) + "," + std::to_string(x) + "," + std::to_string(y) + "," +
            std::to_string(i == 6 ? 90 : 10 + y / 5) + "," + std::to_string(5 + y / 10) + "\n";
  }
  tool.write("many.csv", rows);
  CHECK(tool.run("size many.csv --output size.toml --width 640 --height 480") == 0);
  const std::string said = tool.read("said");
  CHECK(contains(said, "20 annotations, 1 left out"));
  CHECK(contains(said, "row 7 (t 6 us, at 180.0, 120.0): 90.0 x 17.0 px"));
  CHECK(contains(said, "disc on a plane"));
  // These sizes follow Equation (2), which the disc fits worse.
  CHECK(contains(said, "the disc is not written"));
  CHECK_FALSE(contains(tool.read("size.toml"), "[disc]"));
  CHECK(contains(said, "warning: the centres span only 89 %"));
  CHECK(contains(tool.read("size.toml"), "[size_range]"));
  CHECK(tool.run("size many.csv --output size.toml --width 640") == 1);
}

TEST_CASE("puck-calibrate table writes a homography and prints its residuals") {
  const Tool tool;
  tool.write("c.csv",
             "x_px,y_px,x_m,y_m\n100,400,0.2,0.4\n500,400,0.2,-0.4\n200,100,2,0.4\n"
             "400,100,2,-0.4\n");
  CHECK(tool.run("table c.csv --output table.toml") == 0);
  CHECK(contains(tool.read("said"), "4 correspondences"));
  CHECK(contains(tool.read("table.toml"), "table_from_image"));
}

std::string shipped(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(source_folder() / "config/calibration" / name).rdbuf();
  return text.str();
}

TEST_CASE("puck-calibrate table raises the plane to the puck's middle and finds the camera") {
  const Tool tool;
  // Places on the playing surface as the simulated camera sees them: 740 px, 32.5 degrees down.
  tool.write("c.csv", shipped("simulated_table.csv"));
  REQUIRE(tool.run("table c.csv --output flat.toml --width 640 --height 480") == 0);
  CHECK(contains(tool.read("said"), "focal length 740.0 px"));
  CHECK(contains(tool.read("flat.toml"), "[camera]\nfocal_px = 739.9"));
  CHECK(contains(tool.read("flat.toml"), "principal_x_px = 319.5"));
  REQUIRE(
      tool.run("table c.csv --output high.toml --puck-height 0.012 --principal-point 319.5,239.5 "
               "--focal 740 --pivot 0,0.1,-0.05") == 0);
  CHECK(contains(tool.read("high.toml"), "pivot_m = [0"));
  CHECK(tool.read("high.toml") != tool.read("flat.toml"));
  CHECK(tool.run("table c.csv --output x.toml --puck-height 0.012") == 1);
  CHECK(contains(tool.read("said"), "c.csv: the principal point is unknown"));
}

TEST_CASE("The simulated table's calibration equals its command's output, and is true") {
  const Tool tool;
  tool.write("simulated_table.csv", shipped("simulated_table.csv"));
  const std::string file = shipped("simulated_table.toml");
  const std::string program = "puck-calibrate ";
  const std::size_t command = file.find(program);
  REQUIRE(command != std::string::npos);
  const std::size_t end = file.find('\n', command);
  REQUIRE(tool.run(file.substr(command + program.size(), end - command - program.size())) == 0);
  tool.write("shipped.toml", file);
  const TableCalibration again = read_table_file(tool.path("simulated_table.toml"));
  const TableCalibration calibration = read_table_file(tool.path("shipped.toml"));
  const SimulatedTable simulated{SimulationParams{}};
  double worst_m = 0;
  double changed_m = 0;
  for (double x = 0; x < 640; x += 20) {
    for (double y = 0; y < 480; y += 20) {
      const auto fitted = calibration.table_from_image.to_table({x, y});
      const auto exact = simulated.table_from_image().to_table({x, y});
      const auto made_again = again.table_from_image.to_table({x, y});
      REQUIRE(fitted);
      REQUIRE(made_again);
      REQUIRE(exact);
      worst_m = std::max(worst_m, std::hypot(fitted->x_m - exact->x_m, fitted->y_m - exact->y_m));
      changed_m = std::max(
          changed_m, std::hypot(fitted->x_m - made_again->x_m, fitted->y_m - made_again->y_m));
    }
  }
  CHECK(worst_m < 1e-4);
  CHECK(changed_m < 1e-6);
  REQUIRE(calibration.camera);
  CHECK(calibration.camera->focal_px == doctest::Approx(simulated.camera().focal_px).epsilon(1e-4));
  CHECK(calibration.camera->principal_point == simulated.camera().principal_point);
  REQUIRE(calibration.motion);
  const PhysicsParams physics;
  CHECK(std::abs(calibration.motion->damping_per_s - physics.damping_1_s) < 0.001);
  CHECK(std::abs(calibration.motion->rail_restitution - physics.rail_normal_keep) < 0.001);
  CHECK(std::abs(calibration.motion->rail_grip - physics.rail_tangential_keep) < 0.001);
}

// A log with an estimate for each place, as the shipped table's camera sees it.
void write_log(const fs::path& path, const std::vector<TrackPoint>& track,
               const TableCalibration& table, double yaw_deg) {
  LogWriter log(path);
  std::vector<std::uint8_t> bytes;
  head_state_t head{};
  head.session = 1;
  head.yaw_deg = yaw_deg;
  encode(head, bytes);
  log.write("PUCK_HEAD", 1, bytes);
  puck_estimate_t estimate{};
  estimate.session = 1;
  estimate.state = puck_estimate_t::STATE_TRACKING;
  estimate.flags = puck_estimate_t::FLAG_POSITION;
  for (const TrackPoint& point : track) {
    const auto seen = table.table_from_image.to_image(point.position);
    REQUIRE(seen);
    estimate.sensor_us = point.t.us;
    estimate.x_px = seen->x;
    estimate.y_px = seen->y;
    encode(estimate, bytes);
    log.write("PUCK_ESTIMATE", 1, bytes);
    ++estimate.seq;
  }
}

TEST_CASE("puck-calibrate motion fits a log and an export, and replaces the table's old motion") {
  const Tool tool;
  const std::string table = shipped("simulated_table.toml");
  tool.write("table.toml", table);
  const TableCalibration calibration = read_table_file(tool.path("table.toml"));
  FlownGame game;
  game.seconds = 45;
  if (kIsSanitized) game.period_us = 10'000;  // A fit's time grows with its places.
  const std::vector<TrackPoint> track = game.track();
  std::ostringstream rows;
  rows.precision(17);
  rows << "received_utime,sensor_us,validity,x_m,y_m\n";
  for (const TrackPoint& point : track) {
    rows << "0," << point.t.us << ",2," << point.position.x_m << ',' << point.position.y_m << '\n';
    rows << "0," << point.t.us + 1 << ",1,0.5,0.5\n";
  }
  tool.write("track.csv", rows.str());
  write_log(tool.path("game.lcmlog"), track, calibration, 0);

  REQUIRE(tool.run("motion track.csv --table table.toml --output from_csv.toml") == 0);
  CHECK(contains(tool.read("said"), "\nrail_restitution "));
  CHECK(contains(tool.read("said"), " bounces\n"));
  REQUIRE(tool.run("motion game.lcmlog --table table.toml --output table.toml") == 0);
  const std::string written = tool.read("table.toml");
  CHECK(contains(written, "# puck-calibrate motion game.lcmlog --table table.toml"));
  CHECK(written.find("[motion]") == written.rfind("[motion]"));
  CHECK(written.starts_with(table.substr(0, table.find("# From two minutes"))));
  const auto from_csv = read_table_file(tool.path("from_csv.toml")).motion;
  const auto from_log = read_table_file(tool.path("table.toml")).motion;
  REQUIRE(from_csv);
  REQUIRE(from_log);
  CHECK(from_log->damping_per_s == doctest::Approx(from_csv->damping_per_s).epsilon(1e-3));
  CHECK(from_log->rail_restitution == doctest::Approx(from_csv->rail_restitution).epsilon(1e-3));
  CHECK(from_log->rail_grip == doctest::Approx(from_csv->rail_grip).epsilon(1e-3));
  CHECK(std::abs(from_log->rail_restitution - PhysicsParams{}.rail_normal_keep) < 0.005);
}

TEST_CASE("puck-calibrate motion refuses a turning head, unknown columns and a missing puck") {
  const Tool tool;
  tool.write("table.toml", shipped("simulated_table.toml"));
  const TableCalibration calibration = read_table_file(tool.path("table.toml"));
  write_log(tool.path("turns.lcmlog"), {}, calibration, 20);
  CHECK(tool.run("motion turns.lcmlog --table table.toml --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "turns.lcmlog: the camera's head turns in this log"));
  write_log(tool.path("empty.lcmlog"), {}, calibration, 0);
  CHECK(tool.run("motion empty.lcmlog --table table.toml --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "empty.lcmlog: the log has no ESTIMATE of a puck"));
  tool.write("a.csv", "t_us,u,v\n0,1,2\n");
  CHECK(tool.run("motion a.csv --table table.toml --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "a.csv:1: the header must name x_m and y_m"));
  tool.write("short.csv", "t_us,x_m,y_m\n0,1,0\n1000,1,0\n");
  CHECK(tool.run("motion short.csv --table table.toml --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "short.csv: there are no flights"));
  CHECK(tool.read("no.toml").empty());
}

TEST_CASE("puck-calibrate refuses degenerate input with one line that names the file") {
  const Tool tool;
  tool.write("a.csv", "t_us,x,y,width,height\n0,101,101,20,10\n1,102,102,20,10\n2,103,103,40,30\n");
  CHECK(tool.run("size a.csv --output size.toml") == 1);
  const std::string said = tool.read("said");
  CHECK(contains(said, "a.csv: the annotated centres lie on one line"));
  CHECK(said.find('\n') == said.size() - 1);
  CHECK(tool.read("size.toml").empty());
}

TEST_CASE("puck-calibrate lag adds its result to the size model, or replaces it") {
  const Tool tool;
  REQUIRE(tool.run("puck-simulate", "--output game --seconds 2 --seed 5") == 0);
  REQUIRE(tool.run("size game.annotations.csv --output size.toml") == 0);
  const std::string size = tool.read("size.toml");
  CHECK(contains(tool.read("said"), "the disc is written beside Equation (2)"));
  CHECK(contains(size, "[disc]"));
  const std::string lag = "lag game.raw --truth game.truth.csv --size-model size.toml ";
  REQUIRE(tool.run(lag + "--output size.toml") == 0);
  const std::string once = tool.read("size.toml");
  CHECK(once.starts_with(size));
  CHECK(contains(once, "\n# puck-calibrate lag game.raw"));
  const std::size_t place = once.find("lag_us = ");
  REQUIRE(place != std::string::npos);
  // The photoreceptor's time constant is 318 µs.
  const double lag_us = std::stod(once.substr(place + 9));
  CHECK(lag_us > 200);
  CHECK(lag_us < 450);
  CHECK(tool.run(lag + "--output size.toml") == 0);
  CHECK(tool.read("size.toml") == once);
  CHECK(contains(once, "lean_deg = 0"));
  // A lean that was given by hand is kept.
  tool.write("leaning.toml", size + "[contour]\nlean_deg = 3.5\n");
  CHECK(tool.run("lag game.raw --truth game.truth.csv --size-model leaning.toml "
                 "--output leaning.toml") == 0);
  const std::string leaning = tool.read("leaning.toml");
  CHECK(contains(leaning, "lean_deg = 3.5"));
  CHECK(contains(leaning, "wall_share = "));

  // Truth that ends before the events.
  const std::string truth = tool.read("game.truth.csv");
  tool.write("short.csv", truth.substr(0, truth.find('\n', truth.size() / 3) + 1));
  CHECK(tool.run("lag game.raw --truth short.csv --size-model size.toml --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "the truth must cover the whole recording"));

  // A recording without the puck, and of another sensor.
  REQUIRE(tool.run("size game.annotations.csv --output size.toml --width 640 --height 480") == 0);
  std::string noise;
  for (int ms = 0; ms < 2000; ms += 5) {
    noise += std::to_string(1000 * ms + 7) + " " + std::to_string(ms % 640) + " " +
             std::to_string(ms % 7 * 60) + " 1\n";
  }
  tool.write("noise.txt", noise);
  CHECK(tool.run("lag noise.txt --width 1280 --height 720 --truth game.truth.csv --size-model "
                 "size.toml --output no.toml") == 1);
  const std::string said = tool.read("said");
  CHECK(contains(said, "noise.txt: no events lie on the puck's contour"));
  CHECK(contains(said, "fitted for a sensor of 640x480 px, this one has 1280x720"));
  CHECK(tool.read("no.toml").empty());

  // A puck that rests.
  std::string rest = "t_us,x,y,width,height\n";
  for (int ms = 0; ms <= 2000; ms += 10) rest += std::to_string(1000 * ms) + ",320,200,31,20\n";
  tool.write("rest.csv", rest);
  CHECK(tool.run("lag game.raw --truth rest.csv --size-model size.toml --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "no steady motion of 60 px/s or more"));
}

TEST_CASE("puck-calibrate evidence learns from a game, and puck-evaluate uses its file") {
  const Tool tool;
  REQUIRE(tool.run("puck-simulate", "--output game --seconds 1 --seed 5") == 0);
  const std::string learn = "evidence game.raw --truth game.truth.csv --size-model game.toml ";
  REQUIRE(tool.run(learn + "--output evidence.toml") == 0);
  const std::string said = tool.read("said");
  CHECK(contains(said, "game.raw: "));
  CHECK(contains(said, "log loss as built in"));
  const std::string file = tool.read("evidence.toml");
  CHECK(
      file.starts_with("# puck-calibrate evidence game.raw \\\n#     --truth game.truth.csv \\\n"));
  CHECK(contains(file, "\n[evidence]\n"));
  CHECK(contains(file, "\nsign_worth = "));

  const std::string evaluate = "game.raw --truth game.truth.csv --evidence evidence.toml ";
  CHECK(tool.run("puck-evaluate", evaluate) == 0);
  CHECK(tool.run("puck-evaluate", evaluate + "--preset correlation") == 1);
  CHECK(contains(tool.read("said"), "--evidence needs preset default"));
  tool.write("evidence.toml", file.substr(0, file.find("sign_worth")));
  CHECK(tool.run("puck-evaluate", evaluate) == 1);
  CHECK(contains(tool.read("said"), "evidence.toml: evidence.sign_worth is missing"));

  // Only the puck's packets remain, too few to learn what it is not.
  CHECK(tool.run(learn + "--lookalikes game.raw --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "the recordings: only 0 packets of events are of anything"));
  CHECK(tool.run(learn + "--lookalikes other.raw --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "--lookalikes other.raw: is not one of the recordings"));
  CHECK(tool.run("evidence game.raw game.raw --truth game.truth.csv --size-model game.toml "
                 "--output no.toml") == 1);
  CHECK(contains(tool.read("said"), "--truth takes one value for each recording: got 1 for 2"));
  CHECK(tool.run(learn + "--weight 1 2 --output no.toml") == 1);
  CHECK(contains(tool.read("said"),
                 "--weight takes one value for each recording, or one for all: got 2 for 1"));
  CHECK(tool.run(learn + "--output game.truth.csv") == 1);
  CHECK(contains(tool.read("said"), "--output would overwrite the input"));

  // Truth of another recording.
  tool.write("away.csv", "t_us,x,y,width,height\n0,5,470,50,40\n2000000,5,470,50,40\n");
  CHECK(tool.run("evidence game.raw --truth away.csv --truth-gap-ms 5000 --size-model game.toml "
                 "--output no.toml") == 1);
  CHECK(contains(tool.read("said"), "game.raw: no events are of the puck at its true positions"));
  CHECK(tool.read("no.toml").empty());
}

TEST_CASE("puck-calibrate hot-pixels writes a mask and prints the number of masked pixels") {
  const Tool tool;
  std::string events;
  for (int ms = 0; ms < 2000; ms += 4) {
    events += std::to_string(1000 * ms + 7) + " 12 34 1\n";
    if (ms % 40 == 0)
      events += std::to_string(1000 * ms + 7) + " " + std::to_string(ms % 64) + " 5 0\n";
  }
  tool.write("a.txt", events);
  REQUIRE(tool.run("hot-pixels a.txt --width 64 --height 48 --output mask.toml") == 0);
  const std::string said = tool.read("said");
  CHECK(contains(said, "1 hot pixels in 2.0 s"));
  CHECK(contains(said, "they made 500 of 550 events, 90.91 %"));
  CHECK(contains(said, "  12   34     250.5"));
  const std::string mask = tool.read("mask.toml");
  CHECK(mask.starts_with("# puck-calibrate hot-pixels a.txt"));
  CHECK(contains(mask, "width = 64\nheight = 48\npixels = [\n  12, 34,\n]\n"));
  tool.write("short.txt", "0 1 1 1\n500 1 1 1\n");
  CHECK(tool.run("hot-pixels short.txt --width 64 --height 48 --output no.toml") == 1);
  CHECK(contains(tool.read("said"), "short.txt: hot pixels need a second of events or more"));
}

TEST_CASE("puck-calibrate exits with 1 for a missing file and 2 for a wrong command line") {
  const Tool tool;
  CHECK(tool.run("table nowhere.csv --output table.toml") == 1);
  CHECK(contains(tool.read("said"), "nowhere.csv"));
  CHECK(tool.run("table nowhere.csv") == 2);
  CHECK(tool.run("") == 2);
  CHECK(tool.run("--help") == 0);
}

TEST_CASE("puck-calibrate arm writes a joint table and prints the mallet's limits") {
  const Tool tool;
  std::string rows = "y_m,joint_0_deg,joint_1_deg\n";
  std::string table;
  for (int i = 0; i <= 10; ++i) {
    const double y_m = -0.1 + 0.02 * i;
    rows += std::to_string(y_m) + "," + std::to_string(100 * y_m) + ",5\n";
    table += std::to_string(y_m + 0.05) + "\t0\t0\t30";
    for (int k = 0; k < 13; ++k) table += "\t" + std::to_string(-50 * y_m * (k + 1));
    table += "\n";
  }
  tool.write("pairs.csv", rows);
  CHECK(tool.run("arm pairs.csv --max-velocity 50 --output arm.toml") == 0);
  CHECK(contains(tool.read("said"), "11 pairs at 11 places: y -0.100 to 0.100 m"));
  CHECK(contains(tool.read("said"), "to and fro"));
  CHECK(contains(tool.read("said"), "the mallet reaches 0.500 m/s, 6.00 m/s^2 and 120.0"));
  CHECK(contains(tool.read("arm.toml"), "# puck-calibrate arm pairs.csv"));
  CHECK(contains(tool.read("arm.toml"), "[joint_1]"));

  tool.write("table.tsv", table);
  CHECK(tool.run("arm table.tsv --centre 0.05 --mirror --output authors.toml") == 0);
  CHECK(contains(tool.read("said"), "y -0.100 to 0.100 m"));
  CHECK(contains(tool.read("authors.toml"), "joints = 7"));

  tool.write("still.csv", "y_m,joint_0_deg\n0,1\n0.1,1\n0.2,1\n0.3,1\n");
  CHECK(tool.run("arm still.csv --output none.toml") == 1);
  CHECK(contains(tool.read("said"), "still.csv: joint table: no joint grows or falls"));
  CHECK(tool.read("none.toml").empty());
  CHECK(tool.run("arm pairs.csv --output pairs.csv") == 1);
}

}  // namespace
}  // namespace puck
