#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace puck {

/// What must hold whatever the input; a fuzzer takes the abort for a finding.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// What a person is told about bad input must be one line that harms no terminal.
inline void require_one_line(std::string_view message) {
  require(!message.empty(), "a refusal says why");
  require(std::none_of(message.begin(), message.end(),
                       [](unsigned char c) { return c < 0x20 || c == 0x7f; }),
          "a refusal is one line without control characters");
}

}  // namespace puck
