#pragma once

#include <string>

#include "tools/view/interface/view_state.h"

namespace puck {

/// The state as a JSON object. Keys have units in their names; the samples are columns; what is not
/// known is null; text that is not UTF-8 is replaced.
std::string state_json(const ViewState& state);

/// The timeline likewise; spans are pairs of s since the first event.
std::string timeline_json(const ViewTimeline& timeline);

}  // namespace puck
