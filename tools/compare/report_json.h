#pragma once

#include <nlohmann/json.hpp>

#include "tools/compare/report.h"

namespace puck {

/// The whole comparison: options, goals, sets with each contestant's summary and the figures of
/// each of its sequences, latency. An unmeasured value is null.
nlohmann::ordered_json report_json(const ComparisonReport& report);

}  // namespace puck
