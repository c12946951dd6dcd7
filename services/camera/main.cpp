#include "services/camera/camera_service.h"
#include "services/launch/run_service.h"

int main(int argc, char** argv) {
  return puck::run_service<puck::CameraService>(
      {.name = "puck-camera",
       .description =
           "Publishes the events of a simulated table, a recording, a log, stdin or a TCP "
           "server."},
      argc, argv);
}
