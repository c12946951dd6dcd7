#include "common/io/joint_table_file.h"

#include <array>
#include <stdexcept>

#include "common/io/calibration_text.h"
#include "common/io/config.h"
#include "common/io/number_limits.h"
#include "common/io/toml_entries.h"

namespace puck {
namespace {

struct Limit {
  const char* key = nullptr;
  double MotionLimits::*member = nullptr;
  double lowest = 0;
  double highest = 0;
};

constexpr double kMostRate = 1e9;
constexpr std::array<Limit, 5> kLimits{{
    {"lowest_deg", &MotionLimits::lowest, -kMostJointDeg, kMostJointDeg},
    {"highest_deg", &MotionLimits::highest, -kMostJointDeg, kMostJointDeg},
    {"max_velocity_deg_s", &MotionLimits::velocity, 1e-3, kMostRate},
    {"max_acceleration_deg_s2", &MotionLimits::acceleration, 1e-3, kMostRate},
    {"max_jerk_deg_s3", &MotionLimits::jerk, 1e-3, kMostRate},
}};
constexpr double kLongestM = 10;

template <typename Value>
void read_present(Config& config, const std::string& key, Value& value, double lowest,
                  double highest) {
  if (!config.has(key)) config.fail(key, "is missing");
  config.read(key, value, lowest, highest);
}

std::string table_of(std::size_t joint) { return "joint_" + std::to_string(joint); }

}  // namespace

JointTableParams read_joint_table_file(const std::filesystem::path& path) {
  Config config = Config::from_file(path);
  JointTableParams params;
  int joints = 0;
  if (!config.has("line.joints")) config.fail("line.joints", "is missing");
  config.read("line.joints", joints, 1, static_cast<int>(JointTable::kMostJoints));
  read_present(config, "line.from_m", params.from_m, -kLongestM, kLongestM);
  read_present(config, "line.to_m", params.to_m, -kLongestM, kLongestM);
  params.joints.resize(static_cast<std::size_t>(joints));
  for (std::size_t k = 0; k < params.joints.size(); ++k) {
    LineJoint& joint = params.joints[k];
    const std::string table = table_of(k) + ".";
    config.read(table + "name", joint.name);
    for (const Limit& limit : kLimits) {
      read_present(config, table + limit.key, joint.limits.*limit.member, limit.lowest,
                   limit.highest);
    }
    read_present(config, table + "control_deg", joint.control_deg, -kMostJointDeg, kMostJointDeg);
  }
  config.reject_unknown();
  try {
    const JointTable usable(params);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(path.string() + ": " + error.what());
  }
  return params;
}

std::string joint_table_text(const JointTableParams& params, std::string_view provenance) {
  std::string text = toml_comment(provenance) +
                     "# The mallet's range, y of the table frame, and the joints that move it, in "
                     "the order of\n# the control board.\n[line]\n";
  text += "joints = " + std::to_string(params.joints.size()) + "\n";
  text += "from_m = " + toml_number(params.from_m) + "\n";
  text += "to_m = " + toml_number(params.to_m) + "\n";
  for (std::size_t k = 0; k < params.joints.size(); ++k) {
    const LineJoint& joint = params.joints[k];
    text += "\n[" + table_of(k) + "]\nname = " + quoted_toml(joint.name) + "\n";
    for (const Limit& limit : kLimits) {
      text += std::string(limit.key) + " = " + toml_number(joint.limits.*limit.member) + "\n";
    }
    text +=
        "# Control points of a cubic B-spline with uniform knots: nearly the angles at uniform "
        "places\n# along the line, and one more beyond either end.\ncontrol_deg = [";
    for (std::size_t i = 0; i < joint.control_deg.size(); ++i) {
      text += (i > 0 ? ", " : "") + toml_number(joint.control_deg[i]);
    }
    text += "]\n";
  }
  return text;
}

void write_joint_table_file(const std::filesystem::path& path, const JointTableParams& params,
                            std::string_view provenance) {
  write_calibration_text(path, joint_table_text(params, provenance));
}

}  // namespace puck
