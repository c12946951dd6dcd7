#pragma once

#include <stdexcept>
#include <string>

namespace puck::test {

/// The message of the std::invalid_argument that `make` throws; empty without one.
template <typename Make>
std::string refusal(Make make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace puck::test
