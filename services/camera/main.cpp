#include "services/camera/camera_operator.h"
#include "services/camera/camera_service.h"
#include "services/launch/run_service.h"

int main(int argc, char** argv) {
  puck::CameraOperator by_hand;
  return puck::run_service<puck::CameraService>(
      {.name = "puck-camera",
       .description =
           "Publishes the events of a simulated table, a recording, a log, or a camera on stdin, "
           "TCP or a YARP port. With --pause and the like: controls the one that plays a "
           "recording.",
       .add_options = [&](CLI::App& app) { by_hand.add_options(app); },
       .instead = [&](const puck::BusParams& params,
                      std::stop_token stop) { return by_hand.run(params, stop); }},
      argc, argv);
}
