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
  std::string name;         ///< puck-tracker: in the log, in STATUS, before errors.
  std::string description;  ///< For --help.
  /// The service's own options, if it has any.
  AddOptions add_options{};
  /// Called once the bus's settings are read: returns an exit code if it did something else than
  /// run the service (puck-arm --stop).
  std::function<std::optional<int>(const BusParams&, std::stop_token)> instead{};
};

using MakeService = std::function<std::unique_ptr<Service>(ServiceContext&)>;
/// Reads the service's settings; exceptions end the start with exit code 1.
using ConfigureService = std::function<MakeService(Config&)>;

/// Runs a service from the command line to the exit code: 0 after a stop, 1 after an error, 2 after
/// a usage error.
int run_service(const ServiceInfo& info, int argc, const char* const* argv,
                const ConfigureService& configure);

/// For a class with `static Params read_params(Config&)` and a constructor that takes (const
/// Params&, ServiceContext&).
template <typename ServiceType>
int run_service(const ServiceInfo& info, int argc, const char* const* argv) {
  return run_service(info, argc, argv, [](Config& config) -> MakeService {
    return [params = ServiceType::read_params(config)](ServiceContext& context) {
      return std::make_unique<ServiceType>(params, context);
    };
  });
}

}  // namespace puck
