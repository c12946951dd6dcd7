#pragma once

#include "tools/play/options.h"

namespace puck {

/// Does what the command line asks for. Throws std::exception with a line for a person.
void run(const PlayOptions& options);

}  // namespace puck
