#pragma once

namespace puck {

/// In STATUS and on the command line.
inline constexpr const char* kDoctorName = "puck-doctor";

}  // namespace puck
