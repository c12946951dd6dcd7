#pragma once

#include <cstdint>

namespace puck {

/// An IIT camera's address of an event: the polarity in bit 0, x in bits 1 to 11, y in bits 12 to
/// 21, the eye (0: left, 1: right) in bit 22. Stamps have 31 bits.

inline constexpr std::uint32_t kYarpStampMask = 0x7fffffff;

inline int yarp_x_of(std::uint32_t address) { return static_cast<int>(address >> 1 & 0x7ff); }
inline int yarp_y_of(std::uint32_t address) { return static_cast<int>(address >> 12 & 0x3ff); }
inline std::uint32_t yarp_eye_of(std::uint32_t address) { return address >> 22 & 1; }

/// Samples of inertial sensors, skin and sound set a bit above the address. Bit 25 marks an event
/// on a corner.
inline bool is_yarp_event(std::uint32_t address) { return (address & 0xfd800000) == 0; }

}  // namespace puck
