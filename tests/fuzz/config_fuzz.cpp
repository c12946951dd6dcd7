// Settings of every service: the first byte chooses the service, then follow the file and, after a
// zero if there is one, the text of --set.
#include <array>
#include <string>
#include <string_view>

#include "services/arm/arm_service.h"
#include "services/bridge/bridge_service.h"
#include "services/camera/camera_settings.h"
#include "services/logger/logger_service.h"
#include "services/tracker/tracker_params.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

using ReadParams = void (*)(Config&);

constexpr std::array<ReadParams, 5> kServices{
    [](Config& config) { ArmService::read_params(config); },
    [](Config& config) { BridgeService::read_params(config); },
    [](Config& config) { read_camera_settings(config); },
    [](Config& config) { LoggerService::read_params(config); },
    [](Config& config) { read_tracker_params(config); }};

void check_effective(const Config& config, ReadParams read_params) {
  Config again = Config::from_text(config.effective(), "effective");
  read_params(again);
  again.reject_unknown();
  require(again.effective() == config.effective(),
          "the effective configuration means what it was made from");
}

void read_settings(std::string_view text, ReadParams read_params) {
  const std::size_t zero = text.find('\0');
  Config config;
  try {
    config = Config::from_text(text.substr(0, zero), "fuzz.toml");
    if (zero != std::string_view::npos) config.override_with(text.substr(zero + 1));
    read_params(config);
    config.reject_unknown();
  } catch (const ConfigError& error) {
    require_one_line(error.what());
    return;
  }
  check_effective(config, read_params);
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  puck::read_settings({reinterpret_cast<const char*>(data + 1), size - 1},
                      puck::kServices[data[0] % puck::kServices.size()]);
  return 0;
}
