#pragma once

#include <string>

#include "tools/demo_report/demo_figures.h"

namespace puck {

/// The figures as a table for people, lines of at most 80 characters, and in its last line a
/// sentence that says what happened. What is missing is a dash.
std::string demo_table(const DemoFigures& figures);

}  // namespace puck
