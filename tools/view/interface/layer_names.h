#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "tools/view/interface/picture_wishes.h"

namespace puck {

/// The layers' names on command lines and in requests, and their switches.
inline constexpr std::array<std::pair<std::string_view, bool PictureWishes::Layers::*>, 9>
    kLayerNames{{{"regions", &PictureWishes::Layers::regions},
                 {"ellipse", &PictureWishes::Layers::ellipse},
                 {"velocity", &PictureWishes::Layers::velocity},
                 {"covariance", &PictureWishes::Layers::covariance},
                 {"trail", &PictureWishes::Layers::trail},
                 {"truth", &PictureWishes::Layers::truth},
                 {"close-up", &PictureWishes::Layers::close_up},
                 {"words", &PictureWishes::Layers::words},
                 {"legend", &PictureWishes::Layers::legend}}};

}  // namespace puck
