#pragma once

#include <string>

#include "tools/info/survey.h"

namespace puck {

/// For a person, many lines.
std::string survey_text(const Survey& survey);

/// For a script, one object; `with_pixels`: with the counts of all pixels, row by row.
std::string survey_json(const Survey& survey, bool with_pixels);

}  // namespace puck
