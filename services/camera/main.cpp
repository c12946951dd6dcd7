#include "services/camera/camera_service.h"
#include "services/launch/run_service.h"

int main(int argc, char** argv) {
  return puck::run_service<puck::CameraService>(
      {.name = "puck-camera",
       .description =
           "Publishes events: of the simulated table, a recording, a log, stdin or TCP."},
      argc, argv);
}
