#pragma once

#include <stdexcept>
#include <string>

namespace puck {

[[noreturn]] inline void refuse(const std::string& why) { throw std::invalid_argument(why); }

}  // namespace puck
