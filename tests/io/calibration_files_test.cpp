#include <doctest/doctest.h>

#include "common/io/calibration_text.h"
#include "common/io/config.h"
#include "common/io/contour_calibration_file.h"
#include "common/io/size_model_file.h"
#include "common/io/table_file.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

const std::string kSizeModel =
    "[size_model]\nwidth_0 = 1\nwidth_x = 2\nwidth_y = 3\nheight_0 = 4\nheight_x = 5\nheight_y = "
    "6\n";

TEST_CASE("a size model is unchanged by its file, which begins with its provenance") {
  const TemporaryFolder folder;
  PuckSizeModel model{20.1, 1.0 / 3, -0.01, 12, 1e-7, 0.025};
  model.smallest = {11.5, 4};
  model.largest = {70, 1.0 / 3 + 60};
  model.sensor = {1280, 720};
  write_size_model_file(folder / "size.toml", model, "fitted to 12 annotations\nby hand");
  const PuckSizeModel again = read_size_model_file(folder / "size.toml");
  CHECK(again.width_0 == model.width_0);
  CHECK(again.width_x == model.width_x);
  CHECK(again.width_y == model.width_y);
  CHECK(again.height_0 == model.height_0);
  CHECK(again.height_x == model.height_x);
  CHECK(again.height_y == model.height_y);
  CHECK(again.smallest.width == 11.5);
  CHECK(again.smallest.height == 4);
  CHECK(again.largest.width == 70);
  CHECK(again.largest.height == model.largest.height);
  CHECK(again.sensor == SensorSize{1280, 720});
  CHECK_FALSE(again.disc.has_value());
  CHECK(read_text(folder / "size.toml").starts_with("# fitted to 12 annotations\n# by hand\n"));
}

TEST_CASE("the disc behind a size model is unchanged by its file") {
  const TemporaryFolder folder;
  PuckSizeModel model{20, 0, 0.1, 12, 0, 0.1};
  model.disc = DiscModel{.width_0 = 16.1,
                         .width_x = -1e-4,
                         .width_y = 0.069,
                         .face_on_px = 61,
                         .thickness = 0.19,
                         .principal_x_px = 312.4,
                         .principal_y_px = 239.5};
  write_size_model_file(folder / "size.toml", model, "");
  const auto disc = read_size_model_file(folder / "size.toml").disc;
  REQUIRE(disc.has_value());
  for (const Pixel position : {Pixel{0, 0}, Pixel{600, 100}, Pixel{300, 450}}) {
    CHECK(disc->at(position).width == model.disc->at(position).width);
    CHECK(disc->at(position).height == model.disc->at(position).height);
  }
}

TEST_CASE("a size model with a missing or wrong coefficient is refused") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto path = folder.write("size.toml", text);
    return message_of<ConfigError>([&] { read_size_model_file(path); });
  };
  CHECK(refusal(kSizeModel).empty());
  CHECK(contains(refusal(kSizeModel + "[size_range]\nsmallest_height = 600\n"),
                 "size.toml:9: size_range.smallest_height must not be above the largest"));
  CHECK(contains(refusal(kSizeModel + "[size_range]\nsmallest_width = 0\n"),
                 "size.toml:9: size_range.smallest_width must be a number from 1"));
  CHECK(contains(refusal(kSizeModel + "[disc]\nwidth_0 = 16\n"), "disc.width_x is missing"));
  CHECK(contains(refusal(kSizeModel + "[disc]\nwidth_0 = 1\nwidth_x = 0\nwidth_y = 0\n"
                                      "face_on_px = 0\nthickness = 0\nprincipal_x_px = 0\n"
                                      "principal_y_px = 0\n"),
                 "size.toml:12: disc.face_on_px must be a number from 0.001"));
  CHECK(
      contains(refusal(kSizeModel + "[disc]\nwidth_0 = 0\nwidth_x = 0\nwidth_y = -1\n"
                                    "face_on_px = 60\nthickness = 0\nprincipal_x_px = 0\n"
                                    "principal_y_px = 0\n"),
               "size.toml:9: disc.width_0 must be above 0, or width_x or width_y: the puck has no "
               "width anywhere in the image"));
  CHECK(contains(refusal(kSizeModel.substr(0, kSizeModel.find("height_y"))),
                 "size.toml: size_model.height_y is missing"));
  CHECK(contains(refusal(kSizeModel.substr(0, kSizeModel.find("6\n")) + "\"x\"\n"),
                 "size.toml:7: size_model.height_y must be a number"));
  CHECK(contains(refusal("[size_model]\nwidth_0 = 9\nwidth_x = 0\nwidth_y = 0\nheight_0 = 0\n"
                         "height_x = 0\nheight_y = -0.1\n"),
                 "size.toml:5: size_model.height_0 must be above 0, or height_x or height_y: the "
                 "puck has no height anywhere in the image"));
  CHECK(contains(message_of<ConfigError>([&] { write_size_model_file(folder / "no/a", {}, ""); }),
                 "cannot be written"));
}

