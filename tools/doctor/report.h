#pragma once

#include <string>

#include "tools/doctor/finding.h"

namespace puck {

/// For people: a paragraph for each finding, in columns, wrapped at 100 characters.
std::string report_text(const Findings& findings);

/// For scripts: {"wrong": N, "notes": N, "findings": [{"check", "verdict", "text", "mend"}, …]}.
std::string report_json(const Findings& findings);

int count(const Findings& findings, Verdict verdict);

}  // namespace puck
