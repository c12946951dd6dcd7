#include "tools/view/drawing/palette.h"

namespace puck {
namespace {

cv::Scalar rgb(unsigned value) {
  return {static_cast<double>(value & 0xffU), static_cast<double>(value >> 8 & 0xffU),
          static_cast<double>(value >> 16 & 0xffU)};
}

const Palette kDark{.background = rgb(0x0d1117),
                    .bar = rgb(0x161b22),
                    .words = rgb(0xe6edf3),
                    .quiet = rgb(0x96a0ac),
                    .brighter = rgb(0xf0a528),
                    .darker = rgb(0x56a0f0),
                    .estimate = rgb(0xffffff),
                    .halo = rgb(0x0d1117),
                    .trail = rgb(0x2fce98),
                    .truth = rgb(0xff7ac8),
                    .region = rgb(0x96a0ac),
                    .covariance = rgb(0xf0e442),
                    .doubt = rgb(0xf0e442)};

const Palette kLight{.background = rgb(0xffffff),
                     .bar = rgb(0xeef1f4),
                     .words = rgb(0x14181d),
                     .quiet = rgb(0x5c6670),
                     .brighter = rgb(0xd07800),
                     .darker = rgb(0x2068c0),
                     .estimate = rgb(0x000000),
                     .halo = rgb(0xffffff),
                     .trail = rgb(0x007f5c),
                     .truth = rgb(0xb8398a),
                     .region = rgb(0x5c6670),
                     .covariance = rgb(0x8a6d00),
                     .doubt = rgb(0x9a3c00)};

}  // namespace

const Palette& palette_of(PictureWishes::Theme theme) {
  return theme == PictureWishes::Theme::kLight ? kLight : kDark;
}

cv::Scalar mixed(const cv::Scalar& from, const cv::Scalar& to, double share) {
  return from * (1 - share) + to * share;
}

}  // namespace puck
