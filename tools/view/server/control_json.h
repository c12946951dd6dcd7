#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "tools/view/interface/view_control.h"

namespace puck {

/// Reads {"action": "seek", "value": 1.5, "side": 0, "name": "default"}; all but the action may be
/// missing. Returns the reason, in one line, for any other bytes.
std::variant<ViewControl, std::string> parse_control(std::string_view text);

}  // namespace puck