TEST_CASE("a contour calibration is unchanged by its file, beside a size model") {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "size.toml", kSizeModel + contour_calibration_text({390.5, 0.16, -0.25, 0.08, -28}, "lag"));
  const auto again = read_contour_calibration(path);
  REQUIRE(again.has_value());
  CHECK(again->lag_us == 390.5);
  CHECK(again->wall_share == 0.16);
  CHECK(again->grow_px == -0.25);
  CHECK(again->trail_px == 0.08);
  CHECK(again->lean_deg == -28);
  CHECK(read_size_model_file(path).height_y == 6);
}

TEST_CASE("a table is removed from a calibration with its comment, and nothing else") {
  const std::string head = "# made by hand\n[a]\nx = 1  # [b]\n";
  const std::string table =
      "# of the contour\n# two lines\n[contour]\nlag_us = 1\n# within\nx = 2\n";
  const std::string tail = "# of c\n[c]\ny = 1\n";
  CHECK(without_table(head + table + tail, "contour") == head + tail);
  CHECK(without_table(head + table, "contour") == head);
  CHECK(without_table(head + tail, "contour") == head + tail);
  CHECK(without_table("[contour]\nz = 1", "contour").empty());
  CHECK(without_table("x = 1\n# end", "contour") == "x = 1\n# end");
}

TEST_CASE("a file without a contour table has no contour calibration, a wrong value is refused") {
  const TemporaryFolder folder;
  CHECK_FALSE(read_contour_calibration(folder.write("size.toml", kSizeModel)).has_value());
  const auto some = read_contour_calibration(folder.write("some.toml", "[contour]\nlag_us = 1\n"));
  REQUIRE(some.has_value());
  CHECK(some->lag_us == 1);
  CHECK(some->grow_px == ContourCalibration{}.grow_px);
  const auto wrong = folder.write("wrong.toml", "[contour]\nlag_us = 1e9\n");
  CHECK(contains(message_of<ConfigError>([&] { read_contour_calibration(wrong); }),
                 "wrong.toml:2: contour.lag_us must be a number from"));
  const auto leans = folder.write("leans.toml", "[contour]\nlean_deg = 41\n");
  CHECK(contains(message_of<ConfigError>([&] { read_contour_calibration(leans); }),
                 "leans.toml:2: contour.lean_deg must be a number from -40 to 40"));
}

TEST_CASE("a table is unchanged by its file") {
  const TemporaryFolder folder;
  TableCalibration calibration{Homography({0.003, 0, -0.9, 0, 0.004, 0.1, 0, 0.0005, 1}), {}};
  calibration.geometry.length_m = 1.9;
  write_table_file(folder / "table.toml", calibration, "measured");
  const TableCalibration again = read_table_file(folder / "table.toml");
  CHECK(again.table_from_image.table_from_image() ==
        calibration.table_from_image.table_from_image());
  CHECK(again.geometry.length_m == 1.9);
  CHECK(again.geometry.puck_radius_m == 0.0325);
}

