#pragma once

#include <filesystem>

#include "tools/compare/report.h"

namespace puck {

/// The paper's figures as PNG: errors-SET.png (box plot on a logarithmic axis, a group for each
/// sequence), within-SET.png (share of the positions within each error), trajectories-SET.png (x
/// and y over time and in the image, with truth), latency.png; and our own: hard.png (errors and
/// losses of all sets), covariance.png (consistency with the errors) and score.png (precision over
/// recall, and the choice of a threshold). Throws std::runtime_error when one cannot be written.
void write_charts(const ComparisonReport& report, const std::filesystem::path& folder);

}  // namespace puck
