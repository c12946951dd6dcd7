#pragma once

#include <sstream>
#include <stdexcept>

namespace puck {

/// Throws std::invalid_argument with `what` and the value `got` unless `holds`.
inline void require(bool holds, const char* what, double got) {
  if (holds) return;
  std::ostringstream text;
  text.precision(10);
  text << what << ", got " << got;
  throw std::invalid_argument(text.str());
}

}  // namespace puck
