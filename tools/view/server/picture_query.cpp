#include "tools/view/server/picture_query.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "tools/view/interface/layer_names.h"

namespace puck {
namespace {

// Bounds the time and the bytes of a picture.
constexpr int kMostWidth_px = 2560;
constexpr int kMostHeight_px = 1440;

std::string_view value_of(const HttpRequest& request, std::string_view key) {
  const auto found = request.query.find(key);
  return found == request.query.end() ? std::string_view{} : std::string_view(found->second);
}

void hide(std::string_view names, PictureWishes::Layers& layers) {
  while (!names.empty()) {
    const std::string_view name = names.substr(0, names.find(','));
    names.remove_prefix(std::min(name.size() + 1, names.size()));
    for (const auto& [known, layer] : kLayerNames) {
      if (known == name) layers.*layer = false;
    }
  }
}

}  // namespace

std::int64_t number_of(const HttpRequest& request, const char* key, std::int64_t other,
                       std::int64_t least, std::int64_t most) {
  const std::string_view text = value_of(request, key);
  std::int64_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc{} || rest != text.data() + text.size()) return other;
  return std::clamp(number, least, most);
}

PictureWishes wishes_of(const HttpRequest& request) {
  PictureWishes wishes;
  if (value_of(request, "view") == "table") wishes.view = PictureWishes::View::kTable;
  const std::string_view backdrop = value_of(request, "backdrop");
  if (backdrop == "surface") wishes.backdrop = PictureWishes::Backdrop::kSurface;
  if (backdrop == "heat") wishes.backdrop = PictureWishes::Backdrop::kHeatMap;
  if (value_of(request, "theme") == "light") wishes.theme = PictureWishes::Theme::kLight;
  const auto whole = [&](const char* key, int other, int least, int most) {
    return static_cast<int>(number_of(request, key, other, least, most));
  };
  wishes.side = whole("side", wishes.side, 0, 1);
  wishes.width_px = whole("width", wishes.width_px, PictureWishes::kLeastSide_px, kMostWidth_px);
  wishes.height_px =
      whole("height", wishes.height_px, PictureWishes::kLeastSide_px, kMostHeight_px);
  wishes.window_us = number_of(request, "window_us", wishes.window_us,
                               PictureWishes::kShortestWindow_us, PictureWishes::kLongestWindow_us);
  hide(value_of(request, "hide"), wishes.layers);
  return wishes;
}

}  // namespace puck
