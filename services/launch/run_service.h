#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "common/io/config.h"
#include "services/launch/command_line.h"
#include "services/launch/service.h"

namespace puck {

struct ServiceInfo {
  std::string name;         ///< puck-tracker: on the log, in STATUS, before errors.
  std::string description;  ///< For --help.
  /// The service's own options, if it has any.
  AddOptions add_options{};
  /// Asked once the bus's settings are read: an exit code when something else was wanted than to
  /// run the service (puck-arm --stop).
  std::function<std::optional<int>(const BusParams&, std::stop_token)> instead{};
};

using MakeService = std::function<std::unique_ptr<Service>(ServiceContext&)>;
/// Reads the service's settings; ConfigError and std::exception end the start with exit code 1.
using ConfigureService = std::function<MakeService(Config&)>;

/// The life of a service, from the command line to the exit code: 0 after a stop, 1 after an error,
/// 2 after a usage error.
int run_service(const ServiceInfo& info, int argc, const char* const* argv,
                const ConfigureService& configure);

/// The same for a class with `static Params read_params(Config&)` and a constructor that takes
/// (const Params&, ServiceContext&).
template <typename ServiceType>
int run_service(const ServiceInfo& info, int argc, const char* const* argv) {
  return run_service(info, argc, argv, [](Config& config) -> MakeService {
    return [params = ServiceType::read_params(config)](ServiceContext& context) {
      return std::make_unique<ServiceType>(params, context);
    };
  });
}

}  // namespace puck
