#pragma once

#include <string>

#include "tools/view/interface/view_source.h"

namespace puck {

/// Serves the page on `listen` (ADDRESS:PORT) until a signal, and prints its URL, with a token
/// unless it is for this machine only. Throws std::invalid_argument for a malformed address, and
/// std::runtime_error if it cannot listen or the page's files are missing.
void serve(ViewSource& source, const std::string& listen);

}  // namespace puck
