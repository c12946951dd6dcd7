#pragma once

#include "tools/play/options.h"

namespace puck {

/// Runs the program. Throws std::exception with a message of one line.
void run(const PlayOptions& options);

}  // namespace puck
