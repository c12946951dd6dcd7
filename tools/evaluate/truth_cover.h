#pragma once

#include <optional>
#include <string>

#include "common/evaluation/accuracy_score.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// What to tell when truth does not cover a recording, or not a single tick counts: truth that
/// spares a recording its difficult end must not go unnoticed. Nothing when all is well; less than
/// 100 ms do not matter.
std::optional<std::string> truth_warning(const AccuracyScore& score, const RunSummary& run);

}  // namespace puck
