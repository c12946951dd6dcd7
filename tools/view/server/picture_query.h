#pragma once

#include "tools/view/interface/picture_wishes.h"
#include "tools/view/server/http_message.h"

namespace puck {

/// The wishes in the query of `GET /picture`: view, backdrop, theme, side, window_us, width,
/// height, and hide, a list of layers with commas between them. What is missing or unknown keeps
/// its default, and numbers are clamped to what the server draws.
PictureWishes wishes_of(const HttpRequest& request);

/// A whole number of the query, clamped; `other` if it is missing or no number.
std::int64_t number_of(const HttpRequest& request, const char* key, std::int64_t other,
                       std::int64_t least, std::int64_t most);

}  // namespace puck
