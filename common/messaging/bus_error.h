#pragma once

#include <stdexcept>

namespace puck {

/// An error in the bus's settings, as one line for the operator.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace puck
