#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "common/messaging/bus.h"

namespace CLI {
class App;
}

namespace puck {

/// `puck-camera --pause`, `--resume`, `--step`, `--seek` and `--speed`: a person's requests to a
/// camera on the bus that plays a recording.
class CameraOperator {
 public:
  void add_options(CLI::App& app);

  /// Sends the request until every camera that is heard has answered. Returns exit code 0; 1, with
  /// the reason on stderr, if a recording refuses it, no camera has a recording, or a camera does
  /// not answer within 1 s; nothing without a request.
  std::optional<int> run(const BusParams& params, std::stop_token stop) const;

  /// A place as on the command line: "12.5", or "+10" and "-1", which count from where the camera
  /// is.
  struct Place {
    std::int64_t us = 0;
    bool is_relative = false;
  };

 private:
  bool pause_ = false;
  bool resume_ = false;
  bool step_ = false;
  std::optional<Place> seek_;
  std::optional<double> speed_;
};

}  // namespace puck
