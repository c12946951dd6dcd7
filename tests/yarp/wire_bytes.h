#pragma once

#include <string>
#include <string_view>

#include "common/yarp/little_endian.h"

namespace puck {

/// Bytes written as text; `\0` within it needs a literal with the suffix `sv`.
inline Bytes wire(std::string_view text) { return {text.begin(), text.end()}; }

inline std::string as_text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace puck
