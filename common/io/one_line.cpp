#include "common/io/one_line.h"

#include <algorithm>

namespace puck {

std::string one_line(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return message;
}

}  // namespace puck
