#include "common/yarp/yarp_error.h"

namespace puck {

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 80;
  std::string result = "\"";
  for (const char c : text.substr(0, kMost)) result += c >= 0x20 && c < 0x7f ? c : '?';
  return result + (text.size() > kMost ? "…\"" : "\"");
}

}  // namespace puck
