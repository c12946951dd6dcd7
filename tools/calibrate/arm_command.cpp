#include "tools/calibrate/arm_command.h"

#include <cstdio>
#include <limits>
#include <vector>

#include "common/io/joint_pairs_file.h"
#include "common/io/joint_table_file.h"

namespace puck {
namespace {

RobotPart part_of(const std::string& name) {
  if (name == "torso") return RobotPart::kTorso;
  return name == "head" ? RobotPart::kHead : RobotPart::kArm;
}

std::vector<JointPair> read_pairs(const ArmFitCommand& command) {
  std::vector<JointPair> pairs =
      command.pairs.extension() == ".tsv"
          ? read_authors_joint_table(command.pairs, part_of(command.part))
          : read_joint_pairs(command.pairs);
  for (JointPair& pair : pairs) {
    pair.y_m -= command.centre_m;
    if (command.mirror) pair.y_m = -pair.y_m;
  }
  return pairs;
}

void print(const JointFit& fit, std::size_t rows) {
  const JointTable table(fit.table);
  std::printf("%zu pairs at %zu places: y %.3f to %.3f m, the longest gap %.1f mm\n", rows,
              fit.places, fit.table.from_m, fit.table.to_m, 1e3 * fit.longest_gap_m);
  std::printf("%zu intervals\n", fit.table.joints.front().control_deg.size() - 3);
  std::printf("joint   along the line   residual rms      max, deg   may be at, deg\n");
  for (std::size_t k = 0; k < fit.residuals.size(); ++k) {
    const JointResidual& residual = fit.residuals[k];
    std::printf("%5zu   %14s   %12.3f %13.3f   %.1f to %.1f\n", k,
                residual.is_monotone ? "one way" : "to and fro", residual.rms_deg, residual.max_deg,
                table.limits(k).lowest, table.limits(k).highest);
  }
  constexpr double kAny = std::numeric_limits<double>::max();
  const MotionLimits line = table.line_limits({0, 0, kAny, kAny, kAny});
  const MotionLimits& joint = table.limits(0);
  std::printf(
      "with the joints' limits of %g deg/s, %g deg/s^2 and %g deg/s^3 the mallet reaches %.3f "
      "m/s, %.2f m/s^2 and %.1f m/s^3 everywhere on the line\n",
      joint.velocity, joint.acceleration, joint.jerk, line.velocity, line.acceleration, line.jerk);
}

}  // namespace

void calibrate_arm(const ArmFitCommand& command, const std::string& typed) {
  const std::vector<JointPair> pairs = read_pairs(command);
  const JointFit fit = fit_joint_table(pairs, command.fit);
  write_joint_table_file(command.output, fit.table, typed);
  print(fit, pairs.size());
}

}  // namespace puck
