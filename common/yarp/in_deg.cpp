#include "common/yarp/in_deg.h"

#include <array>
#include <cstdio>

namespace puck {

std::string in_deg(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g deg", value);
  return text.data();
}

}  // namespace puck