TEST_CASE("a table's camera is unchanged by its file; half a camera is refused") {
  const TemporaryFolder folder;
  const TableCalibration calibration{Homography({0.003, 0, -0.9, 0, 0.004, 0.1, 0, 0.0005, 1}),
                                     {},
                                     PinholeCamera{740.5, {319.5, 239}, {0.02, 0.1, -0.08}}};
  write_table_file(folder / "table.toml", calibration, "measured");
  const TableCalibration again = read_table_file(folder / "table.toml");
  REQUIRE(again.camera);
  CHECK(again.camera->focal_px == 740.5);
  CHECK(again.camera->principal_point == Pixel{319.5, 239});
  CHECK(again.camera->pivot_m == calibration.camera->pivot_m);

  const std::string table = "[table]\ntable_from_image = [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
  const auto refusal = [&](const std::string& camera) {
    const auto path = folder.write("half.toml", table + "[camera]\n" + camera);
    return message_of<ConfigError>([&] { read_table_file(path); });
  };
  CHECK(contains(refusal("focal_px = 700\n"), "camera.principal_x_px is missing"));
  CHECK(contains(refusal("pivot_m = [0, 0, 0]\n"), "camera.focal_px is missing"));
  const std::string whole = "focal_px = 700\nprincipal_x_px = 320\nprincipal_y_px = 240\n";
  CHECK(refusal(whole).empty());
  CHECK(contains(refusal(whole + "pivot = [0, 0, 0]\n"), "half.toml:7"));
}

TEST_CASE("a table's motion constants are unchanged by their file; an incomplete set is refused") {
  const TemporaryFolder folder;
  const TableCalibration calibration{Homography({0.003, 0, -0.9, 0, 0.004, 0.1, 0, 0.0005, 1}),
                                     {},
                                     std::nullopt,
                                     MotionConstants{0.21, 0.83, 0.92}};
  write_table_file(folder / "table.toml", calibration, "measured");
  const TableCalibration again = read_table_file(folder / "table.toml");
  REQUIRE(again.motion);
  CHECK(again.motion->damping_per_s == 0.21);
  CHECK(again.motion->rail_restitution == 0.83);
  CHECK(again.motion->rail_grip == 0.92);

  const std::string table = "[table]\ntable_from_image = [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
  const auto refusal = [&](const std::string& motion) {
    const auto path = folder.write("part.toml", table + "[motion]\n" + motion);
    return message_of<ConfigError>([&] { read_table_file(path); });
  };
  CHECK(contains(refusal("rail_grip = 0.9\n"), "motion.damping_per_s is missing"));
  const std::string whole = "damping_per_s = 0.2\nrail_restitution = 0.8\nrail_grip = 0.9\n";
  CHECK(refusal(whole).empty());
  CHECK(contains(refusal(whole + "bounce_spread = 0.1\n"), "part.toml:7"));
  CHECK(contains(refusal("damping_per_s = 0.2\nrail_restitution = 1.1\nrail_grip = 0.9\n"),
                 "part.toml:5: motion.rail_restitution must be a number from 0 to 1"));
}

TEST_CASE("a table file whose homography is missing, short or singular is refused") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto path = folder.write("table.toml", text);
    return message_of<ConfigError>([&] { read_table_file(path); });
  };
  CHECK(contains(refusal("[table]\nlength_m = 2\n"), "table.table_from_image is missing"));
  CHECK(contains(refusal("[table]\ntable_from_image = [1, 0]\n"),
                 "table.toml:2: table.table_from_image must be a list of 9 numbers"));
  CHECK(contains(refusal("[table]\ntable_from_image = [1, 0, 0, 1, 0, 0, 0, 0, 1]\n"),
                 "table.toml:2: table.table_from_image cannot be used"));
  CHECK(
      contains(refusal("[table]\ntable_from_image = [1, 0, 0, 0, 1, 0, 0, 0, 1]\nlength_m = -1\n"),
               "table.toml:3: table.length_m must be a number from 0.001 to 10"));
}

}  // namespace
}  // namespace puck
