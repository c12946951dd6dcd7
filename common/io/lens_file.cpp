#include "common/io/lens_file.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "common/io/config.h"

namespace puck {

Lens read_lens_file(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 2> kModels{"pinhole", "fisheye"};
  constexpr std::array<const char*, 5> kPinhole{"lens.k1", "lens.k2", "lens.p1", "lens.p2",
                                                "lens.k3"};
  constexpr std::array<const char*, 4> kFisheye{"lens.k1", "lens.k2", "lens.k3", "lens.k4"};
  constexpr double kLongest_px = 1e5;
  constexpr double kMostDistortion = 1e6;
  Config config = Config::from_file(path);
  for (const char* key :
       {"lens.width", "lens.height", "lens.fx", "lens.fy", "lens.cx", "lens.cy"}) {
    if (!config.has(key)) config.fail(key, "is missing");
  }
  Lens lens;
  std::string model = "pinhole";
  config.read_choice("lens.model", model, kModels);
  lens.model = model == "fisheye" ? Lens::Model::kFisheye : Lens::Model::kPinhole;
  config.read("lens.width", lens.sensor.width, 1, SensorSize::kMax);
  config.read("lens.height", lens.sensor.height, 1, SensorSize::kMax);
  config.read("lens.fx", lens.fx_px, 1, kLongest_px);
  config.read("lens.fy", lens.fy_px, 1, kLongest_px);
  config.read("lens.cx", lens.cx_px, -kLongest_px, kLongest_px);
  config.read("lens.cy", lens.cy_px, -kLongest_px, kLongest_px);
  const std::span<const char* const> keys = lens.model == Lens::Model::kFisheye
                                                ? std::span<const char* const>(kFisheye)
                                                : std::span<const char* const>(kPinhole);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    config.read(keys[i], lens.distortion[i], -kMostDistortion, kMostDistortion);
  }
  config.reject_unknown();
  return lens;
}

}  // namespace puck
