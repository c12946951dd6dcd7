#pragma once

#include <string>

#include "tools/demo_report/demo_figures.h"

namespace puck {

/// The figures as a table, lines of at most 80 characters, with a summary sentence in its last
/// line. A missing value is a dash.
std::string demo_table(const DemoFigures& figures);

}  // namespace puck
