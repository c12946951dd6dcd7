#pragma once

#include <stdexcept>

namespace puck {

/// What is wrong with the bus's settings, in one line for the person who started the service.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace puck
