#pragma once

namespace puck {

/// As the doctor calls itself in its STATUS and on its command line.
inline constexpr const char* kDoctorName = "puck-doctor";

}  // namespace puck
