#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/events/event.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Decay of a pixel in a plain loop.
enum class PlainDecay : std::uint8_t {
  kByteTimesFloat,  ///< uint8 surface, multiplied by a float and truncated.
  kByteFixedPoint,  ///< uint8 surface, multiplied by a whole number of 1/256.
  kFloat,           ///< float surface; tiny values become 0, else denormals stall it.
};

/// EROS in careful plain C++: two loops over the window, with a width known to the compiler.
/// Compiled for the machine at hand, in a file of its own; the only intrinsic keeps denormals away.
class PlainEros {
 public:
  /// `half_width_px` is 1 to 8.
  PlainEros(SensorSize size, int half_width_px, double decay, PlainDecay form);
  ~PlainEros();

  void update(std::span<const Event> events);
  double at(int x, int y) const;

 private:
  struct Surface;
  std::unique_ptr<Surface> surface_;
};

}  // namespace puck
