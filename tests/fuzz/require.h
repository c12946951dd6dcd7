#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace puck {

/// A condition for every input; a fuzzer reports the abort as a finding.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// An error message about bad input must be one line without terminal controls.
inline void require_one_line(std::string_view message) {
  require(!message.empty(), "a refusal says why");
  require(std::none_of(message.begin(), message.end(),
                       [](unsigned char c) { return c < 0x20 || c == 0x7f; }),
          "a refusal is one line without control characters");
}

}  // namespace puck
