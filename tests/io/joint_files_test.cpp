#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "common/io/csv_file.h"
#include "common/io/joint_pairs_file.h"
#include "common/io/joint_table_file.h"
#include "common/motion/simulated_joints.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

std::filesystem::path written(const TemporaryFolder& folder, const std::string& name,
                              const std::string& text) {
  std::ofstream(folder.path() / name) << text;
  return folder.path() / name;
}

template <typename Read>
std::string refusal_of(const Read& read) {
  try {
    read();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("A written joint table is read back to the bit") {
  const TemporaryFolder folder;
  const JointTableParams params = simulated_joints();
  write_joint_table_file(folder.path() / "arm.toml", params, "made by a test");
  const JointTableParams again = read_joint_table_file(folder.path() / "arm.toml");
  CHECK(joint_table_text(again, "") == joint_table_text(params, ""));
  REQUIRE(again.joints.size() == 7);
  CHECK(again.joints[3].control_deg == params.joints[3].control_deg);
}

TEST_CASE("The simulated arm's joint table equals the built-in one") {
  const JointTableParams params =
      read_joint_table_file(source_folder() / "config/calibration/simulated_arm.toml");
  CHECK(joint_table_text(params, "") == joint_table_text(simulated_joints(), ""));
}

TEST_CASE("An unusable joint table is refused with file and key") {
  const TemporaryFolder folder;
  const std::string good = joint_table_text(simulated_joints(), "");
  const auto refusal = [&](const std::string& text) {
    const auto path = written(folder, "arm.toml", text);
    return refusal_of([&] { read_joint_table_file(path); });
  };
  CHECK(refusal(good).empty());
  CHECK(refusal("[line]\njoints = 1\n").find("line.from_m") != std::string::npos);
  CHECK(refusal("[line]\njoints = 17\n").find("line.joints") != std::string::npos);
  CHECK(refusal(good + "[joint_7]\nname = \"one more\"\n").find("joint_7.name") !=
        std::string::npos);
  const std::string key = "max_jerk_deg_s3";
  std::string lacks = good;
  lacks.replace(lacks.find(key), key.size(), "max_jerk_of_it");
  CHECK(refusal(lacks).find("joint_0.max_jerk_deg_s3") != std::string::npos);
  std::string outside = good;
  outside.replace(outside.find("highest_deg"), 11, "highest_deg = -40.0 #");
  CHECK(refusal(outside).find("arm.toml: joint table: joint_0 leaves its limits") !=
        std::string::npos);
}

TEST_CASE("Measured pairs are read with any number of joints") {
  const TemporaryFolder folder;
  const auto pairs = read_joint_pairs(
      written(folder, "p.csv", "y_m,joint_0_deg,joint_1_deg\n-0.1,1,2\n0.1,3,4\n"));
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[1].y_m == 0.1);
  CHECK(pairs[1].deg == std::vector<double>{3, 4});
  CHECK(refusal_of([&] {
          read_joint_pairs(written(folder, "gap.csv", "y_m,joint_0_deg,joint_2_deg\n0,1,2\n"));
        }).find("joint_1_deg is missing") != std::string::npos);
  CHECK(refusal_of([&] {
          read_joint_pairs(written(folder, "wild.csv", "y_m,joint_0_deg\n0,1000\n"));
        }).find("joint_0_deg") != std::string::npos);
}

TEST_CASE("The authors' table is read by the robot's parts") {
  const TemporaryFolder folder;
  const auto path = written(folder, "table.tsv",
                            "-0.12\t1\t2\t3\t4\t5\t6\t7\t8\t9\t10\t11\t12\t13\t14\t15\t16\n"
                            "0.23\t1\t2\t3\t40\t5\t6\t7\t8\t9\t10\t11\t12\t13\t14\t15\t16\n\n");
  const auto arm = read_authors_joint_table(path, RobotPart::kArm);
  REQUIRE(arm.size() == 2);
  CHECK(arm[0].y_m == -0.12);
  CHECK(arm[1].deg == std::vector<double>{40, 5, 6, 7, 8, 9, 10});
  CHECK(read_authors_joint_table(path, RobotPart::kTorso)[0].deg == std::vector<double>{3, 2, 1});
  CHECK(read_authors_joint_table(path, RobotPart::kHead)[0].deg.size() == 6);
  for (const char* bad : {"", "1\t2\t3\n", "0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 nan\n",
                          "0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 x\n"}) {
    CHECK_THROWS_AS(read_authors_joint_table(written(folder, "bad.tsv", bad), RobotPart::kArm),
                    CsvError);
  }
}

}  // namespace
}  // namespace puck
